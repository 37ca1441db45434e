//! Twist of a clamped rod under a couple about its axis.

use crate::report::Case;
use crate::statics::{LENGTH_M, RELAXED, Tipped};
use crate::world::{ROD, World, number};
use std::f64::consts::PI;

const MODULUS_PA: f64 = 300e3;
/// G = E/2(1 + ν) at ν = 1/2.
const SHEAR_PA: f64 = MODULUS_PA / 3.0;
const MAGNET_M: [f64; 2] = [0.0019, 0.0019];

/// J of a rectangle as Roark gives it.
fn roark(width: f64, thickness: f64) -> f64 {
    let (b, h) = (width.max(thickness), width.min(thickness));
    b * h.powi(3) * (1.0 / 3.0 - 0.21 * (h / b) * (1.0 - (h / b).powi(4) / 12.0))
}

/// J of a rectangle by Saint-Venant's series.
fn saint_venant(width: f64, thickness: f64) -> f64 {
    let (b, h) = (width.max(thickness), width.min(thickness));
    let odd = (0..200).map(|k| f64::from(2 * k + 1));
    let sum: f64 = odd.map(|n| (0.5 * n * PI * b / h).tanh() / n.powi(5)).sum();
    b * h.powi(3) / 3.0 * (1.0 - 192.0 / PI.powi(5) * (h / b) * sum)
}

/// ψ = c cos ψ.
fn rest(c: f64) -> f64 {
    let (mut low, mut high) = (0.0, 0.5 * PI);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle < c * f64::cos(middle) { low = middle } else { high = middle }
    }
    low
}

/// A rod whose tip magnet a field along z turns about x, with mBL = c GJ.
fn twisted(soft: usize, [width, thickness]: [f64; 2], c: f64) -> World {
    let tipped = Tipped::new(soft);
    let moment = 1.22 * tipped.magnet_m * MAGNET_M[0] * MAGNET_M[1] / (4e-7 * PI);
    let field = c * SHEAR_PA * roark(width, thickness) / (moment * LENGTH_M);
    let [length, elements, placed] = tipped.body(soft);
    let magnet = format!(
        "{{length_m={},width_m={},height_m={},remanence_t=1.22,density_kg_m3=7500}}",
        number(tipped.magnet_m),
        MAGNET_M[0],
        MAGNET_M[1]
    );
    let (modulus, width, thickness) = (number(MODULUS_PA), number(width), number(thickness));
    let field = format!("{{x_t=0.0,y_t=0.0,z_t={}}}", number(field));
    let edits = [
        ("dimensions", "3"),
        ("material.youngs_modulus_pa", modulus.as_str()),
        ("material.poisson_ratio", "0.5"),
        ("body.length_m", &length),
        ("body.elements", &elements),
        ("body.width_m", &width),
        ("body.thickness_m", &thickness),
        ("magnet", &magnet),
        ("body.magnets", &placed),
        ("field", &field),
    ];
    World::new(ROD, &[&RELAXED[..], &edits].concat())
}

/// A magnet at the tip, magnetised upwards, in a field along z twists the rod until (GJ/L) ψ = m B cos ψ. The discrete
/// rod has the same compliance L/GJ whatever its mesh, so ψ is exact; the twist is spread evenly over the length.
#[test]
fn validates_space_twist_of_a_rod() {
    let mut case = Case::new("space_twist_of_a_rod", "Rod twisted by a couple at its tip")
        .equation(
            "ψ = T L/GJ with T = m B cos ψ; G = E/2(1 + ν), J = b h³ (1/3 − 0.21 (h/b) \
            (1 − h⁴/12b⁴)), h ≤ b",
        )
        .source(
            "A. J. C. B. de Saint-Venant (1855), the closed form of J: W. C. Young, R. G. Budynas, Roark's \
            Formulas for Stress and Strain, table of torsion; the series of J: S. P. Timoshenko, \
            J. N. Goodier, Theory of Elasticity, § 109",
        )
        .scene(ROD, &[&RELAXED[..], &[("dimensions", "3"), ("field", "{x_t=0.0,y_t=0.0,z_t=…}")]].concat())
        .note(
            "The tip's magnet is magnetised upwards, the field stands along z. ψ is the roll of \
            the magnet. The last rows compare J with Saint-Venant's series, \
            J = ⅓ b h³ (1 − 192 h/(π⁵ b) Σ tanh(nπb/2h)/n⁵) over odd n.",
        );
    let sections = [[4e-3, 4e-3], [8e-3, 4e-3], [2e-3, 6e-3], [0.02, 2e-3]];
    for section in sections {
        let [w, h] = section.map(|m| m * 1e3);
        for c in [0.5, 4.0] {
            let mut world = twisted(20, section, c);
            world.come_to_rest();
            let pose = world.block.magnet_pose(&world.model, 0, 0);
            // In this range the roll is the angle from y towards z.
            let up = pose.orientation * nalgebra::Vector3::y();
            let psi = up.z.atan2(up.y);
            case.relative(
                format!("ψ, w = {w} mm, h = {h} mm, mBL/GJ = {c}"),
                "rad",
                [psi, rest(c)],
                1e-9,
            );
            let even = (0..19).map(|k| world.block.twist[k][0] * 19.5 / psi - 1.0);
            let inner: Vec<f64> = even.collect();
            case.spread(
                format!("evenness of the twist, w = {w} mm, h = {h} mm, mBL/GJ = {c}"),
                "relative",
                &inner,
                1e-8,
            );
            let aside = world.places().iter().map(|p| p.y.hypot(p.z)).fold(0.0, f64::max);
            case.at_most(
                format!("distance from the axis, w = {w} mm, mBL/GJ = {c}"),
                "m",
                aside,
                1e-12,
            );
        }
    }
    for [w, h] in sections {
        let both = [magworm_constant(w, h), saint_venant(w, h)];
        case.relative(format!("J, w = {} mm, h = {} mm", w * 1e3, h * 1e3), "m⁴", both, 5e-3);
    }
    case.finish();
}

/// J as the simulator has it.
fn magworm_constant(width: f64, thickness: f64) -> f64 {
    let world = twisted(20, [width, thickness], 1.0);
    world.model.bend[5].twist_n_m * (LENGTH_M / 19.5) / SHEAR_PA
}
