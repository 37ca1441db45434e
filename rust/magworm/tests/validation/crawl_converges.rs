//! Lift, peak and stride of the robot as step, mesh and quadrature are refined.

use crate::crawl::{PASS, lift, mean_stride, pass};
use crate::report::{Axes, Case, Figure};

/// Lift of the first experiment, peak and stride of a pass, mean stride of nine [m].
fn all_four(edits: &[(&str, &str)]) -> [f64; 4] {
    let (peak, stride) = pass(edits);
    [lift(edits).0, peak, stride, mean_stride(edits)]
}

const NAMES: [&str; 4] = ["lift", "peak", "stride", "mean stride"];
/// What a note says of them.
const MEASURED: &str = "Lift of the first experiment, peak and stride of a pass. A pass may end with one slip more or less, so its stride jumps; the mean stride is that of nine passes whose drives are up to 0.4 mm higher or lower.";

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

/// The stride at the preset's step is within 1 % of that at 0.1 ms.
#[test]
fn validates_stride_converges_in_the_step() {
    let mut case = Case::new("stride_converges_in_the_step", "Robot: step")
        .equation(
            "Linearly implicit Euler is of first order; stick and slip make the stride rugged",
        )
        .source("The simulator at a step of 0.1 ms")
        .scene("paper-3", &[("drive.motion", PASS), ("solver.step_s", "…")])
        .note(&format!("{MEASURED} The band holds for the preset's step, 2 ms."));
    let fine = all_four(&[("solver.step_s", "1e-4")]);
    let steps = ["4e-3", "2e-3", "1e-3", "5e-4"];
    let found = steps.map(|step| errors(all_four(&[("solver.step_s", step)]), fine));
    case.relative("stride, preset's step", "mm", [pass(&[]).1, fine[2]].map(|m| m * 1e3), 0.01);
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

/// Mesh: told, without a band. The finest is 24 elements a bridge and 6 a foot's end.
#[test]
fn validates_stride_in_the_mesh() {
    let mut case = Case::new("stride_in_the_mesh", "Robot: mesh")
        .equation("Second order in the elements, as for rods")
        .source("The simulator with 24 elements a bridge and 6 a foot's end")
        .scene("paper-3", &[("drive.motion", PASS), ("body.elements_per_bridge", "…"), ("body.elements_per_foot_end", "…")])
        .note(&format!("{MEASURED} The presets have 4 elements a bridge and were identified on that mesh, so no band is set; the numbers tell what a finer mesh would change."));
    let fine = all_four(&[("body.elements_per_bridge", "24"), ("body.elements_per_foot_end", "6")]);
    let meshes = [("2", "1"), ("4", "1"), ("8", "2"), ("12", "3"), ("16", "4")];
    let found = meshes.map(|(bridge, foot)| {
        let mesh = [("body.elements_per_bridge", bridge), ("body.elements_per_foot_end", foot)];
        errors(all_four(&mesh), fine)
    });
    for (k, name) in NAMES.into_iter().enumerate() {
        case.tell(format!("difference of the {name}, preset's mesh"), "", found[1][k]);
    }
    let label = |(bridge, foot): &(&str, &str)| format!("{bridge} / {foot}");
    let rows = meshes.iter().zip(found).map(|(mesh, errors)| row(&label(mesh), errors)).collect();
    case.table(
        "Difference from 24 / 6:",
        &["elements a bridge / a foot's end", "lift", "peak", "stride", "mean stride"],
        rows,
    );
    let mut figure =
        Figure::new("Robot: mesh", "elements a bridge", "difference from 24", Axes::LogLog)
            .slope(-2.0);
    add_curves(&mut figure, &[2.0, 4.0, 8.0, 12.0, 16.0], &found);
    case.figure(figure);
    case.finish();
}

/// Quadrature: order 3 and up against 6 within 1e-3 of the stride (the wrench's own error is 1e-6).
#[test]
fn validates_stride_in_the_quadrature() {
    let mut case = Case::new("stride_in_the_quadrature", "Robot: quadrature")
        .equation("Gauss–Legendre along the body magnet: errors fall geometrically with the order")
        .source("The simulator at order 6")
        .scene("paper-3", &[("drive.motion", PASS), ("solver.quadrature_order", "…")])
        .note(&format!("{MEASURED} The presets use order 2."));
    let fine = all_four(&[("solver.quadrature_order", "6")]);
    let orders = ["1", "2", "3", "4"];
    let found = orders.map(|order| errors(all_four(&[("solver.quadrature_order", order)]), fine));
    for (order, errors) in orders.iter().zip(found) {
        let band = if *order >= "3" { 1e-3 } else { f64::INFINITY };
        case.inside(
            format!("difference of the stride, order {order}"),
            "",
            errors[2],
            -band..=band,
        );
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
