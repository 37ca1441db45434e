//! Cuboid magnets against converged reference values.

use magworm::magnetic::{Magnet, Wrench, wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

const REFERENCE: &str = include_str!("data/magnet_reference.csv");

/// Poses and wrenches of the reference; columns are named in the file's first line.
fn rows() -> Vec<Vec<f64>> {
    let parse = |line: &str| line.split(',').map(|cell| cell.trim().parse().unwrap()).collect();
    REFERENCE.lines().skip(1).map(parse).collect()
}

fn vector(row: &[f64], column: usize) -> Vector3<f64> {
    Vector3::new(row[column], row[column + 1], row[column + 2])
}

fn reference_and_model(row: &[f64], order: usize) -> (Wrench, Wrench) {
    let drive = Magnet { size_m: vector(row, 0), remanence_t: row[19] * vector(row, 13) };
    let body = Magnet { size_m: vector(row, 3), remanence_t: row[20] * vector(row, 16) };
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(row[9], row[10], row[11], row[12]));
    let reference = Wrench { force_n: vector(row, 21), torque_n_m: vector(row, 24) };
    (reference, wrench(&drive, &body, vector(row, 6), turn, order))
}

fn error(value: Vector3<f64>, exact: Vector3<f64>) -> f64 {
    (value - exact).norm() / exact.norm()
}

#[test]
fn validates_every_reference_wrench_at_order_five() {
    for (line, row) in rows().iter().enumerate() {
        let (reference, model) = reference_and_model(row, 5);
        let force = error(model.force_n, reference.force_n);
        let torque = error(model.torque_n_m, reference.torque_n_m);
        println!("row {line}: force {force:.1e}, torque {torque:.1e}");
        // By symmetry there is no torque straight above; only rounding is left of it there.
        let none = reference.torque_n_m.norm() < 1e-12 * reference.force_n.norm();
        assert!(force <= 1e-6, "row {line}: force off by {force:e}");
        assert!(
            torque <= 1e-6 || none && model.torque_n_m.norm() < 1e-14,
            "row {line}: torque off by {torque:e}"
        );
    }
}

#[test]
fn validates_the_published_torque_of_two_large_magnets() {
    let magnet =
        Magnet { size_m: Vector3::new(0.04, 0.04, 0.02), remanence_t: Vector3::new(0.0, 0.0, 1.3) };
    let offset = Vector3::new(0.02, 0.0, 0.03);
    let torque = wrench(&magnet, &magnet, offset, UnitQuaternion::identity(), 6).torque_n_m;
    assert!((torque.y - 0.422829).abs() <= 1e-6, "T_y = {} N·m", torque.y);
}
