//! Bodies at the edge of what a scene can describe, under both schemes.

use crate::report::Case;
use crate::world::{ROD, World};

const WHOLE: &str =
    "{length_m=0.1,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}";
const SMALL: &str =
    "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}";
const GROUND: (&str, &str) = ("ground", "{static_friction=0.8,dynamic_friction=0.6}");

fn bodies() -> Vec<(&'static str, Vec<(&'static str, &'static str)>)> {
    vec![
        ("one element", vec![("body.elements", "1")]),
        ("all magnet", vec![("magnet", WHOLE), ("body.magnets", "[{position_m=0.05,polarity=1}]")]),
        (
            "magnet at the head",
            vec![("magnet", SMALL), ("body.magnets", "[{position_m=0.004,polarity=1}]")],
        ),
        (
            "magnets at both ends",
            vec![
                ("magnet", SMALL),
                ("body.magnets", "[{position_m=0.004,polarity=1},{position_m=0.096,polarity=1}]"),
            ],
        ),
        (
            "clamped, magnets",
            vec![
                ("body.clamp", "'head'"),
                ("magnet", SMALL),
                ("body.magnets", "[{position_m=0.03,polarity=1},{position_m=0.096,polarity=1}]"),
            ],
        ),
        ("clamped, two elements", vec![("body.clamp", "'head'"), ("body.elements", "2")]),
    ]
}

/// Dropped from 5 mm, each body lies on the ground with its weight and stays; the two schemes agree on the weight. The
/// clamped ones lie on the ground by their contact points' share of it and only have to come to rest.
#[test]
fn validates_odd_bodies_on_the_ground() {
    let mut failures = Vec::new();
    for (name, body) in bodies() {
        for (integrator, step) in [("'newmark'", "1e-3"), ("'explicit'", "1e-5")] {
            let mut edits = body.clone();
            edits.extend([GROUND, ("solver.integrator", integrator), ("solver.step_s", step)]);
            edits.extend([
                ("gravity_m_s2", "9.81"),
                ("start.height_m", "0.005"),
                ("material.damping_time_s", "1e-3"),
            ]);
            let mut world = World::new(ROD, &edits);
            world.run(1.0);
            let weight = world.mass_and_centre().0 * 9.81;
            let (ratio, speed) =
                (world.normal_force() / weight, world.fastest(0).max(world.fastest(1)));
            println!(
                "{name}, {integrator}: normal force {ratio:.9} of the weight, fastest {speed:.1e} m/s"
            );
            let clamped = world.model.mesh.fixed_nodes > 0;
            if !clamped && ((ratio - 1.0).abs() > 1e-6 || speed > 1e-6) || clamped && speed > 1e-2 {
                failures.push((name, integrator));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

/// A rigid magnet that is a whole rod turns in a uniform field like a compass: small oscillations at
/// ω = √(m B/I), I its own and its rubber's moment of inertia, m = Br V/μ0.
#[test]
fn validates_compass_needle() {
    let edits = [
        ("magnet", WHOLE),
        ("body.magnets", "[{position_m=0.05,polarity=1}]"),
        ("field", "{x_t=2e-5,y_t=0.02}"),
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "1e-4"),
    ];
    let mut world = World::new(ROD, &edits);
    let (length, volume) = (0.1f64, 0.1 * 0.008 * 0.002);
    let rubber_kg = 1000.0 * (0.1 * 0.01 * 0.004 - volume);
    let inertia = 7500.0 * volume * (length.powi(2) + 0.002f64.powi(2)) / 12.0
        + rubber_kg * (length.powi(2) + 0.004f64.powi(2)) / 12.0;
    let moment = 1.22 * volume / (4e-7 * std::f64::consts::PI);
    let exact = (moment * 0.02f64.hypot(2e-5) / inertia).sqrt();
    let (mut before, mut crossings) = (0.0f64, Vec::new());
    for step in 1.. {
        world.steps(1);
        // The needle's rest is 1 mrad clockwise; it swings from 0 to −2 mrad.
        let now = world.block.planar_pose(&world.model, 0, 0)[2] + 1e-3;
        if before * now < 0.0 {
            crossings.push(1e-4 * (f64::from(step) - now / (now - before)));
        }
        before = now;
        if crossings.len() == 9 {
            break;
        }
    }
    let omega = 8.0 * std::f64::consts::PI / (crossings[8] - crossings[0]);
    let mut case = Case::new("compass_needle", "Compass needle")
        .equation("ω = √(mB/I), m = Br V/μ0, I of the magnet and of the rubber around it")
        .source("Small oscillations of a dipole in a uniform field, any textbook of magnetism")
        .scene(ROD, &edits)
        .note("The whole rod is one rigid magnet; it swings by 1 mrad.");
    // (ωΔt)²/24 = 1e-7 of the scheme, amplitude²/16 = 6e-8 of the pendulum.
    case.relative("ω", "rad/s", [omega, exact], 1e-5);
    case.finish();
}
