//! Lift, peak and stride of the robot as step, mesh and quadrature are refined.

use crate::crawl::{PASS, lift, pass};
use crate::report::{Axes, Case, Figure};

/// Lift of the first experiment, peak and stride of a pass [m].
fn all_three(edits: &[(&str, &str)]) -> [f64; 3] {
    let (peak, stride) = pass(edits);
    [lift(edits).0, peak, stride]
}

const NAMES: [&str; 3] = ["lift", "peak", "stride"];

fn errors(values: [f64; 3], exact: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| values[k] / exact[k] - 1.0)
}

/// A table's row of errors.
fn row(label: &str, errors: [f64; 3]) -> Vec<String> {
    let cells = errors.iter().map(|error| format!("{:.2} %", 100.0 * error));
    [label.to_string()].into_iter().chain(cells).collect()
}

fn add_curves(figure: &mut Figure, at: &[f64], found: &[[f64; 3]]) {
    for (k, name) in NAMES.into_iter().enumerate() {
        figure.points(name, at.iter().zip(found).map(|(x, errors)| [*x, errors[k].abs()]));
    }
}

/// The stride at the preset's step is within 1 % of that at 0.1 ms.
#[test]
fn validates_stride_converges_in_the_step() {
    let mut case = Case::new("stride_converges_in_the_step", "Robot: step")
        .equation("Linearly implicit Euler is of first order; stick and slip make the stride rugged")
        .source("The simulator at a step of 0.1 ms")
        .scene("paper-3", &[("drive.motion", PASS), ("solver.step_s", "…")])
        .note("Lift of the first experiment, peak and stride of a pass. The band holds for the preset's step, 2 ms.");
    let fine = all_three(&[("solver.step_s", "1e-4")]);
    let steps = ["4e-3", "2e-3", "1e-3", "5e-4"];
    let found = steps.map(|step| errors(all_three(&[("solver.step_s", step)]), fine));
    case.relative("stride, preset's step", "mm", [pass(&[]).1, fine[2]].map(|m| m * 1e3), 0.01);
    let rows = steps.iter().zip(found).map(|(step, errors)| row(step, errors)).collect();
    case.table("Difference from Δt = 0.1 ms:", &["Δt [s]", "lift", "peak", "stride"], rows);
    let mut figure =
        Figure::new("Robot: step", "Δt [s]", "difference from 0.1 ms", Axes::LogLog).slope(1.0);
    add_curves(&mut figure, &[4e-3, 2e-3, 1e-3, 5e-4], &found);
    case.figure(figure);
    case.finish();
}

/// Mesh: told, without a band. The finest is 16 elements a bridge and 4 a foot's end.
#[test]
fn validates_stride_in_the_mesh() {
    let mut case = Case::new("stride_in_the_mesh", "Robot: mesh")
        .equation("Second order in the elements, as for rods")
        .source("The simulator with 16 elements a bridge and 4 a foot's end")
        .scene("paper-3", &[("drive.motion", PASS), ("body.elements_per_bridge", "…"), ("body.elements_per_foot_end", "…")])
        .note("Lift of the first experiment, peak and stride of a pass. The presets have 4 elements a bridge and were identified on that mesh, so no band is set; the numbers tell what a finer mesh would change.");
    let fine =
        all_three(&[("body.elements_per_bridge", "16"), ("body.elements_per_foot_end", "4")]);
    let meshes = [("2", "1"), ("4", "1"), ("8", "2")];
    let found = meshes.map(|(bridge, foot)| {
        let mesh = [("body.elements_per_bridge", bridge), ("body.elements_per_foot_end", foot)];
        errors(all_three(&mesh), fine)
    });
    for (k, name) in NAMES.into_iter().enumerate() {
        case.tell(format!("difference of the {name}, preset's mesh"), "", found[1][k]);
    }
    let label = |(bridge, foot): &(&str, &str)| format!("{bridge} / {foot}");
    let rows = meshes.iter().zip(found).map(|(mesh, errors)| row(&label(mesh), errors)).collect();
    case.table(
        "Difference from 16 / 4:",
        &["elements a bridge / a foot's end", "lift", "peak", "stride"],
        rows,
    );
    let mut figure =
        Figure::new("Robot: mesh", "elements a bridge", "difference from 16", Axes::LogLog)
            .slope(-2.0);
    add_curves(&mut figure, &[2.0, 4.0, 8.0], &found);
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
        .note("Lift of the first experiment, peak and stride of a pass. The presets use order 2.");
    let fine = all_three(&[("solver.quadrature_order", "6")]);
    let orders = ["1", "2", "3", "4"];
    let found = orders.map(|order| errors(all_three(&[("solver.quadrature_order", order)]), fine));
    for (order, errors) in orders.iter().zip(found) {
        let band = if *order >= "3" { 1e-3 } else { f64::INFINITY };
        case.inside(
            format!("difference of the stride, order {order}"),
            "",
            errors[2],
            -band..=band,
        );
    }
    let words = |errors: [f64; 3]| errors.map(|error| format!("{error:.1e}"));
    let rows = orders
        .iter()
        .zip(found)
        .map(|(order, errors)| [(*order).to_string()].into_iter().chain(words(errors)).collect());
    case.table("Difference from order 6:", &["order", "lift", "peak", "stride"], rows.collect());
    case.finish();
}
