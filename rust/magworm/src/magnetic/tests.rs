//! Properties of field and wrench: Maxwell's equations, symmetry, far field, equal bits.

use super::cuboid::{unit_field, unit_field_outside};
use super::dipole::dipole_field_t;
use super::*;
use crate::lanes::math::sin_cos;
use crate::lanes::{Isa, Vector, WIDE, WideTask, run_wide};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use proptest::prelude::*;

const DRIVE: Cuboid = Cuboid { length_m: 0.040, height_m: 0.005, width_m: 0.030 };
const BODY: Cuboid = Cuboid { length_m: 0.010, height_m: 0.003, width_m: 0.012 };
const SIZE: Vector3<f64> = Vector3::new(0.04, 0.03, 0.01);
const REMANENCE: Vector3<f64> = Vector3::new(0.3, -0.5, 1.1);

fn spatial(cuboid: Cuboid, remanence_t: Vector3<f64>) -> Magnet {
    let size_m = Vector3::new(cuboid.length_m, cuboid.height_m, cuboid.width_m);
    Magnet { size_m, remanence_t }
}

fn planar(order: usize, dx: f64, dy: f64, angle: f64) -> [f64; 3] {
    let (sin, cos) = sin_cos(angle);
    PlanarPair::new(DRIVE, BODY, order).wrench(dx, dy, cos, sin, 1.5)
}

fn assert_close(value: [f64; 3], exact: [f64; 3], tolerance: f64) {
    let force = exact[0].hypot(exact[1]);
    let gap = (value[0] - exact[0]).hypot(value[1] - exact[1]);
    assert!(gap <= tolerance * force, "{value:?} is not {exact:?}");
    let moment = exact[2].abs().max(0.01 * force);
    assert!((value[2] - exact[2]).abs() <= tolerance * moment, "{value:?} is not {exact:?}");
}

/// ∂B_i/∂x_j by central differences of fourth order [T/m].
fn jacobian(at: Vector3<f64>) -> Matrix3<f64> {
    let h = 2e-5;
    let mut jacobian = Matrix3::zeros();
    for j in 0..3 {
        let b = |steps: f64| field_t(SIZE, REMANENCE, at + Vector3::ith(j, steps * h));
        let slope = (8.0 * (b(1.0) - b(-1.0)) - (b(2.0) - b(-2.0))) / (12.0 * h);
        jacobian.set_column(j, &slope);
    }
    jacobian
}

#[test]
fn field_far_away_becomes_that_of_a_dipole_as_the_inverse_square() {
    let moment = REMANENCE * SIZE.product();
    let error = |r: f64| {
        let at = Vector3::new(1.0, 2.0, -1.5).normalize() * r;
        let exact = field_t(SIZE, REMANENCE, at);
        (dipole_field_t(moment, at) - exact).norm() / exact.norm()
    };
    for r in [0.2, 0.4, 0.8] {
        let ratio = error(r) / error(2.0 * r);
        assert!((3.5..4.5).contains(&ratio), "halving factor {ratio} at {r} m");
    }
    assert!(error(1.6) < 2e-3);
}

#[test]
fn fast_field_equals_the_accurate_one_outside() {
    for i in 0..2000 {
        let t = f64::from(i);
        let direction = [(0.7 * t).sin(), (1.3 * t + 1.0).sin(), (2.1 * t + 2.0).sin()];
        let largest = direction.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        // On a box around the magnet, a tenth of its size or more away.
        let scale = 1.2 + 0.5 * (1.0 + (0.1 * t).sin());
        let half = [0.02, 0.015, 0.02];
        let at = [0, 1, 2].map(|k| direction[k] / largest * half[k] * scale);
        let (fast, exact) = (unit_field_outside(half, at), unit_field(half, at));
        let norm = exact.iter().map(|b| b * b).sum::<f64>().sqrt();
        for k in 0..3 {
            assert!((fast[k] - exact[k]).abs() <= 2e-13 * norm, "{fast:?} is not {exact:?}");
        }
    }
}

#[test]
fn field_is_finite_and_continuous_on_extensions_of_edges_and_faces() {
    let h = 0.5 * SIZE;
    let on = [
        Vector3::new(h.x, h.y, 0.02),
        Vector3::new(h.x, -0.03, h.z),
        Vector3::new(-0.05, -h.y, -h.z),
        Vector3::new(h.x, 0.001, 0.02),
        Vector3::new(0.03, 0.001, -h.z),
        Vector3::new(0.0, h.y, 0.03),
        Vector3::new(0.0, 0.0, h.z + 1e-6),
    ];
    for at in on {
        let exact = field_t(SIZE, REMANENCE, at);
        assert!(exact.iter().all(|b| b.is_finite()));
        for k in 0..3 {
            for step in [1e-12, -1e-12] {
                let beside = field_t(SIZE, REMANENCE, at + Vector3::ith(k, step));
                assert!((beside - exact).norm() < 1e-9, "jump at {at:?}");
            }
        }
    }
}

#[test]
fn field_is_finite_on_edges_and_corners() {
    let h = 0.5 * SIZE;
    for at in [h, -h, Vector3::new(h.x, h.y, 0.0), Vector3::new(0.0, h.y, h.z), Vector3::zeros()] {
        assert!(field_t(SIZE, REMANENCE, at).iter().all(|b| b.is_finite()));
    }
}

#[test]
fn field_jumps_by_the_magnetisation_across_a_side_and_not_along_the_normal() {
    let at = Vector3::new(0.5 * SIZE.x, 0.004, 0.002);
    let step = Vector3::x() * 1e-9;
    let jump = field_t(SIZE, REMANENCE, at - step) - field_t(SIZE, REMANENCE, at + step);
    let tangential = Vector3::new(0.0, REMANENCE.y, REMANENCE.z);
    assert!((jump - tangential).norm() < 1e-6, "{jump:?}");
}

#[test]
fn planar_wrench_equals_the_spatial_one() {
    let (drive, body) = (spatial(DRIVE, Vector3::y()), spatial(BODY, 1.5 * Vector3::y()));
    for (dx, dy, angle) in [(0.0, 0.022, 0.3), (-0.03, 0.012, 2.0), (0.045, -0.001, -1.0)] {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        let exact = wrench(&drive, &body, Vector3::new(dx, dy, 0.0), turn, MAX_ORDER).unwrap();
        let (f, t) = (exact.force_n, exact.torque_n_m);
        assert!(f.z.abs().max(t.x.abs()).max(t.y.abs()) < 1e-13 * f.norm());
        assert_close(planar(MAX_ORDER, dx, dy, angle), [f.x, f.y, t.z], 1e-8);
    }
}

#[test]
fn planar_wrench_has_the_published_values() {
    let pair = |d: [f64; 3], b: [f64; 3], order| {
        let cuboid = |s: [f64; 3]| Cuboid { length_m: s[0], height_m: s[2], width_m: s[1] };
        PlanarPair::new(cuboid(d), cuboid(b), order)
    };
    // Published in a frame whose z is up: (F_x, F_z, T_y), turned about y; here T_z = −T_y.
    let table = [
        (0.00, 15.0_f64, [0.18179, -1.75759, -4.04713e-3]),
        (0.01, 20.0, [-0.55051, -1.52321, 1.67852e-3]),
        (0.03, 45.0, [-0.41404, -0.08648, 2.63974e-3]),
    ];
    for (dx, degrees, [fx, fz, ty]) in table {
        let (sin, cos) = sin_cos(-degrees.to_radians());
        let small = pair([0.030, 0.020, 0.010], [0.010, 0.010, 0.003], 6);
        let [x, y, t] = small.wrench(dx, 0.022, cos, sin, 1.22 * 1.22);
        assert!((x - fx).abs() <= 6e-6 && (y - fz).abs() <= 6e-6 && (t + ty).abs() <= 6e-9);
    }
}

#[test]
fn dipole_wrench_is_the_far_limit() {
    for (dx, dy, angle) in [(0.2, 0.3, 0.5), (-0.5, 0.1, 2.0)] {
        let near = PlanarDipole::relative_error(DRIVE, BODY, dx, dy, angle);
        let far = PlanarDipole::relative_error(DRIVE, BODY, 2.0 * dx, 2.0 * dy, angle);
        assert!(near < 0.02 && (3.6..4.4).contains(&(near / far)), "{near} {far}");
    }
}

#[test]
fn uniform_field_turns_the_moment_towards_itself() {
    let moment = BODY.volume_m3() * 1.22 / MU_0;
    let (sin, cos) = sin_cos(0.4);
    let (field_t, up) = (Vector([0.0, 0.01, 0.0]), Vector([-sin, cos, 0.0]));
    let torque = UniformField::new(BODY).torque(field_t, up, 1.22);
    assert!((torque[2] + moment * 0.01 * 0.4_f64.sin()).abs() < 1e-16);
    assert_eq!([torque[0], torque[1]], [0.0; 2]);
}

#[test]
fn planar_wrench_is_finite_in_contact() {
    let (a, c) = (0.5 * DRIVE.length_m, 0.5 * DRIVE.height_m);
    let equal = Cuboid { width_m: DRIVE.width_m, ..BODY };
    for body in [BODY, equal] {
        let pair = PlanarPair::new(DRIVE, body, 1);
        for (x, y) in [(a, c), (-a, c), (a, -c), (0.01, c), (0.0, 0.0), (a, 0.02), (0.03, c)] {
            let [fx, fy, t] = pair.wrench(x, y + 0.5 * body.height_m, 1.0, 0.0, 1.5);
            assert!(fx.is_finite() && fy.is_finite() && t.is_finite(), "at {x}, {y}");
        }
    }
}

proptest! {
    #[test]
    fn outside_the_field_has_no_divergence_and_no_curl(
        x in -0.06..0.06_f64, y in -0.06..0.06_f64, z in 0.008..0.05_f64,
    ) {
        let j = jacobian(Vector3::new(x, y, z));
        prop_assert!(j.trace().abs() <= 1e-6 * j.norm());
        prop_assert!((j - j.transpose()).norm() <= 1e-6 * j.norm());
    }

    #[test]
    fn mirrored_magnets_feel_the_mirrored_wrench(
        dx in -0.08..0.08_f64, dy in 0.012..0.05_f64, angle in -3.1..3.1_f64,
    ) {
        let [fx, fy, t] = planar(3, dx, dy, angle);
        assert_close(planar(3, -dx, dy, -angle), [-fx, fy, -t], 1e-9);
        assert_close(planar(3, dx, -dy, -angle), [fx, -fy, -t], 1e-9);
        assert_close(planar(3, dx, dy, angle + std::f64::consts::PI), [-fx, -fy, -t], 1e-9);
    }

    #[test]
    fn action_equals_reaction(
        position in prop::array::uniform3(-0.04..0.04_f64), axis in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let position = Vector3::from(position) + Vector3::z() * 0.08;
        let turn = UnitQuaternion::from_scaled_axis(2.0 * Vector3::from(axis));
        let drive = Magnet { size_m: SIZE, remanence_t: REMANENCE };
        let body = Magnet { size_m: Vector3::new(0.02, 0.012, 0.009), remanence_t: -REMANENCE };
        let on_body = wrench(&drive, &body, position, turn, 8).unwrap();
        let back = turn.inverse();
        let on_drive = wrench(&body, &drive, back * -position, back, 8).unwrap();
        let reaction = turn * on_drive.force_n;
        prop_assert!((reaction + on_body.force_n).norm() <= 1e-7 * reaction.norm());
        // Torques about the drive's centre cancel.
        let total = on_body.torque_n_m + position.cross(&on_body.force_n) + turn * on_drive.torque_n_m;
        prop_assert!(total.norm() <= 1e-7 * position.norm() * reaction.norm());
    }
}

struct Wrenches<'a>(&'a [[f64; WIDE]; 4]);
impl WideTask for Wrenches<'_> {
    type Output = [[f64; WIDE]; 18];
    fn run<I: Isa<Row = [f64; WIDE]>>(self, isa: I) -> Self::Output {
        let mut rows = [[0.0; WIDE]; 18];
        isa.vectorize(
            #[inline(always)]
            || {
                let [dx, dy, cos, sin] = self.0.each_ref().map(|lanes| isa.load(lanes));
                for (row, value) in rows.iter_mut().zip(everything(dx, dy, cos, sin)) {
                    isa.store(value, row);
                }
            },
        );
        rows
    }
}

/// Every kernel of this folder.
#[inline(always)]
fn everything<F: crate::lanes::Real>(dx: F, dy: F, cos: F, sin: F) -> [F; 18] {
    let strength = dx * 3.0 + 1.5;
    let p = PlanarPair::new(DRIVE, BODY, 3).wrench(dx, dy, cos, sin, strength);
    let d = PlanarDipole::new(DRIVE, BODY).wrench(dx, dy, cos, sin, strength);
    let b = unit_field([0.02, 0.015, 0.005], [dx, cos * 0.02, dy]);
    let fast = unit_field_outside([0.02, 0.015, 0.005], [dx, cos * 0.02, dy]);
    let (drive, body) = (spatial(DRIVE, Vector3::y()), spatial(BODY, REMANENCE));
    let (zero, one) = (dx.splat(0.0), dx.splat(1.0));
    let axes = [[cos, sin, zero], [-sin, cos, zero], [zero, zero, one]];
    let s = SpatialPair::new(&drive, &body, 2).wrench([dx, dy, dx * 0.3], axes);
    let mut all = [zero; 18];
    all[..3].copy_from_slice(&p);
    all[3..6].copy_from_slice(&d);
    all[6..9].copy_from_slice(&b);
    all[9..12].copy_from_slice(&fast);
    all[12..].copy_from_slice(&s);
    all
}

#[test]
fn eight_lanes_have_the_bits_of_one() {
    for i in 0..500 {
        let pose = |lane: usize| {
            let t = (i * WIDE + lane) as f64;
            let (sin, cos) = sin_cos(3.0 * (0.37 * t).sin());
            [0.1 * (0.11 * t).sin(), 0.03 + 0.017 * (0.23 * t).sin(), cos, sin]
        };
        let lanes: [[f64; 4]; WIDE] = std::array::from_fn(pose);
        let rows = std::array::from_fn(|k| lanes.map(|pose| pose[k]));
        let wide = run_wide(Wrenches(&rows));
        for (lane, [dx, dy, cos, sin]) in lanes.into_iter().enumerate() {
            for (row, scalar) in wide.iter().zip(everything(dx, dy, cos, sin)) {
                assert_eq!(row[lane].to_bits(), scalar.to_bits());
            }
        }
    }
}
