//! Lift, peak and stride of the robot as step, mesh and quadrature are refined.

use crate::crawl::{PASS, ROBOT, lift, mean_stride, pass};
use crate::report::{Axes, Case, Figure};

/// Lift of the first experiment, peak and stride of a pass, mean stride of nine [m].
fn all_four(edits: &[(&str, &str)]) -> [f64; 4] {
    let (peak, stride) = pass(ROBOT, edits);
    [lift(ROBOT, edits).0, peak, stride, mean_stride(ROBOT, edits)]
}

const NAMES: [&str; 4] = ["lift", "peak", "stride", "mean stride"];
/// What a note says of them.
const MEASURED: &str = "Lift of the first experiment, peak and stride of a pass. A pass may end \
    with one slip more or less, so its stride jumps; the mean stride is that of nine passes whose \
    drives are up to 0.4 mm higher or lower.";

fn errors(values: [f64; 4], exact: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|k| values[k] / exact[k] - 1.0)
}

/// A table's row of errors.
fn row(label: &str, errors: [f64; 4]) -> Vec<String> {
    let cells = errors.iter().map(|error| format!("{:.2} %", 100.0 * error));
    [label.to_string()].into_iter().chain(cells).collect()
}

fn add_curves(figure: &mut Figure, at: &[f64], found: &[[f64; 4]]) {
    for (k, name) in NAMES.into_iter().enumerate() {
        figure.points(name, at.iter().zip(found).map(|(x, errors)| [*x, errors[k].abs()]));
    }
}

/// The mean stride at the preset's step is within half a per cent of that at 0.1 ms, that of a single pass within 1 %.
#[test]
fn validates_stride_converges_in_the_step() {
    let mut case = Case::new("stride_converges_in_the_step", "Robot: step")
        .equation(
            "Newmark's scheme is of second order; slips that begin and end within a step are of first",
        )
        .source("The simulator at a step of 0.1 ms")
        .scene(ROBOT, &[("drive.motion", PASS), ("solver.step_s", "…")])
        .note(&format!(
            "{MEASURED} The mean stride, which does not depend on where a slip falls, tells the error \
            of the step; a single pass may differ by a slip."
        ));
    let fine = all_four(&[("solver.step_s", "1e-4")]);
    let steps = ["4e-3", "2e-3", "1e-3", "5e-4"];
    let found = steps.map(|step| errors(all_four(&[("solver.step_s", step)]), fine));
    case.relative(
        "stride, preset's step",
        "mm",
        [pass(ROBOT, &[]).1, fine[2]].map(|m| m * 1e3),
        0.01,
    );
    case.inside("difference of the mean stride, preset's step", "", found[1][3], -5e-3..=5e-3);
    let rows = steps.iter().zip(found).map(|(step, errors)| row(step, errors)).collect();
    case.table(
        "Difference from Δt = 0.1 ms:",
        &["Δt [s]", "lift", "peak", "stride", "mean stride"],
        rows,
    );
    let mut figure =
        Figure::new("Robot: step", "Δt [s]", "difference from 0.1 ms", Axes::LogLog).slope(1.0);
    add_curves(&mut figure, &[4e-3, 2e-3, 1e-3, 5e-4], &found);
    case.figure(figure);
    case.finish();
}

/// A step so short that the mesh is what is left.
const SHORT_STEP: (&str, &str) = ("solver.step_s", "2e-4");

fn on_mesh((bridge, foot): (&str, &str)) -> [f64; 4] {
    let mesh = [("body.elements_per_bridge", bridge), ("body.elements_per_foot_end", foot)];
    all_four(&[mesh[0], mesh[1], SHORT_STEP])
}

/// Mesh: the presets' against 16 elements a bridge and 4 a foot's end, about twice what it is off.
#[test]
fn validates_stride_in_the_mesh() {
    let varied = [
        ("drive.motion", PASS),
        SHORT_STEP,
        ("body.elements_per_bridge", "…"),
        ("body.elements_per_foot_end", "…"),
    ];
    let mut case = Case::new("stride_in_the_mesh", "Robot: mesh")
        .equation("Second order in the elements, as for rods")
        .source("The simulator with 16 elements a bridge and 4 a foot's end")
        .scene(ROBOT, &varied)
        .note(&format!(
            "{MEASURED} The step is 0.2 ms: at the presets' 2 ms a single pass jumps \
            by 4 % from mesh to mesh, as a slip falls into one step or the next. The presets have \
            4 elements a bridge and 1 a foot's end and are identified on that mesh."
        ));
    let fine = on_mesh(("16", "4"));
    let meshes = [("2", "1"), ("4", "1"), ("8", "2"), ("12", "3")];
    let found = meshes.map(|mesh| errors(on_mesh(mesh), fine));
    for ((name, error), band) in NAMES.into_iter().zip(found[1]).zip([4e-3, 4e-3, 0.03, 0.02]) {
        case.inside(format!("difference of the {name}, preset's mesh"), "", error, -band..=band);
    }
    let label = |(bridge, foot): &(&str, &str)| format!("{bridge} / {foot}");
    let rows = meshes.iter().zip(found).map(|(mesh, errors)| row(&label(mesh), errors)).collect();
    let head = ["elements a bridge / a foot's end", "lift", "peak", "stride", "mean stride"];
    case.table("Difference from 16 / 4:", &head, rows);
    let mut figure =
        Figure::new("Robot: mesh", "elements a bridge", "difference from 16", Axes::LogLog)
            .slope(-2.0);
    add_curves(&mut figure, &[2.0, 4.0, 8.0, 12.0], &found);
    case.figure(figure);
    case.finish();
}

/// Quadrature: the presets' order 2 against 6 within 2e-3 of the stride, order 3 and up within 1e-5.
#[test]
fn validates_stride_in_the_quadrature() {
    let mut case = Case::new("stride_in_the_quadrature", "Robot: quadrature")
        .equation("Gauss–Legendre along the body magnet: errors fall geometrically with the order")
        .source("The simulator at order 6")
        .scene(ROBOT, &[("drive.motion", PASS), ("solver.quadrature_order", "…")])
        .note(&format!("{MEASURED} The presets use order 2."));
    let fine = all_four(&[("solver.quadrature_order", "6")]);
    let orders = ["1", "2", "3", "4"];
    let found = orders.map(|order| errors(all_four(&[("solver.quadrature_order", order)]), fine));
    for ((order, errors), band) in orders.iter().zip(found).zip([f64::INFINITY, 2e-3, 1e-5, 1e-5]) {
        let what = format!("difference of the stride, order {order}");
        case.inside(what, "", errors[2], -band..=band);
    }
    let words = |errors: [f64; 4]| errors.map(|error| format!("{error:.1e}"));
    let rows = orders
        .iter()
        .zip(found)
        .map(|(order, errors)| [(*order).to_string()].into_iter().chain(words(errors)).collect());
    case.table(
        "Difference from order 6:",
        &["order", "lift", "peak", "stride", "mean stride"],
        rows.collect(),
    );
    case.finish();
}
