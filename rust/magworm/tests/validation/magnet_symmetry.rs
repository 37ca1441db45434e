//! Far field and symmetries of the planar wrench.

use crate::report::{Axes, Case, Figure, farthest_from, orders};
use magworm::internals::magnetic::{Cuboid, Magnet, PlanarDipole, PlanarPair, wrench};
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// Drive and body magnet of about the presets' size.
const DRIVE: Cuboid = Cuboid { length_m: 0.025, height_m: 0.003, width_m: 0.043 };
const BODY: Cuboid = Cuboid { length_m: 0.008, height_m: 0.002, width_m: 0.009 };
const STRENGTH: f64 = 1.22 * 1.22;

fn planar(dx: f64, dy: f64, angle: f64) -> [f64; 3] {
    PlanarPair::new(DRIVE, BODY, 3).wrench(dx, dy, angle.cos(), angle.sin(), STRENGTH)
}

/// Difference of two wrenches over |F|, with torques at the arm of the distance.
fn difference(a: [f64; 3], b: [f64; 3], distance: f64) -> f64 {
    let force = b[0].hypot(b[1]);
    let off = (a[0] - b[0]).hypot(a[1] - b[1]) / force;
    off.max((a[2] - b[2]).abs() / (force * distance))
}

/// 600 poses spread evenly, (x, y, angle) at all angles: x over a range about 0, y from a height on.
pub fn poses([wide, low, high]: [f64; 3]) -> impl Iterator<Item = [f64; 3]> {
    // Fractional parts of multiples of irrational numbers.
    let part = |k: u32, by: f64| (f64::from(k) * by).fract();
    (1..=600).map(move |k| {
        let [a, b, c] = [2f64, 3.0, 5.0].map(|n| part(k, n.sqrt()));
        [wide * (a - 0.5), low + high * b, PI * (2.0 * c - 1.0)]
    })
}

/// Mirrored at x = 0, mirrored at the drive's plane, and with the body's polarity flipped by half a turn, the wrench changes
/// signs as a mirror and a flipped charge do; and in space, poses in the plane have no force across it nor torques in it.
#[test]
fn validates_symmetries_of_the_wrench() {
    let mut case = Case::new("symmetries_of_the_wrench", "Symmetries of the wrench")
        .equation(
            "mirror x: (−F_x, F_y, −T); mirror y: (F_x, −F_y, −T); half a turn or opposite \
            polarity: −(F_x, F_y, T); out of the plane: F_z = T_x = T_y = 0",
        )
        .source("Mirror images of magnetic charges")
        .note(
            "600 poses: 80 mm to both sides, 12 to 62 mm above the drive, all angles. Errors \
            are parts of |F|, torques of |F| times the distance.",
        );
    let mut errors: [Vec<f64>; 5] = Default::default();
    let spatial = |cuboid: Cuboid| Magnet {
        size_m: Vector3::new(cuboid.length_m, cuboid.height_m, cuboid.width_m),
        remanence_t: 1.22 * Vector3::y(),
    };
    for [x, y, angle] in poses([0.16, 0.012, 0.05]) {
        let [fx, fy, t] = planar(x, y, angle);
        let far = x.hypot(y);
        errors[0].push(difference(planar(-x, y, -angle), [-fx, fy, -t], far));
        errors[1].push(difference(planar(x, -y, -angle), [fx, -fy, -t], far));
        errors[2].push(difference(planar(x, y, angle + PI), [-fx, -fy, -t], far));
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        let space = wrench(&spatial(DRIVE), &spatial(BODY), Vector3::new(x, y, 0.0), turn, 6);
        let space = space.expect("magnets apart");
        let (f, m) = (space.force_n, space.torque_n_m);
        errors[3].push(f.z.abs().max(m.x.hypot(m.y) / far) / f.norm());
        let exact = PlanarPair::new(DRIVE, BODY, 6);
        let inside = exact.wrench(x, y, angle.cos(), angle.sin(), STRENGTH);
        errors[4].push(difference(inside, [f.x, f.y, m.z], far));
    }
    let names = [
        "mirrored at x = 0",
        "mirrored at the drive's plane",
        "body turned by 180°",
        "in space: F_z, T_x, T_y",
        "planar against spatial, order 6",
    ];
    for ((name, errors), band) in
        names.into_iter().zip(&errors).zip([1e-9, 1e-9, 1e-9, 1e-12, 1e-6])
    {
        case.spread(name, "of |F|", errors, band);
    }
    case.finish();
}

/// Two magnets far apart are two dipoles; the error falls as the inverse square of the distance.
#[test]
fn validates_the_far_field() {
    let mut case = Case::new("the_far_field", "Far apart, cuboids are dipoles")
        .equation(
            "F = ∇(m·B), T = m × B with B = μ0 (3 (m̂·r̂) r̂ − m̂) m/(4π r³); difference ∝ \
            r⁻²",
        )
        .source(
            "K. W. Yung, P. B. Landecker, D. D. Villani, Magn. Electr. Sep. 9 (1998) 39; the \
            quadrupole of a cuboid vanishes, its octupole is r⁻² smaller",
        )
        .note(
            "Magnets of about the presets' size, along three directions. At the presets' \
            closest distance, 22 mm, dipoles are wrong by 0.4 to 3 times the wrench: the presets \
            use cuboids.",
        );
    let mut figure =
        Figure::new("Dipoles against cuboids", "distance [m]", "error of the wrench", Axes::LogLog)
            .slope(-2.0);
    let directions = [("above", 0.0, 0.5f64), ("45° ahead", 0.25, 1.2), ("beside", 0.5, 0.3)];
    for (name, turns, angle) in directions {
        let distances = [0.022, 0.044, 0.088, 0.176, 0.352, 0.704];
        let errors = distances.map(|r| {
            let (x, y) = (r * (PI * turns).sin(), r * (PI * turns).cos());
            PlanarDipole::relative_error(DRIVE, BODY, x, y, angle)
        });
        let found = orders(&errors[2..]);
        case.inside(
            format!("order in the distance beyond 88 mm, {name}"),
            "",
            farthest_from(2.0, &found),
            1.8..=2.2,
        );
        case.tell(format!("error at 22 mm, {name}"), "", errors[0]);
        case.tell(format!("error at 0.7 m, {name}"), "", errors[5]);
        figure.points(name, distances.into_iter().zip(errors).map(|(r, e)| [r, e]));
    }
    case.figure(figure);
    case.finish();
}
