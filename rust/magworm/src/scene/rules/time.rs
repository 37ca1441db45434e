//! Rules of time steps and of what a reset varies.

use super::super::error::Problem;
use super::super::schema::quantity;
use super::super::{Body, Integrator, Parameter, Precision, Scene, Segment};
use super::require;

/// Shortest step of the implicit schemes [s]: below it the inertia swamps the elastic terms.
const SHORTEST_IMPLICIT_STEP_S: f64 = 1e-5;
/// Shortest step in single precision [s], which holds a place 1 m from the origin to within 60 nm: a foot at 1 mm/s
/// moves 500 nm in it.
const SHORTEST_SINGLE_STEP_S: f64 = 5e-4;
/// Most steps that one period may hold; beyond it "a whole number" drowns in rounding.
const MAX_STEPS: f64 = 1e8;
/// Relative error of a ratio that still counts as whole.
const WHOLE: f64 = 1e-9;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    let (step_s, control) = (scene.solver.step_s, &scene.control);
    let explicit = scene.solver.integrator.is_explicit();
    require(
        explicit || step_s >= SHORTEST_IMPLICIT_STEP_S,
        "solver.step_s",
        quantity(step_s, "s"),
        || {
            let implicit = Integrator::names(false);
            format!("{} or more for {implicit}", quantity(SHORTEST_IMPLICIT_STEP_S, "s"))
        },
    )?;
    off_centre(scene)?;
    precision(scene)?;
    whole_number("control.step_s", control.step_s, "solver.step_s", step_s)?;
    wrench_interval(scene)?;
    whole_number("control.episode_s", control.episode_s, "control.step_s", control.step_s)?;
    variations(scene)
}

/// The stable step of the explicit scheme is known for motions that do not meet, which a centre of mass beside the middle
/// couples.
fn off_centre(scene: &Scene) -> Result<(), Problem> {
    let Body::Segments(body) = &scene.body else { return Ok(()) };
    let beside = |segment: &Segment| {
        segment.magnet.as_ref().is_some_and(|magnet| magnet.up_m != 0.0 || magnet.aside_m != 0.0)
    };
    let Some(place) = body.segment.iter().position(beside) else { return Ok(()) };
    let integrator = scene.solver.integrator;
    let name = format!("\"{}\"", integrator.coefficients().name);
    require(!integrator.is_explicit(), "solver.integrator", name, || {
        let implicit = Integrator::names(false);
        format!("{implicit} where body.segment[{place}].magnet has up_m or aside_m")
    })
}

fn precision(scene: &Scene) -> Result<(), Problem> {
    let Scene { solver, .. } = scene;
    let single = solver.precision == Precision::Single;
    let long = !solver.integrator.is_explicit() && solver.step_s >= SHORTEST_SINGLE_STEP_S;
    require(!single || long, "solver.precision", "\"single\"".into(), || {
        let (explicit, shortest) = (Integrator::names(true), quantity(SHORTEST_SINGLE_STEP_S, "s"));
        format!(
            "\"double\" with {explicit} and with steps below {shortest}, which move less than single precision tells apart"
        )
    })
}

fn whole_number(field: &str, period_s: f64, part: &str, part_s: f64) -> Result<(), Problem> {
    let ratio = period_s / part_s;
    let whole = ratio.round();
    let holds = (1.0..=MAX_STEPS).contains(&whole) && (ratio - whole).abs() <= WHOLE * whole;
    require(holds, field, quantity(period_s, "s"), || {
        format!("1 to 1e8 times {part} = {}, a whole number of times", quantity(part_s, "s"))
    })
}

/// A wrench that acted on into the next control step would be state that no observation shows, and would bring actions to
/// bear with a delay that differs from one control step to the next.
fn wrench_interval(scene: &Scene) -> Result<(), Problem> {
    let (interval, control_s) = (scene.solver.wrench_interval, scene.control.step_s);
    let steps = (control_s / scene.solver.step_s).round() as usize;
    require(steps.is_multiple_of(interval), "solver.wrench_interval", interval.to_string(), || {
        let control = quantity(control_s, "s");
        format!("a divisor of {steps}, the solver steps in control.step_s = {control}")
    })
}

fn variations(scene: &Scene) -> Result<(), Problem> {
    let vary = &scene.reset.vary;
    vary.iter().enumerate().try_for_each(|(place, one)| {
        let path = format!("reset.vary[{place}]");
        let twice = vary[..place].iter().any(|other| other.parameter == one.parameter);
        require(!twice, format!("{path}.parameter"), name(one.parameter), || {
            "each parameter at most once".into()
        })?;
        require(
            scene.magnetic_terms.has(one.parameter),
            format!("{path}.parameter"),
            name(one.parameter),
            || format!("a term that acts: magnetic_terms.{} is false", one.parameter.name()),
        )?;
        require(one.low <= one.high, format!("{path}.low"), quantity(one.low, ""), || {
            format!("at most {path}.high = {}", quantity(one.high, ""))
        })
    })
}

fn name(parameter: Parameter) -> String {
    toml::Value::try_from(parameter)
        .map_or_else(|_| format!("{parameter:?}"), |name| name.to_string())
}
