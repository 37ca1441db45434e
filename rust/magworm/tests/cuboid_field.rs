//! Field of cuboids against 60-digit arithmetic.

use magworm::magnetic::field_t;
use nalgebra::Vector3;

const REFERENCE: &str = include_str!("data/cuboid_field.csv");
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
    let mut worst = [0.0_f64; 7];
    for line in REFERENCE.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let vector = |column: usize| Vector3::new(row[column], row[column + 1], row[column + 2]);
        let exact = vector(10);
        let error = (field_t(vector(1), vector(4), vector(7)) - exact).norm() / exact.norm();
        let kind = row[0] as usize;
        worst[kind] = worst[kind].max(error);
    }
    for (kind, error) in KINDS.iter().zip(worst) {
        println!("{kind}: {error:.1e}");
        assert!(error <= 1e-12, "{kind}: {error:e}");
    }
}
