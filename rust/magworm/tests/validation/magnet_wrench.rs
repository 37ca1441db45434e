//! Cuboid magnets against converged reference values.

use crate::magnet_symmetry::poses;
use crate::report::{Axes, Case, Figure, short};
use magworm::internals::magnetic::{Cuboid, Magnet, PlanarPair, Wrench, wrench};
use magworm::scene::Scene;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

const REFERENCE: &str = include_str!("../data/magnet_reference.csv");

/// Wrench of a reference pose at a quadrature order.
type Kernel = fn(&[f64], usize) -> Wrench;

/// Poses and wrenches of the reference; columns are named in the file's first line.
fn rows() -> Vec<Vec<f64>> {
    let parse = |line: &str| line.split(',').map(|cell| cell.trim().parse().unwrap()).collect();
    REFERENCE.lines().skip(1).map(parse).collect()
}

fn vector(row: &[f64], column: usize) -> Vector3<f64> {
    Vector3::new(row[column], row[column + 1], row[column + 2])
}

fn reference(row: &[f64]) -> Wrench {
    Wrench { force_n: vector(row, 21), torque_n_m: vector(row, 24) }
}

fn spatial(row: &[f64], order: usize) -> Wrench {
    let drive = Magnet { size_m: vector(row, 0), remanence_t: row[19] * vector(row, 13) };
    let body = Magnet { size_m: vector(row, 3), remanence_t: row[20] * vector(row, 16) };
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(row[9], row[10], row[11], row[12]));
    wrench(&drive, &body, vector(row, 6), turn, order).expect("magnets apart")
}

/// Whether a pose lies in the simulator's plane, the reference's x and z: centre in it, turned about y, magnetised
/// along the heights.
fn is_planar(row: &[f64]) -> bool {
    let nothing = [row[7], row[10], row[12], row[13], row[14], row[16], row[17]];
    nothing.iter().all(|value| *value == 0.0)
}

/// The simulator's own wrench, in the reference's frame: its y is the reference's z, its z the reference's −y.
fn planar(row: &[f64], order: usize) -> Wrench {
    let cuboid = |column: usize| Cuboid {
        length_m: row[column],
        height_m: row[column + 2],
        width_m: row[column + 1],
    };
    let (sin, cos) = (-2.0 * row[11].atan2(row[9])).sin_cos();
    let strength = row[19] * row[20] * row[15] * row[18];
    let pair = PlanarPair::new(cuboid(0), cuboid(3), order);
    let [fx, fy, torque] = pair.wrench(row[6], row[8], cos, sin, strength);
    Wrench { force_n: Vector3::new(fx, 0.0, fy), torque_n_m: Vector3::new(0.0, -torque, 0.0) }
}

fn error(value: Vector3<f64>, exact: Vector3<f64>) -> f64 {
    (value - exact).norm() / exact.norm()
}

/// Errors of force and torque over rows. The torque passes through zero: in the plane its error is a part of
/// |T| + |F| l/2, l the body's length. By symmetry there is no torque straight above; there only rounding is left of
/// it, which counts as no error.
fn errors(rows: &[Vec<f64>], model: impl Fn(&[f64]) -> Wrench, with_arm: bool) -> [Vec<f64>; 2] {
    let (mut force, mut torque) = (Vec::new(), Vec::new());
    for row in rows {
        let (exact, found) = (reference(row), model(row));
        force.push(error(found.force_n, exact.force_n));
        let none = exact.torque_n_m.norm() < 1e-12 * exact.force_n.norm()
            && found.torque_n_m.norm() < 1e-14;
        let arm = if with_arm { 0.5 * row[3] * exact.force_n.norm() } else { 0.0 };
        let off = (found.torque_n_m - exact.torque_n_m).norm();
        torque.push(if none { 0.0 } else { off / (exact.torque_n_m.norm() + arm) });
    }
    [force, torque]
}

fn greatest(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

#[test]
fn validates_every_reference_wrench() {
    let mut case = Case::new("every_reference_wrench", "Wrench between two cuboid magnets")
        .equation(
            "F = ∬ σ B dS, T = ∬ σ r × B dS over the body magnet's faces, σ = J·n/μ0, B of \
            the drive in closed form",
        )
        .source(
            "Charge model (unit permeability, rigid magnetisation), converged values, \
            `rust/magworm/tests/data/magnet_reference.csv`",
        )
        .note(
            "21 poses, 7 to 50 mm apart, of drives of 20 to 50 mm and bodies of 10 to 14 mm; \
            `planar` is the kernel of the simulator on those of them that lie in its plane, \
            `spatial` that of the Python function `magworm_gym.magnet.wrench`. The presets use \
            order 2. Rows are quantiles over the poses. The spatial torque's error is a part of \
            |T|, the planar one's of |T| + |F| l/2 with l the body's length, as T passes through \
            zero: of |T| alone it is up to 20 % at order 2, in a pose where T is 0.4 % of |F| \
            times the distance. The last rows are of the magnets of `paper-3`, order 2 against 8, \
            at 600 poses 22 to 62 mm above the drive's centre, 60 mm to both sides, at all \
            angles.",
        );
    let all = rows();
    let flat: Vec<_> = all.iter().filter(|row| is_planar(row)).cloned().collect();
    assert!((all.len(), flat.len()) == (21, 12), "{} {}", all.len(), flat.len());
    let mut figure = Figure::new(
        "Wrench: worst error over the poses",
        "quadrature order",
        "error",
        Axes::LogLog,
    );
    let kernels: [(&str, &[Vec<f64>], Kernel, usize); 2] =
        [("spatial", &all, spatial, 5), ("planar", &flat, planar, 6)];
    let mut table = Vec::new();
    for (name, poses, kernel, checked) in kernels {
        let mut curves = [Vec::new(), Vec::new()];
        for order in 1..=8 {
            let both = errors(poses, |row| kernel(row, order), name == "planar");
            for ((part, errors), curve) in ["force", "torque"].iter().zip(&both).zip(&mut curves) {
                // Beyond order 6 only the digits of the reference are left.
                curve.push([order as f64, greatest(errors)]);
                if order == checked {
                    case.spread(format!("{part}, {name}, order {order}"), "relative", errors, 1e-6);
                }
            }
            if name == "planar" && order == 2 {
                case.spread("force, planar, order 2 (presets)", "relative", &both[0], 1e-2);
                case.spread("torque, planar, order 2 (presets)", "relative", &both[1], 2e-2);
            }
            let worst = both.iter().map(|errors| short(greatest(errors)));
            table.push([name.to_string(), order.to_string()].into_iter().chain(worst).collect());
        }
        for (part, curve) in ["force", "torque"].iter().zip(curves) {
            figure.points(format!("{part}, {name}"), curve);
        }
    }
    let scene = Scene::preset("paper-3").expect("a preset");
    let [force, torque] = preset_errors(&scene);
    // Errors of order 2 go with the fourth power of the magnet's length; the bands are of one 6.3 mm long.
    let longer = (scene.magnet.expect("magnets").length_m / 6.3e-3).powi(4);
    case.spread("force, paper-3's own magnets, order 2", "relative", &force, 5e-4 * longer);
    case.spread("torque, paper-3's own magnets, order 2", "relative", &torque, 1e-3 * longer);
    case.table("Greatest error over the poses:", &["kernel", "order", "force", "torque"], table);
    case.figure(figure);
    case.finish();
}

/// Errors of the preset's magnets over its drive at order 2 against order 8, at 600 poses: 60 mm to both sides, 22 to
/// 62 mm above, all angles. Torques as above.
fn preset_errors(scene: &Scene) -> [Vec<f64>; 2] {
    let drive = scene.drive.as_ref().expect("a drive");
    let body = scene.magnet.as_ref().expect("magnets");
    let pairs = [2, 8].map(|order| {
        let [drive, body] = [
            [drive.length_m, drive.height_m, drive.width_m],
            [body.length_m, body.height_m, body.width_m],
        ]
        .map(|[length_m, height_m, width_m]| Cuboid { length_m, height_m, width_m });
        PlanarPair::new(drive, body, order)
    });
    let (mut force, mut torque) = (Vec::new(), Vec::new());
    for [x, y, angle] in poses([0.12, 0.022, 0.04]) {
        let [found, exact] = pairs.map(|pair| pair.wrench(x, y, angle.cos(), angle.sin(), 1.0));
        let size = exact[0].hypot(exact[1]);
        let arm = 0.5 * body.length_m * size;
        force.push((found[0] - exact[0]).hypot(found[1] - exact[1]) / size);
        torque.push((found[2] - exact[2]).abs() / (exact[2].abs() + arm));
    }
    [force, torque]
}

#[test]
fn validates_the_published_torque_of_two_large_magnets() {
    let mut case =
        Case::new("the_published_torque_of_two_large_magnets", "Torque between two large magnets")
            .equation("T = ∬ σ r × B dS")
            .source("Converged value of the charge model, T_y = 0.422829 N·m")
            .note(
                "Two magnets of 40 × 40 × 20 mm, 1.3 T, offset (20, 0, 30) mm: closed forms of the \
            torque disagree in the literature, here it is integrated from the field.",
            );
    let magnet =
        Magnet { size_m: Vector3::new(0.04, 0.04, 0.02), remanence_t: Vector3::new(0.0, 0.0, 1.3) };
    let offset = Vector3::new(0.02, 0.0, 0.03);
    let found = wrench(&magnet, &magnet, offset, UnitQuaternion::identity(), 6);
    let torque = found.expect("magnets apart").torque_n_m;
    case.absolute("T_y", "N·m", [torque.y, 0.422829], 1e-6);
    case.finish();
}
