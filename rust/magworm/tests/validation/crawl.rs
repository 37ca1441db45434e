//! The robot over the drive: lift, stride, and what they owe to the scheme, the step, the mesh.

use crate::report::Case;
use crate::world::{World, number};

/// The robot of the paper's experiment, and that of its simulation.
pub const ROBOT: &str = "paper-3";
const SIMULATION: &str = "paper-3-simulation";

const LIFT: &str = "{kind='waypoints',time_s=[0.0,0.5],x_m=[0.027,0.027],y_m=[-0.052,-0.022]}";
pub const PASS: &str = "{kind='constant',x_m=-0.05,y_m=-0.022,speed_m_s=0.1}";

fn pose(world: &World, magnet: usize) -> [f64; 3] {
    world.block.planar_pose(&world.model, magnet, 0)
}

/// Drive lifted −52 → −22 mm in 0.5 s under the middle magnet, held 0.3 s: lift of the middle magnet [m], and the
/// mirror error, the distance of the tail magnet from the mirrored head magnet over the lift.
pub fn lift(robot: &str, edits: &[(&str, &str)]) -> (f64, f64) {
    let mut all = vec![("drive.motion", LIFT)];
    all.extend_from_slice(edits);
    let mut world = World::new(robot, &all);
    let rest = pose(&world, 1)[1];
    world.run(0.8);
    let ([xh, yh, ah], [xt, yt, at]) = (pose(&world, 0), pose(&world, 2));
    let lift = pose(&world, 1)[1] - rest;
    // Angles count at the arm of half a magnet, 4 mm.
    let mirror = (xh + xt - 0.054).abs().max((yh - yt).abs()).max(4e-3 * (ah + at).abs());
    (lift, mirror / lift)
}

/// One pass at 100 mm/s from 50 mm ahead, 1.5 s: peak of the middle magnet and stride of the third towards the
/// head [m], as the paper's sixth figure has them.
pub fn pass(robot: &str, edits: &[(&str, &str)]) -> (f64, f64) {
    pass_at(robot, -0.022, edits)
}

/// Mean stride [m] of nine passes whose drives are up to 0.4 mm higher or lower.
pub fn mean_stride(robot: &str, edits: &[(&str, &str)]) -> f64 {
    (-4..=4).map(|k| pass_at(robot, -0.022 + 1e-4 * f64::from(k), edits).1).sum::<f64>() / 9.0
}

fn pass_at(robot: &str, height_m: f64, edits: &[(&str, &str)]) -> (f64, f64) {
    let height = number(height_m);
    let mut all = vec![("drive.motion", PASS), ("drive.motion.y_m", height.as_str())];
    all.extend_from_slice(edits);
    let mut world = World::new(robot, &all);
    let (rest, start) = (pose(&world, 1)[1], pose(&world, 2)[0]);
    let mut peak = 0.0f64;
    let steps = (1.5 / world.model.step_s).round() as u32;
    for _ in 0..steps {
        world.steps(1);
        peak = peak.max(pose(&world, 1)[1] - rest);
    }
    (peak, start - pose(&world, 2)[0])
}

/// Kelvin–Voigt damping makes the explicit scheme stable below 2/(ω²τ): for the bending of a bridge, with
/// ω² = 16 (E/ρ)(h²/12)/l⁴, elements of l = 1.5 mm, h = 4 mm and τ of some milliseconds, that is some microseconds.
const EXPLICIT: [(&str, &str); 2] =
    [("solver.integrator", "'explicit'"), ("solver.step_s", "1e-6")];

/// The paper's first case: lift about L/7, symmetric. The preset is identified from it: within 3 %.
#[test]
fn regresses_lift() {
    let (height, mirror) = lift(SIMULATION, &[]);
    let mut case = Case::fitted("lift", "Lift over the rising drive")
        .equation("All terms of the model together; lift about L/7")
        .source(
            "MagWorm, Soft Robotics, DOI 10.1089/soro.2019.0167, first experiment: 7.7 mm; \
            band: 3 % of it",
        )
        .scene(SIMULATION, &[("drive.motion", LIFT)])
        .note(
            "The drive rises from −52 to −22 mm in 0.5 s under the middle magnet and waits 0.3 \
            s. The mirror error is the distance of the tail magnet from the mirrored head magnet, \
            as a part of the lift. The presets are identified from this experiment and the next.",
        );
    case.inside("lift of the middle magnet", "mm", height * 1e3, 7.7 * 0.97..=7.7 * 1.03);
    case.at_most("mirror error", "", mirror, 0.01);
    case.finish();
}

/// The paper's simulated pass: peak 9.07 mm, stride 3.48 mm. The preset is identified from it: within 3 %.
#[test]
fn regresses_pass() {
    let (peak, stride) = pass(SIMULATION, &[]);
    let mut case = Case::fitted("pass", "One pass of the drive")
        .equation("All terms of the model together")
        .source(
            "MagWorm, Soft Robotics, DOI 10.1089/soro.2019.0167: peak 9.07 mm, stride 3.48 mm; \
            bands: 3 % of them",
        )
        .scene(SIMULATION, &[("drive.motion", PASS)])
        .note("The drive passes at 100 mm/s, 22 mm below, from 50 mm ahead, within 1.5 s.");
    case.inside("peak of the middle magnet", "mm", peak * 1e3, 9.07 * 0.97..=9.07 * 1.03);
    case.inside("stride of the third magnet", "mm", stride * 1e3, 3.48 * 0.97..=3.48 * 1.03);
    case.finish();
}

/// The paper's experiment: peak 8.30 mm, stride 4.17 mm. The preset is identified from it, among other figures.
#[test]
fn regresses_pass_of_the_experiment() {
    let (peak, stride) = pass(ROBOT, &[]);
    let mut case = Case::fitted("pass_of_the_experiment", "One pass of the drive, experiment")
        .equation("All terms of the model together, magnets of the robot on each other among them")
        .source(
            "MagWorm, Soft Robotics, DOI 10.1089/soro.2019.0167: peak 8.30 mm, stride 4.17 mm; \
            bands: 3 % and 5 % of them",
        )
        .scene(ROBOT, &[("drive.motion", PASS)])
        .note("The drive passes at 100 mm/s, 22 mm below, from 50 mm ahead, within 1.5 s.");
    case.inside("peak of the middle magnet", "mm", peak * 1e3, 8.05..=8.55);
    case.inside("stride of the third magnet", "mm", stride * 1e3, 3.97..=4.37);
    case.finish();
}

/// The paper's explicit scheme and the implicit one agree within 2 % on lift, peak and stride.
#[test]
fn validates_integrators_agree() {
    let (lifts, passes) = (
        [lift(SIMULATION, &[]).0, lift(SIMULATION, &EXPLICIT).0],
        [pass(SIMULATION, &[]), pass(SIMULATION, &EXPLICIT)],
    );
    let mut case = Case::new("integrators_agree", "Explicit against implicit scheme")
        .equation(
            "The same equations of motion; explicit: magnets tied by multipliers, Δt = 1 \
            µs; implicit: magnets eliminated, Δt = 2 ms",
        )
        .source("The two schemes of this simulator; the explicit one is the paper's")
        .scene(SIMULATION, &EXPLICIT)
        .note("Lift and pass that the presets are fitted to; what is expected is the explicit scheme's.");
    let names = ["lift", "peak of a pass", "stride of a pass"];
    let both = [lifts, [passes[0].0, passes[1].0], [passes[0].1, passes[1].1]];
    for (name, pair) in names.into_iter().zip(both) {
        case.relative(name, "mm", pair.map(|m| m * 1e3), 0.02);
    }
    case.finish();
}

/// The paper's ablations of the pass: the preset is identified from their order.
#[test]
fn regresses_ablations() {
    let alone = |kept: &str| {
        let terms = ["horizontal_force", "vertical_force", "torque"];
        let off: Vec<String> = terms
            .iter()
            .filter(|term| **term != kept)
            .map(|term| format!("magnetic_terms.{term}"))
            .collect();
        let edits: Vec<(&str, &str)> = off.iter().map(|path| (path.as_str(), "false")).collect();
        1e3 * pass(SIMULATION, &edits).1
    };
    let [horizontal, vertical, torque] =
        ["horizontal_force", "vertical_force", "torque"].map(alone);
    let mut case = Case::fitted("ablations", "One part of the magnetic load alone")
        .equation("The pass with two of horizontal force, vertical force and torque switched off")
        .source(
            "MagWorm, Soft Robotics, DOI 10.1089/soro.2019.0167: horizontal force alone \"not \
            obvious\", read as a tenth of the stride; vertical force most, torque next",
        )
        .scene(SIMULATION, &[("drive.motion", PASS), ("magnetic_terms", "…")])
        .note("Way of the third magnet towards the head.");
    case.inside("horizontal force alone", "mm", horizontal, -0.348..=0.348);
    case.inside("torque alone", "mm", torque, 0.0..=f64::INFINITY);
    case.inside(
        "vertical force alone less torque alone",
        "mm",
        vertical - torque,
        0.0..=f64::INFINITY,
    );
    case.finish();
}
