//! Blocks on inclines: Coulomb's law with its closed forms.

use crate::world::{World, number};

const G: f64 = 9.81;

/// Blocks of several thicknesses, soft and stiff, with and without magnets.
pub fn blocks() -> Vec<(&'static str, Vec<(&'static str, &'static str)>)> {
    let small = (
        "magnet",
        "{length_m=8e-3,width_m=0.010,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}",
    );
    let whole = (
        "magnet",
        "{length_m=0.054,width_m=0.010,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}",
    );
    let two = ("body.magnets", "[{position_m=0.01,polarity=1},{position_m=0.04,polarity=-1}]");
    let one = ("body.magnets", "[{position_m=0.027,polarity=1}]");
    vec![
        ("thin", vec![("body.thickness_m", "0.002")]),
        ("7 mm", vec![]),
        ("thick", vec![("body.thickness_m", "0.015")]),
        ("soft", vec![("material.youngs_modulus_pa", "80e3")]),
        ("two magnets", vec![small, two]),
        ("one rigid magnet, thin", vec![whole, one, ("body.thickness_m", "0.002001")]),
        ("one rigid magnet, 7 mm", vec![whole, one]),
        ("one rigid magnet, thick", vec![whole, one, ("body.thickness_m", "0.02")]),
        ("one element", vec![("body.elements", "1")]),
    ]
}

fn on_incline(angle_deg: f64, adhesion_n: f64, body: &[(&str, &str)]) -> World {
    let (angle, adhesion) = (number(angle_deg), number(adhesion_n));
    let mut edits = vec![
        ("ground.incline_deg", angle.as_str()),
        ("ground.adhesion_n", adhesion.as_str()),
        // Vibrations of the stiff block die out in a fraction of a second.
        ("material.damping_time_s", "0.02"),
    ];
    edits.extend_from_slice(body);
    World::new("incline-block", &edits)
}

/// Of bodies too thick for their elements the head end may lift off, which leaves D_f fewer points: they go
/// without it.
fn all_points_touch(name: &str) -> bool {
    name != "thick"
}

/// Friction angle tan α = μ_s + n D_f/(m g cos α) of n contact points, by iteration [°].
fn threshold_deg(static_friction: f64, adhesion_n: f64, world: &World) -> f64 {
    let (points, mass) = (world.model.contacts.len() as f64, world.mass_and_centre().0);
    let mut alpha = static_friction.atan();
    for _ in 0..100 {
        alpha = (static_friction + points * adhesion_n / (mass * G * alpha.cos())).atan();
    }
    alpha.to_degrees()
}

/// Speed after 2 s, and displacement in the second after.
fn creep(world: &mut World) -> f64 {
    world.run(2.0);
    let before = world.mass_and_centre().1[0];
    world.run(1.0);
    world.mass_and_centre().1[0] - before
}

/// A block holds 0.05° below the friction angle, creeping by no more than 1e-9 m/s once settled, and slides 0.05°
/// above it; with and without adhesion D_f.
#[test]
fn validates_friction_angle() {
    let mut failures = Vec::new();
    for (name, body) in blocks() {
        for adhesion in [0.0, 2e-4].into_iter().filter(|d| *d == 0.0 || all_points_touch(name)) {
            let threshold = threshold_deg(0.8, adhesion, &on_incline(0.0, 0.0, &body));
            let below = creep(&mut on_incline(threshold - 0.05, adhesion, &body));
            let above = creep(&mut on_incline(threshold + 0.05, adhesion, &body));
            println!(
                "friction angle {threshold:.3}°, {name}, D_f {adhesion} N: creep {below:.1e} m/s below, {above:.1e} above"
            );
            if below.abs() > 1e-9 || above < 1e-3 {
                failures.push(name);
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

/// Feet and whole robots, whose toes and heels feel the moment of friction at the sole and so share the weight
/// unequally: on 0.5° less than arctan 0.8 they hold, landing from 1 µm above or lying there; on 0.5° more they slide.
#[test]
fn validates_friction_angle_of_feet() {
    let one = ("body.magnets", "1");
    let filled = ("magnet.length_m", "0.014");
    // 12 mm on 14 mm: tips over at arctan(14/12) only.
    let tall = ("body.foot_thickness_m", "0.012");
    let bodies: [(&str, &[(&str, &str)]); 4] = [
        ("one foot", &[one]),
        ("one foot, all magnet", &[one, filled]),
        ("one tall foot, all magnet", &[one, filled, tall]),
        ("paper-3", &[]),
    ];
    let mut failures = Vec::new();
    for (name, body) in bodies {
        for height in ["0.0", "1e-6"] {
            let [below, above] = [-0.5, 0.5].map(|by| {
                let angle = number(0.8f64.atan().to_degrees() + by);
                let law = [("ground.static_friction", "0.8"), ("ground.dynamic_friction", "0.6")];
                let mut edits = vec![law[0], law[1], ("drive", ""), ("start.height_m", height)];
                edits.push(("ground.adhesion_n", "0.0"));
                edits.push(("ground.incline_deg", &angle));
                edits.extend_from_slice(body);
                creep(&mut World::new("paper-3", &edits))
            });
            println!(
                "friction angle ∓ 0.5°, {name} from {height} m: creep {below:.1e} m/s below, {above:.1e} above"
            );
            if below.abs() > 1e-9 || above < 1e-3 {
                failures.push((name, height));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

/// Above the friction angle a block slides with exactly g (sin α − μ_d cos α): 1e-6 of it once its vibrations
/// have died out. D_f takes n D_f/m off.
#[test]
fn validates_sliding_acceleration() {
    let mut failures = Vec::new();
    for (name, body) in blocks() {
        for (angle, adhesion) in [(39.0, 0.0), (60.0, 0.0), (60.0, 2e-4)] {
            let mut world = on_incline(angle, adhesion, &body);
            world.run(0.8);
            let before = world.drift()[0];
            world.run(0.2);
            let measured = (world.drift()[0] - before) / 0.2;
            let alpha = f64::to_radians(angle);
            // A thick block's head end lifts off a little; D_f acts where it touches.
            let closed = world.block.mode.iter().filter(|mode| mode[0] != 0.0).count();
            let held = closed as f64 * adhesion / world.mass_and_centre().0;
            let exact = G * (alpha.sin() - 0.6 * alpha.cos()) - held;
            let error = measured / exact - 1.0;
            println!(
                "slides at {angle}°, D_f {adhesion} N, {name}: {measured:.6} m/s², error {error:.1e}"
            );
            if error.abs() > 1e-6 {
                failures.push(name);
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

/// A block with speed v stops after v²/(2 μ_d g); a step that ends with its new velocity makes that
/// v²/(2 μ_d g) − ½ v Δt, and the last one may stop short by a μ_d g Δt².
#[test]
fn validates_stopping_distance() {
    for (name, body) in blocks() {
        let mut edits = body.clone();
        edits.extend([("solver.step_s", "1e-3"), ("material.damping_time_s", "0.02")]);
        let mut world = on_incline(0.0, 0.0, &edits);
        world.run(0.5);
        let before = world.mass_and_centre().1[0];
        world.set_motion([-0.7, 0.0], 0.0);
        world.run(0.5);
        let went = before - world.mass_and_centre().1[0];
        let exact = 0.49 / (2.0 * 0.6 * G);
        let error = (went + 0.5 * 0.7e-3) / exact - 1.0;
        println!(
            "stops after {:.4} mm, {name}: error {error:.1e}, then moves at {:.1e} m/s",
            went * 1e3,
            world.fastest(0)
        );
        // 6e-6 m of the last step over 41.6 mm, and what it shakes of a soft block when it stops.
        assert!(error.abs() < 1e-3 && world.fastest(0) < 1e-9);
    }
}
