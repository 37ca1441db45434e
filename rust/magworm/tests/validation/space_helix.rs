//! A rod that a couple at its tip bends and twists to a helix.

use crate::report::Case;
use crate::space_world::Vector;
use crate::statics::{LENGTH_M, MESHES, RELAXED, Refined, Tipped, farthest_from_two};
use crate::world::{CURVATURES, ROD, World, number};
use nalgebra::Rotation3;
use std::f64::consts::PI;

const SIDE_M: f64 = 4e-3;
const MODULUS_PA: f64 = 300e3;
const MAGNET_M: f64 = 3e-3;
/// EI and GJ [N·m²] of the square section at ν = 0.3.
const BENDING: f64 = MODULUS_PA * SIDE_M * SIDE_M * SIDE_M * SIDE_M / 12.0;
const TWISTING: f64 =
    MODULUS_PA / 2.6 * SIDE_M * SIDE_M * SIDE_M * SIDE_M * (1.0 / 3.0 - 0.21 * (1.0 - 1.0 / 12.0));

/// Turns of the material frame at s: exp(s M/EI) exp(s (1/GJ − 1/EI) (M·x) x).
fn frame(couple: Vector, s: f64) -> Rotation3<f64> {
    let spin = Vector::x() * ((1.0 / TWISTING - 1.0 / BENDING) * couple.x * s);
    Rotation3::new(couple * (s / BENDING)) * Rotation3::new(spin)
}

/// Place at s: the integral of the tangent by Simpson's rule.
fn place(couple: Vector, s: f64) -> Vector {
    let parts = 200;
    let h = s / f64::from(parts);
    let tangent = |k: f64| frame(couple, k * h) * Vector::x();
    let slice = |k: f64| (tangent(k) + tangent(k + 0.5) * 4.0 + tangent(k + 1.0)) * (h / 6.0);
    (0..parts).map(|k| slice(f64::from(k))).sum()
}

/// The couple M = m u(L) × B of a field B that makes m B L/EI the vector `load`: its strength is raised from 0 in steps,
/// each solved by Newton's method.
fn couple(load: Vector) -> Vector {
    let unit = BENDING / LENGTH_M;
    let mut found = Vector::zeros();
    for step in 1..=40 {
        let field = load * (f64::from(step) / 40.0);
        let miss = |m: Vector| (frame(m * unit, LENGTH_M) * Vector::y()).cross(&field) - m;
        for _ in 0..20 {
            let (here, by) = (miss(found), 1e-6);
            let columns = [Vector::x(), Vector::y(), Vector::z()]
                .map(|axis| (miss(found + axis * by) - miss(found - axis * by)) / (2.0 * by));
            let slope = nalgebra::Matrix3::from_columns(&columns);
            found -= slope.lu().solve(&here).expect("a regular slope");
        }
    }
    found * unit
}

fn coiled(soft: usize, load: Vector, curvature: &str) -> World {
    let tipped = Tipped::new(soft);
    let moment = 1.22 * tipped.magnet_m * MAGNET_M * MAGNET_M / (4e-7 * PI);
    let field = load * (BENDING / (moment * LENGTH_M));
    let [length, elements, placed] = tipped.body(soft);
    let magnet = format!(
        "{{length_m={},width_m={MAGNET_M},height_m={MAGNET_M},remanence_t=1.22,density_kg_m3=7500}}",
        number(tipped.magnet_m),
    );
    let (modulus, side) = (number(MODULUS_PA), number(SIDE_M));
    let [x, y, z] = [field.x, field.y, field.z].map(number);
    let field = format!("{{x_t={x},y_t={y},z_t={z}}}");
    let edits = [
        ("dimensions", "3"),
        ("material.youngs_modulus_pa", modulus.as_str()),
        ("material.poisson_ratio", "0.3"),
        ("body.length_m", &length),
        ("body.elements", &elements),
        ("body.width_m", &side),
        ("body.thickness_m", &side),
        ("magnet", &magnet),
        ("body.magnets", &placed),
        ("field", &field),
        ("solver.curvature", curvature),
    ];
    let mut world = World::new(ROD, &[&RELAXED[..], &edits].concat());
    world.come_to_rest();
    world
}

/// Where the soft rod ends.
fn end(world: &World) -> Vector {
    world.place(world.last() - 1)
}

/// Curvature, torsion and twist per length in the middle of the rod, from nodes and twist [1/m].
fn invariants(world: &World, soft: usize) -> [f64; 3] {
    let l = LENGTH_M / (soft as f64 - 0.5);
    let k = soft / 2;
    let t: Vec<Vector> = (k - 1..=k + 1).map(|e| world.tangent(e)).collect();
    let (b, c) = (t[0].cross(&t[1]), t[1].cross(&t[2]));
    let turn = b.norm().atan2(t[0].dot(&t[1]));
    let wind = b.cross(&c).dot(&t[1]).atan2(b.dot(&c) * t[1].norm());
    [turn / l, wind / l, world.block.twist[k - 1][0] / l]
}

/// Square section, no force, a couple M at the tip: M is the same all along. From t′ = (M/EI) × t the tangent turns
/// about M at the rate M/EI and M·t keeps its value M cos α: a helix about M with curvature M sin α/EI, torsion
/// M cos α/EI, and the section twists by M cos α/GJ. The frame is exp(s M/EI) exp(s (1/GJ − 1/EI) M cos α x̂).
#[test]
fn validates_space_helix() {
    let mut case = Case::new("space_helix", "Rod that a couple coils to a helix")
        .equation(
            "κ = M sin α/EI, torsion M cos α/EI, twist M cos α/GJ, α: angle of M to the tangent at \
            the wall; M = m u(L) × B",
        )
        .source(
            "G. Kirchhoff (1859); A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, \
            §§ 260–270; the couple of the field is solved for in the test",
        )
        .scene(ROD, &[&RELAXED[..], &[("dimensions", "3"), ("field", "…")]].concat())
        .note(
            "Square section, so the rod bends alike about all axes; ν = 0.3. A magnet at the tip, \
            magnetised upwards, in an oblique uniform field B turns it with a pure couple. B points along \
            (0.45, −0.55, 0.7), c = mBL/EI. Places are those of the soft rod's end.",
        );
    let direction = Vector::new(0.45, -0.55, 0.7).normalize();
    let mut refined = Refined::new("Helix: error of the end", "error / L");
    for c in [1.0, 3.0] {
        let load = direction * c;
        let exact = couple(load);
        let (far, turned) = (place(exact, LENGTH_M), frame(exact, LENGTH_M));
        let errors = CURVATURES.map(|(curvature, law)| {
            let errors = MESHES.map(|n| {
                let world = coiled(n, load, curvature);
                if n == 40 {
                    report(&mut case, &world, exact, turned, &format!("c = {c}, {law}"));
                }
                (end(&world) - far).norm() / LENGTH_M
            });
            let what = format!("end of the rod, c = {c}, 40 elements, {law}");
            case.at_most(what, "L", errors[2], 2e-4);
            let order = farthest_from_two(&errors);
            case.inside(format!("order, c = {c}, {law}"), "", order, 1.8..=2.2);
            errors
        });
        refined.add(&format!("c = {c}"), &errors);
    }
    refined.report(&mut case, "Distance of the end from the helix's, over L:");
    case.finish();
}

fn report(case: &mut Case, world: &World, couple: Vector, turned: Rotation3<f64>, what: &str) {
    let along = couple.x;
    let across = (couple.norm_squared() - along * along).sqrt();
    let expected = [across / BENDING, along / BENDING, along / TWISTING];
    for (k, name) in ["curvature", "torsion", "twist"].iter().enumerate() {
        let measured = invariants(world, 40)[k];
        case.relative(format!("{name}, {what}"), "1/m", [measured, expected[k]], 1e-3);
    }
    let pose = world.block.magnet_pose(&world.model, 0, 0).orientation.to_rotation_matrix();
    case.at_most(
        format!("orientation of the tip, {what}"),
        "rad",
        (pose.inverse() * turned).angle(),
        5e-4,
    );
}
