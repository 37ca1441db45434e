//! Field of cuboids against 60-digit arithmetic.

use crate::report::Case;
use magworm::internals::magnetic::field_t;
use nalgebra::Vector3;

const REFERENCE: &str = include_str!("../data/cuboid_field.csv");
const KINDS: [&str; 7] = [
    "anywhere",
    "on the extension of an edge",
    "in the plane of a face",
    "near a face",
    "beside an edge",
    "inside",
    "on an axis",
];

#[test]
fn validates_the_field_at_a_thousand_points() {
    let mut case = Case::new("the_field_at_a_thousand_points", "Field of a cuboid")
        .equation(
            "B = −μ0 ∇φ (+ J inside), φ = ∬ J·n/(4π μ0 r) dS over the faces: sums of \
            logarithms and arctangents over the corners",
        )
        .source(
            "Closed form: E. P. Furlani, Permanent Magnet and Electromechanical Devices, ch. \
            4; reference in 60-digit arithmetic, `rust/magworm/tests/data/cuboid_field.csv`",
        )
        .note(
            "Sizes, magnetisations and points are drawn from a fixed seed, also where the \
            closed form is numerically delicate.",
        );
    let mut errors: [Vec<f64>; 7] = Default::default();
    for line in REFERENCE.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let vector = |column: usize| Vector3::new(row[column], row[column + 1], row[column + 2]);
        let exact = vector(10);
        let error = (field_t(vector(1), vector(4), vector(7)) - exact).norm() / exact.norm();
        errors[row[0] as usize].push(error);
    }
    for (kind, errors) in KINDS.iter().zip(errors) {
        case.spread(format!("B, points {kind}"), "relative", &errors, 1e-12);
    }
    case.finish();
}
