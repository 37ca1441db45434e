//! Rods at rest with a magnet at the tip: a couple bends them to circular arcs.

use crate::report::{Axes, Case, Figure};
use crate::statics::{
    LENGTH_M, MESHES, RELAXED, Refined, Tipped, cantilever, farthest_from_two, settle,
};
use crate::world::{CURVATURES, ROD, World, number};
use std::f64::consts::PI;

const MAGNET: &str = "width_m=0.009,height_m=0.003,remanence_t=1.22,density_kg_m3=7500";
const THICK: (&str, &str) = ("body.thickness_m", "4e-3");
/// EI [N·m²]: 100 kPa, 10 mm × 4 mm.
const RIGIDITY: f64 = 100e3 * 0.01 * 4e-3 * 4e-3 * 4e-3 / 12.0;

/// A rod in a uniform field, and the flux density that gives c = m B L/EI = 1, with m = Br V/μ0.
fn magnetic(soft_elements: usize, curvature: &str, damping_s: &str) -> (World, f64) {
    let tipped = Tipped::new(soft_elements);
    let moment = 1.22 * tipped.magnet_m * 0.009 * 0.003 / (4e-7 * PI);
    let [length, elements, placed] = tipped.body(soft_elements);
    let magnet = format!("{{length_m={},{MAGNET}}}", number(tipped.magnet_m));
    let edits = [
        ("body.length_m", length.as_str()),
        ("body.elements", &elements),
        THICK,
        ("magnet", &magnet),
        ("body.magnets", &placed),
        ("field", "{x_t=0.0,y_t=0.0}"),
        ("solver.curvature", curvature),
        ("material.damping_time_s", damping_s),
    ];
    (cantilever(soft_elements, 100e3, &edits), RIGIDITY / (moment * LENGTH_M))
}

/// Turns the field to an angle from the moment's direction at rest, +y.
fn set_field(world: &mut World, strength_t: f64, angle: f64) {
    let field = world.model.program.uniform_field.as_mut().expect("a field");
    field.field_t = [-strength_t * angle.sin(), strength_t * angle.cos(), 0.0];
}

fn tip_angle(world: &World) -> f64 {
    world.block.planar_pose(&world.model, 0, 0)[2]
}

/// End of an arc of length 1 that starts along x and turns by θ.
fn arc(theta: f64) -> [f64; 2] {
    [theta.sin() / theta, (1.0 - theta.cos()) / theta]
}

/// Where the soft rod ends, over L.
fn end(world: &World) -> [f64; 2] {
    world.node(world.last() - 1).map(|x| x / LENGTH_M)
}

fn off(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// A couple M at the tip bends the rod to an arc with θ = ML/EI. The couple is that of a field which the test keeps
/// perpendicular to the magnet's moment, step by step. With κ = φ every node turns by M l/EI as the arc does, so the
/// tip's angle is exact to the settling speed, and its place of second order.
#[test]
fn validates_end_moment() {
    let edits =
        [("body.magnets", "[{position_m=…,polarity=1}]"), ("field", "{x_t=…,y_t=…}"), THICK];
    let mut case = Case::new("end_moment", "Couple at the tip")
        .equation("θ(L) = ML/EI; tip at L (sin θ/θ, (1 − cos θ)/θ)")
        .source(
            "Euler–Bernoulli; a standard patch test of rods, e.g. J. C. Simo, L. Vu-Quoc, \
            Comput. Methods Appl. Mech. Eng. 58 (1986) 79",
        )
        .scene(ROD, &[&RELAXED[..1], &RELAXED[2..], &edits[..]].concat())
        .note(
            "The couple is m × B of a magnet at the tip, one element long, in a uniform field \
            that the test turns between the steps, so that it stays perpendicular to the magnet; \
            such a couple feeds vibrations, hence τ = 0.2 s. m = Br V/μ0. With κ = φ each node \
            turns by Ml/EI as the arc does: the tip's angle has no error of the mesh, its place \
            is of second order. κ = 2 tan(φ/2) has no band here.",
        );
    let mut refined = Refined::new("Couple at the tip: error of the tip", "error / L");
    let mut shapes = Figure::new("Couple at the tip, 40 elements", "x / L", "y / L", Axes::Equal);
    for (name, theta) in [("π/2", 0.5 * PI), ("π", PI), ("2π", 2.0 * PI)] {
        let curve = (1..=100).map(|k| {
            let s = f64::from(k) / 100.0;
            arc(theta * s).map(|x| s * x)
        });
        shapes.exact("", curve);
        let errors = CURVATURES.map(|(curvature, law)| {
            let errors = MESHES.map(|n| {
                let world = turned(n, theta, curvature);
                if n == 40 {
                    let band = if curvature == CURVATURES[0].0 { 1e-8 } else { f64::INFINITY };
                    case.relative(
                        format!("tip angle, ML/EI = {name}, 40 elements, {law}"),
                        "rad",
                        [tip_angle(&world), theta],
                        band,
                    );
                    case.place(
                        format!("tip, ML/EI = {name}, 40 elements, {law}"),
                        "L",
                        [end(&world), arc(theta)],
                        band.max(1e-3),
                    );
                    if curvature == CURVATURES[0].0 {
                        shapes.points(format!("ML/EI = {name}"), world.shape(LENGTH_M));
                    }
                }
                off(end(&world), arc(theta))
            });
            case.inside(
                format!("order, ML/EI = {name}, {law}"),
                "",
                farthest_from_two(&errors),
                1.8..=2.2,
            );
            errors
        });
        refined.add(&format!("ML/EI = {name}"), &errors);
    }
    refined.report(&mut case, "Distance of the soft rod's end from the arc's, over L:");
    case.figure(shapes);
    case.finish();
}

fn turned(soft_elements: usize, theta: f64, curvature: &str) -> World {
    let (mut world, unit_t) = magnetic(soft_elements, curvature, "0.2");
    for step in 0..20_000 {
        // From the moment, at the magnet's angle from +y, a quarter turn on.
        let at = tip_angle(&world) + 0.5 * PI;
        set_field(&mut world, theta * unit_t, at);
        world.steps(1);
        if step % 100 == 99 && world.fastest(0).max(world.fastest(1)) < 1e-10 {
            return world;
        }
    }
    panic!("still moving: {:e} m/s", world.fastest(1));
}

/// A magnet at the tip in a uniform field bends the rod to an arc with θ = c sin(φ − θ), φ the angle from the moment at
/// rest to the field. For φ = 90°, c = 0.5, 1, 2: 25.794°, 42.346°, 59.007°.
#[test]
fn validates_tip_magnet() {
    let edits =
        [("body.magnets", "[{position_m=…,polarity=1}]"), ("field", "{x_t=…,y_t=…}"), THICK];
    let mut case = Case::new("tip_magnet", "Magnet at the tip in a uniform field")
        .equation("θ = c sin(φ − θ), c = mBL/EI; the rod is an arc of angle θ")
        .source(
            "Balance of m × B and EI θ/L; solved in the test by bisection. For φ = 90°: \
            25.794°, 42.346°, 59.007°",
        )
        .scene(ROD, &[&RELAXED[..], &edits[..]].concat())
        .note(
            "m = Br V/μ0; the magnet at the tip is one element long. φ is the angle from the \
            moment at rest to the field.",
        );
    let mut refined = Refined::new("Magnet at the tip, φ = 90°: error of the tip", "error / L");
    for (load, quoted_deg) in [(0.5, 25.794), (1.0, 42.346), (2.0, 59.007f64)] {
        let theta = balance(load, 0.5 * PI);
        assert!((theta.to_degrees() - quoted_deg).abs() < 1e-3, "{}", theta.to_degrees());
        let errors = CURVATURES.map(|(curvature, law)| {
            MESHES.map(|n| {
                let (mut world, unit_t) = magnetic(n, curvature, "0.02");
                set_field(&mut world, load * unit_t, 0.5 * PI);
                settle(&mut world);
                if n == 40 {
                    let angles = [tip_angle(&world), theta].map(f64::to_degrees);
                    case.relative(format!("θ, c = {load}, 40 elements, {law}"), "°", angles, 1e-3);
                    case.place(
                        format!("tip, c = {load}, 40 elements, {law}"),
                        "L",
                        [end(&world), arc(theta)],
                        1e-3,
                    );
                }
                off(end(&world), arc(theta))
            })
        });
        for ((_, law), errors) in CURVATURES.iter().zip(&errors) {
            case.inside(
                format!("order, c = {load}, {law}"),
                "",
                farthest_from_two(errors),
                1.8..=2.2,
            );
        }
        refined.add(&format!("c = {load}"), &errors);
    }
    let mut errors = Vec::new();
    for load in [0.5, 1.0, 2.0, 4.0] {
        for degrees in [15.0, 45.0, 120.0, 150.0, 170.0f64] {
            let (mut world, unit_t) = magnetic(40, CURVATURES[0].0, "0.02");
            set_field(&mut world, load * unit_t, degrees.to_radians());
            settle(&mut world);
            errors.push(tip_angle(&world) / balance(load, degrees.to_radians()) - 1.0);
        }
    }
    case.spread(
        "θ, c = 0.5, 1, 2, 4 at φ = 15°, 45°, 120°, 150°, 170°, κ = φ",
        "relative",
        &errors,
        1e-3,
    );
    refined.report(&mut case, "φ = 90°: distance of the soft rod's end from the arc's, over L:");
    case.finish();
}

/// The root θ of θ = c sin(φ − θ) between 0 and φ.
fn balance(load: f64, phi: f64) -> f64 {
    let (mut low, mut high) = (0.0, phi);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if middle < load * (phi - middle).sin() { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// In the field opposite to its magnet, φ = 180°, the rod buckles at c = 1: θ = c sin θ. After a push it stays straight
/// at 0.98 and 0.995 and goes to the root at 1.005 and more.
#[test]
fn validates_pitchfork() {
    let edits =
        [("body.magnets", "[{position_m=…,polarity=1}]"), ("field", "{x_t=0.0,y_t=…}"), THICK];
    let mut case = Case::new("pitchfork", "Magnet opposite to the field")
        .equation(
            "θ = c sin θ, c = mBL/EI: θ = 0 alone for c ≤ 1, two bent states beyond \
            (pitchfork)",
        )
        .source("The equation of the magnet at the tip, φ = 180°; solved in the test by bisection")
        .scene(ROD, &[&RELAXED[..], &edits[..]].concat())
        .note(
            "The rod gets a push of 0.05 rad/s and settles. Near c = 1 the angle is \
            ill-conditioned, θ ≈ √(6 (c − 1)).",
        );
    let mut fork = Figure::new("Magnet opposite to the field", "c = mBL/EI", "θ [°]", Axes::Linear);
    let mut found = Vec::new();
    for load in [0.9, 0.98, 0.995, 1.005, 1.02, 1.1, 1.5, 2.0] {
        let (mut world, unit_t) = magnetic(40, CURVATURES[0].0, "0.02");
        set_field(&mut world, load * unit_t, PI);
        world.set_motion([0.0, 0.0], 0.05);
        settle(&mut world);
        let theta = tip_angle(&world);
        found.push([load, theta.to_degrees()]);
        if load < 1.0 {
            case.at_most(
                format!("|θ|, c = {load}: stays straight"),
                "°",
                theta.abs().to_degrees(),
                1e-5,
            );
        } else {
            let exact = buckled(load);
            case.relative(format!("θ, c = {load}"), "°", [theta, exact].map(f64::to_degrees), 1e-3);
        }
    }
    let curve = (0..=100).map(|k| 1.0 + 1e-6 + f64::from(k) / 100.0);
    let branch = curve.map(|load| [load, buckled(load).to_degrees()]);
    fork.exact("θ = c sin θ", [[0.9, 0.0], [1.0, 0.0]].into_iter().chain(branch));
    fork.points("simulator", found);
    case.figure(fork);
    case.finish();
}

/// The positive root of θ = c sin θ, c > 1.
fn buckled(load: f64) -> f64 {
    let (mut low, mut high) = (1e-6, PI);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if middle < load * middle.sin() { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
