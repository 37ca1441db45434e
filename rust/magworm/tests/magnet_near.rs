//! Wrenches between magnets that touch, nearly touch or are far away, at the default order.

use magworm::internals::magnetic::{
    GaussLegendre, MU_0, Magnet, Overlap, Wrench, dipole_wrench, field_t, wrench,
};
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

const ORDER: usize = 5;
const GAPS_M: [f64; 8] = [0.0, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 3e-4, 1e-3];
/// Sizes of drives and of bodies [m].
const SIZES: [[[f64; 3]; 2]; 4] = [
    [[0.02, 0.02, 0.002], [0.02, 0.02, 0.002]],
    [[0.01, 0.01, 0.01], [0.004, 0.004, 0.002]],
    [[0.008, 0.01, 0.002], [0.04, 0.03, 0.004]],
    [[0.0113, 0.0063, 0.003], [0.0113, 0.0063, 0.003]],
];

fn magnet(size_m: [f64; 3], remanence_t: [f64; 3]) -> Magnet {
    Magnet { size_m: size_m.into(), remanence_t: remanence_t.into() }
}

/// Difference over the force, and over the torque, where no torque counts as a tenth of the force at half the body.
fn assert_close(found: &Wrench, exact: &Wrench, body: &Magnet, tolerance: f64, what: &str) {
    let force = exact.force_n.norm();
    let torque = exact.torque_n_m.norm() + 0.1 * force * 0.5 * body.size_m.norm();
    let off = (found.force_n - exact.force_n).norm() / force;
    let turned = (found.torque_n_m - exact.torque_n_m).norm() / torque;
    assert!(
        off <= tolerance && turned <= tolerance,
        "{what}: {off:e} {turned:e}\n{found:?}\n{exact:?}"
    );
}

/// Force [N] between two cuboids with parallel edges, both magnetised along z with 1 T (G. Akoun, J.-P. Yonnet, IEEE
/// Trans. Magn. 20 (1984) 1962).
fn closed_form_n(drive: [f64; 3], body: [f64; 3], offset: [f64; 3]) -> Vector3<f64> {
    let corner = |axis: usize, of: usize| {
        let side = |bit: usize| if of >> bit & 1 == 0 { 1.0 } else { -1.0 };
        offset[axis] + 0.5 * (side(0) * body[axis] - side(1) * drive[axis])
    };
    let mut sum = Vector3::zeros();
    for k in 0..64_usize {
        let [u, v, w] = [corner(0, k), corner(1, k >> 2), corner(2, k >> 4)];
        let r = (u * u + v * v + w * w).sqrt();
        let turn = if u * v == 0.0 { 0.0 } else { (u * v / (r * w)).atan() };
        // ln(r − u), of which nothing cancels; where it is infinite its factor is 0.
        let log = |side: f64, rest: f64| match (rest == 0.0, side > 0.0) {
            (true, _) => (r - side).max(f64::MIN_POSITIVE).ln(),
            (false, true) => (rest / (r + side)).ln(),
            (false, false) => (r - side).ln(),
        };
        let (lu, lv) = (log(u, v * v + w * w), log(v, u * u + w * w));
        let term = Vector3::new(
            0.5 * (v * v - w * w) * lu + u * v * lv + v * w * turn + 0.5 * r * u,
            0.5 * (u * u - w * w) * lv + u * v * lu + u * w * turn + 0.5 * r * v,
            -u * w * lu - v * w * lv + u * v * turn - r * w,
        );
        sum += if k.count_ones() % 2 == 0 { term } else { -term };
    }
    sum / (4.0 * PI * MU_0)
}

#[test]
fn validates_the_force_between_parallel_magnets_against_the_closed_form() {
    for [drive, body] in SIZES {
        // Beside each other along x, y and z, centred and shifted.
        for (axis, shift) in (0..9).map(|k| (k % 3, 0.001 * (k / 3) as f64)) {
            for gap_m in GAPS_M {
                let mut offset = [1.3 * shift, -0.7 * shift, 0.4 * shift];
                // The closed form has no value in contact; the force changes by less than 1e-8 within a picometre.
                offset[axis] = 0.5 * (drive[axis] + body[axis]) + gap_m;
                let mut apart = offset;
                apart[axis] += if gap_m == 0.0 { 1e-12 } else { 0.0 };
                let exact = closed_form_n(drive, body, apart);
                let (drive, body) = (magnet(drive, [0.0, 0.0, 1.0]), magnet(body, [0.0, 0.0, 1.0]));
                let turn = UnitQuaternion::identity();
                let found = wrench(&drive, &body, offset.into(), turn, ORDER).unwrap().force_n;
                let error = (found - exact).norm() / exact.norm();
                assert!(error <= 2e-6, "axis {axis}, {offset:?}: {error:e} {found:?} {exact:?}");
            }
        }
    }
}

/// Nodes and weights on intervals between ascending ends, dense at each end, for integrands that are singular there
/// (H. Takahasi, M. Mori, Publ. RIMS 9 (1974) 721).
fn graded(ends: &[f64]) -> Vec<[f64; 2]> {
    let step = 0.09;
    let interval = |pair: &[f64]| {
        let (centre, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        (-34..=34).map(move |k| {
            let t = step * f64::from(k);
            let inner = FRAC_PI_2 * t.sinh();
            let weight = step * FRAC_PI_2 * t.cosh() / inner.cosh().powi(2);
            [centre + half * inner.tanh(), half * weight]
        })
    };
    ends.windows(2).flat_map(interval).collect()
}

/// Charges of the body in the drive's field, cut along the edges of the drive: exact for parallel edges, whatever the
/// gap. No part of it is shared with [`wrench`] but the field.
fn charges_cut_at_edges(drive: &Magnet, body: &Magnet, position: Vector3<f64>) -> Wrench {
    let (h, half) = (0.5 * body.size_m, 0.5 * drive.size_m);
    let nodes = [0, 1, 2].map(|k| {
        let edges = [-h[k], -half[k] - position[k], half[k] - position[k], h[k]];
        let mut ends: Vec<f64> = edges.into_iter().filter(|end| end.abs() <= h[k]).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        graded(&ends)
    });
    let mut total = Wrench::default();
    for n in (0..3).filter(|&n| body.remanence_t[n] != 0.0) {
        let (s, t) = ((n + 1) % 3, (n + 2) % 3);
        for side in [-1.0, 1.0] {
            for [xs, ws] in &nodes[s] {
                for [xt, wt] in &nodes[t] {
                    let mut r = Vector3::zeros();
                    (r[n], r[s], r[t]) = (side * h[n], *xs, *xt);
                    let charge = side * body.remanence_t[n] * ws * wt / MU_0;
                    let force = field_t(drive.size_m, drive.remanence_t, position + r) * charge;
                    total.force_n += force;
                    total.torque_n_m += r.cross(&force);
                }
            }
        }
    }
    total
}

#[test]
fn validates_force_and_torque_in_contact_against_charges_cut_at_edges() {
    let remanences = [
        [[0.0, 0.0, 1.22], [0.0, 0.0, 1.22]],
        [[1.22, 0.0, 0.0], [0.0, 0.0, -1.22]],
        [[0.4, -0.7, 0.9], [-0.3, 0.8, 0.5]],
    ];
    for ([drive, body], gap_m) in SIZES.into_iter().zip([0.0, 1e-6, 0.0, 1e-4]) {
        for [of_drive, of_body] in remanences {
            let (drive, body) = (magnet(drive, of_drive), magnet(body, of_body));
            let mut position = Vector3::new(0.0031, 0.0017, 0.0);
            position.z = 0.5 * (drive.size_m.z + body.size_m.z) + gap_m;
            let exact = charges_cut_at_edges(&drive, &body, position);
            let turn = UnitQuaternion::identity();
            let found = wrench(&drive, &body, position, turn, ORDER).unwrap();
            assert_close(&found, &exact, &body, 1e-5, &format!("{drive:?} {body:?} {position:?}"));
        }
    }
}

/// A body on the drive's upper face, turned, so that its lowest point is `gap_m` above it.
fn placed(drive: &Magnet, body: &Magnet, turn: &UnitQuaternion<f64>, gap_m: f64) -> Vector3<f64> {
    let rows = turn.to_rotation_matrix();
    let reach = rows.matrix().row(2).abs().transpose().dot(&(0.5 * body.size_m));
    Vector3::new(0.0013, -0.0021, 0.5 * drive.size_m.z + gap_m + reach)
}

fn tilts() -> [UnitQuaternion<f64>; 5] {
    let about = |x, y, z| UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z));
    [
        about(0.0, 0.02, 0.0),
        about(0.1, 0.05, 0.0),
        about(0.0, 0.0, 0.4),
        about(0.9, -0.6, 1.1),
        about(FRAC_PI_2, 0.0, 0.0),
    ]
}

#[test]
fn validates_tilted_magnets_against_refined_panels() {
    let (drive, body) =
        (magnet(SIZES[0][0], [0.0, 0.0, 1.22]), magnet(SIZES[0][1], [0.2, 0.3, 1.1]));
    let (rule, panels) = (GaussLegendre::new(8), 80);
    let nodes: Vec<[f64; 2]> = (0..panels)
        .flat_map(|panel| {
            let centre = f64::from(2 * panel + 1 - panels) / f64::from(panels);
            rule.points().map(move |(x, w)| [x / f64::from(panels) + centre, w / f64::from(panels)])
        })
        .collect();
    for turn in tilts() {
        for gap_m in [2e-4, 1e-3] {
            let position = placed(&drive, &body, &turn, gap_m);
            let mut exact = Wrench::default();
            for n in 0..3 {
                let (s, t) = ((n + 1) % 3, (n + 2) % 3);
                let h = 0.5 * body.size_m;
                for ([xs, ws], [xt, wt]) in
                    nodes.iter().flat_map(|a| nodes.iter().map(move |b| (a, b)))
                {
                    for side in [-1.0, 1.0] {
                        let mut r = Vector3::zeros();
                        (r[n], r[s], r[t]) = (side * h[n], xs * h[s], xt * h[t]);
                        let r = turn * r;
                        let charge = side * body.remanence_t[n] * h[s] * h[t] * ws * wt / MU_0;
                        let force = field_t(drive.size_m, drive.remanence_t, position + r) * charge;
                        exact.force_n += force;
                        exact.torque_n_m += r.cross(&force);
                    }
                }
            }
            let found = wrench(&drive, &body, position, turn, ORDER).unwrap();
            assert_close(&found, &exact, &body, 1e-5, &format!("{turn:?}, {gap_m} m"));
        }
    }
}

#[test]
fn action_equals_reaction_in_contact() {
    for [drive, body] in SIZES {
        let (drive, body) = (magnet(drive, [0.4, -0.7, 0.9]), magnet(body, [-0.3, 0.8, 0.5]));
        for (turn, gap_m) in tilts().into_iter().flat_map(|turn| GAPS_M.map(|gap_m| (turn, gap_m)))
        {
            let position = placed(&drive, &body, &turn, gap_m);
            let on_body = wrench(&drive, &body, position, turn, ORDER).unwrap();
            let back = turn.inverse();
            let on_drive = wrench(&body, &drive, back * -position, back, ORDER).unwrap();
            let torque = on_body.torque_n_m + position.cross(&on_body.force_n);
            let found = Wrench { force_n: back * -on_body.force_n, torque_n_m: back * -torque };
            assert_close(&found, &on_drive, &drive, 1e-5, &format!("{turn:?}, {gap_m} m"));
        }
    }
}

/// B [T] at a place, of a dipole of this moment times μ0 [T·m³].
fn dipole_field_t(moment: Vector3<f64>, at: Vector3<f64>) -> Vector3<f64> {
    let (r, e) = (at.norm(), at.normalize());
    (e * (3.0 * moment.dot(&e)) - moment) / (4.0 * PI * r.powi(3))
}

#[test]
fn validates_that_far_magnets_become_dipoles() {
    let sizes = [[1.0, 1.0, 1.0], [1.0, 0.75, 0.1], [0.3, 1.0, 1.0]];
    let direction = Vector3::new(0.3, 0.1, 1.0).normalize();
    for size in sizes {
        let (drive, body) = (magnet(size, [0.1, -0.2, 1.0]), magnet(size, [0.5, 1.0, 0.2]));
        let moment = |magnet: &Magnet| magnet.remanence_t * magnet.size_m.product();
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, 0.5, 0.3));
        let mut greatest = [0.01_f64; 2];
        for distance in [29.0, 31.0, 1e2, 1e3, 1e4, 1e5, 1e6] {
            let at = direction * distance;
            let found = wrench(&drive, &body, at, turn, ORDER).unwrap();
            let dipole = dipole_wrench(moment(&drive), turn * moment(&body), at);
            let (field, exact) =
                (field_t(drive.size_m, drive.remanence_t, at), dipole_field_t(moment(&drive), at));
            let errors = [
                (found.force_n - dipole.force_n).norm() / dipole.force_n.norm(),
                (field - exact).norm() / exact.norm(),
            ];
            for (error, greatest) in errors.into_iter().zip(&mut greatest) {
                // The next multipole falls with the square of the distance.
                assert!(error <= greatest.max(1e-14), "{size:?} at {distance}: {error:e}");
                assert!(distance < 1e4 || error < 1e-6, "{size:?} at {distance}: {error:e}");
                *greatest = if distance < 100.0 { error } else { 0.02 * error };
            }
        }
    }
}

#[test]
fn magnets_pass_over_into_their_far_form_without_a_jump() {
    for size in [[1.0, 1.0, 1.0], [1.0, 0.75, 0.1]] {
        let (drive, body) = (magnet(size, [0.1, -0.2, 1.0]), magnet(size, [0.5, 1.0, 0.2]));
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, 0.5, 0.3));
        let direction = Vector3::new(0.3, 0.1, 1.0).normalize();
        let [inside, outside] = [30.0 - 1e-9, 30.0 + 1e-9].map(|distance| {
            let at = direction * distance;
            let field = field_t(drive.size_m, drive.remanence_t, at);
            (wrench(&drive, &body, at, turn, ORDER).unwrap(), field)
        });
        let jump = (inside.1 - outside.1).norm() / outside.1.norm();
        assert!(jump < 1e-9, "{jump:e}");
        assert_close(&inside.0, &outside.0, &body, 1e-7, "at 30 sizes");
    }
}

#[test]
fn magnets_that_overlap_are_refused_and_those_that_touch_are_not() {
    let (drive, body) =
        (magnet([0.04, 0.03, 0.004], [0.0, 0.0, 1.0]), magnet([0.01; 3], [0.0, 0.0, 1.0]));
    for turn in tilts() {
        for depth_m in [1e-9, 1e-6, 1e-3] {
            let at = placed(&drive, &body, &turn, -depth_m);
            let Err(Overlap { depth_m: found }) = wrench(&drive, &body, at, turn, ORDER) else {
                panic!("{turn:?} at {at:?} overlap by {depth_m}")
            };
            assert!((found / depth_m - 1.0).abs() < 1e-6, "{found} is not {depth_m}");
        }
        assert!(wrench(&drive, &body, placed(&drive, &body, &turn, 0.0), turn, ORDER).is_ok());
    }
    assert!(wrench(&drive, &body, Vector3::zeros(), UnitQuaternion::identity(), ORDER).is_err());
}
