//! The pair kernels of a step between magnets of any size, direction and relative rotation.

use magworm::internals::lanes::{Plane, Space, Vector};
use magworm::internals::magnetic::{
    GaussLegendre, MU_0, Magnet, ObliquePair, SpatialPair, field_t, reaction,
};
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::PI;

const ORDER: usize = 8;

/// Numbers spread evenly from −½ to ½: fractional parts of multiples of irrational numbers.
fn spread<const N: usize>(k: usize) -> [f64; N] {
    let primes = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67];
    std::array::from_fn(|n| ((k + 1) as f64 * f64::from(primes[n]).sqrt()).fract() - 0.5)
}

/// A pair of magnets with the body's centre and rotation.
struct Pose {
    drive: Magnet,
    body: Magnet,
    offset: Vector3<f64>,
    turn: UnitQuaternion<f64>,
}

/// In space, or with everything in the plane x–y.
fn pose(k: usize, in_plane: bool) -> Pose {
    let p: [f64; 18] = spread(k);
    let aside = if in_plane { 0.0 } else { 1.0 };
    let magnet = |size: f64, at: usize| Magnet {
        size_m: Vector3::new(p[at], p[at + 1], p[at + 2]) * size + Vector3::repeat(size),
        remanence_t: Vector3::new(p[at + 3], p[at + 4], aside * p[at + 5]) * 2.0,
    };
    Pose {
        drive: magnet(0.016, 0),
        body: magnet(0.006, 6),
        offset: Vector3::new(0.1 * p[12], 0.045 + 0.02 * p[13], aside * 0.1 * p[14]),
        turn: UnitQuaternion::from_scaled_axis(
            2.0 * PI * Vector3::new(aside * p[15], aside * p[16], p[17]),
        ),
    }
}

/// Charged faces of the body in the drive's field with 20 Gauss–Legendre points an edge, two panels of ten.
fn charges(pose: &Pose) -> [f64; 6] {
    let rule = GaussLegendre::new(10);
    let halves = |(x, w): (f64, f64)| [[0.5 * (x - 1.0), 0.5 * w], [0.5 * (x + 1.0), 0.5 * w]];
    let nodes: Vec<[f64; 2]> = rule.points().flat_map(halves).collect();
    let h = 0.5 * pose.body.size_m;
    let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
    for (n, side) in (0..3).flat_map(|n| [(n, 1.0), (n, -1.0)]) {
        let (s, t) = ((n + 1) % 3, (n + 2) % 3);
        for ([xs, ws], [xt, wt]) in nodes.iter().flat_map(|a| nodes.iter().map(move |b| (a, b))) {
            let mut r = Vector3::zeros();
            (r[n], r[s], r[t]) = (side * h[n], xs * h[s], xt * h[t]);
            let r = pose.turn * r;
            let charge = side * pose.body.remanence_t[n] * h[s] * h[t] * ws * wt / MU_0;
            let drive = &pose.drive;
            let f = field_t(drive.size_m, drive.remanence_t, pose.offset + r) * charge;
            force += f;
            torque += r.cross(&f);
        }
    }
    [force.x, force.y, force.z, torque.x, torque.y, torque.z]
}

fn in_space(pose: &Pose) -> [f64; 6] {
    let axes = pose.turn.to_rotation_matrix();
    let axes = [0, 1, 2].map(|k| axes.matrix().column(k).into_owned().into());
    SpatialPair::new(&pose.drive, &pose.body, ORDER).wrench(pose.offset.into(), axes)
}

fn in_plane(pose: &Pose) -> [f64; 3] {
    let along = pose.turn * Vector3::x();
    let (x, y) = (pose.offset.x, pose.offset.y);
    ObliquePair::new(&pose.drive, &pose.body, ORDER).wrench(x, y, along.x, along.y, 1.0)
}

/// Greatest difference over |F|, torques over half the body's diagonal.
fn difference(found: [f64; 6], exact: [f64; 6], pose: &Pose) -> f64 {
    let half = |wrench: [f64; 6], first: usize| Vector3::from_column_slice(&wrench[first..][..3]);
    let force = half(exact, 0).norm();
    let off = (half(found, 0) - half(exact, 0)).norm() / force;
    let arm = 0.5 * pose.body.size_m.norm();
    off.max((half(found, 3) - half(exact, 3)).norm() / (force * arm))
}

fn spatial([fx, fy, torque]: [f64; 3]) -> [f64; 6] {
    [fx, fy, 0.0, 0.0, 0.0, torque]
}

/// The magnet with its edges named anew, x for y and y for −x, as the same thing in a frame turned by a quarter.
fn renamed(magnet: &Magnet) -> Magnet {
    let (size, j) = (magnet.size_m, magnet.remanence_t);
    Magnet {
        size_m: Vector3::new(size.y, size.x, size.z),
        remanence_t: Vector3::new(-j.y, j.x, j.z),
    }
}

#[test]
fn validates_pairs_against_charges_at_20_points_an_edge() {
    for k in 0..100 {
        let space = pose(k, false);
        let error = difference(in_space(&space), charges(&space), &space);
        assert!(error <= 1e-7, "pose {k} in space: {error:e}");
        let plane = pose(k, true);
        let error = difference(spatial(in_plane(&plane)), charges(&plane), &plane);
        assert!(error <= 1e-7, "pose {k} in the plane: {error:e}");
    }
}

#[test]
fn a_body_with_its_edges_swapped_feels_the_same() {
    for k in 0..100 {
        for flat in [false, true] {
            let pose = pose(k, flat);
            let quarter = UnitQuaternion::from_scaled_axis(-0.5 * PI * Vector3::z());
            let swapped = Pose { body: renamed(&pose.body), turn: pose.turn * quarter, ..pose };
            let [one, other] = [&pose, &swapped].map(|pose| match flat {
                true => spatial(in_plane(pose)),
                false => in_space(pose),
            });
            let error = difference(other, one, &pose);
            assert!(error <= 1e-11, "pose {k}: {error:e}");
        }
    }
}

#[test]
fn a_drive_with_its_edges_swapped_acts_the_same() {
    for k in 0..100 {
        let pose = pose(k, true);
        let quarter = UnitQuaternion::from_scaled_axis(0.5 * PI * Vector3::z());
        let turned = Pose {
            drive: renamed(&pose.drive),
            body: pose.body,
            offset: quarter * pose.offset,
            turn: quarter * pose.turn,
        };
        let [fx, fy, torque] = in_plane(&turned);
        let error = difference(spatial([fy, -fx, torque]), spatial(in_plane(&pose)), &pose);
        assert!(error <= 1e-11, "pose {k}: {error:e}");
    }
}

#[test]
fn regresses_a_drive_that_lies_beneath_an_upright_magnet() {
    let drive = Magnet {
        size_m: Vector3::new(0.0149, 0.004033, 0.02618),
        remanence_t: Vector3::new(0.0, 1.22, 0.0),
    };
    let body = Magnet {
        size_m: Vector3::new(0.006303, 0.001628, 0.007455),
        remanence_t: Vector3::new(0.0, 1.22, 0.0),
    };
    let lying = Magnet {
        size_m: Vector3::new(drive.size_m.y, drive.size_m.x, drive.size_m.z),
        remanence_t: Vector3::new(-1.22, 0.0, 0.0),
    };
    let [fx, fy, torque] =
        ObliquePair::new(&lying, &body, ORDER).wrench(0.0, 0.0255, 1.0, 0.0, 1.0);
    assert!((fx + 79.2059e-3).abs() < 1e-7 && fy.abs() < 1e-12, "{fx} {fy}");
    assert!((torque + 0.639256e-3).abs() < 1e-9, "{torque}");
}

#[test]
fn the_drive_feels_what_the_body_would_do_to_it() {
    for k in 0..100 {
        let pose = pose(k, false);
        let back = pose.turn.inverse();
        let swapped =
            Pose { drive: pose.body, body: pose.drive, offset: back * -pose.offset, turn: back };
        let exact = in_space(&swapped);
        let turn = |first: usize| pose.turn * Vector3::from_column_slice(&exact[first..][..3]);
        let (force, torque) = (turn(0), turn(3));
        let exact = [force.x, force.y, force.z, torque.x, torque.y, torque.z];
        let [fx, fy, fz, tx, ty, tz] = in_space(&pose);
        let wrench = (Vector([fx, fy, fz]), Vector([tx, ty, tz]));
        let (Vector([fx, fy, fz]), Vector([tx, ty, tz])) =
            reaction::<Space, f64>(Vector(pose.offset.into()), wrench);
        let found = [fx, fy, fz, tx, ty, tz];
        let error = difference(found, exact, &swapped);
        assert!(error <= 1e-7, "pose {k}: {error:e}");
    }
}

#[test]
fn reactions_keep_both_momenta() {
    for k in 0..100 {
        let pose = pose(k, true);
        let (x, y) = (pose.offset.x, pose.offset.y);
        let [fx, fy, torque] = in_plane(&pose);
        let wrench = (Vector([fx, fy]), Vector([torque]));
        let (Vector([gx, gy]), Vector([back])) = reaction::<Plane, f64>(Vector([x, y]), wrench);
        assert_eq!([fx + gx, fy + gy], [0.0; 2]);
        assert!((torque + back + (x * fy - y * fx)).abs() <= 1e-15 * (fx.abs() + fy.abs()));
    }
}
