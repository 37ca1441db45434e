//! Blocks on inclines: Coulomb's law with its closed forms.

use crate::report::Case;
use crate::world::{World, number};

pub const G: f64 = 9.81;

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

pub fn on_incline(angle_deg: f64, adhesion_n: f64, body: &[(&str, &str)]) -> World {
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

/// Displacement down the incline in the third second [m], so its mean speed [m/s].
fn creep(world: &mut World) -> f64 {
    world.run(2.0);
    let before = world.mass_and_centre().1[0];
    world.run(1.0);
    world.mass_and_centre().1[0] - before
}

/// Angle at which a body begins to slide by more than 1 mm in a second, by bisection to 1e-4° [°].
fn slides_from_deg(mut low: f64, mut high: f64, body: impl Fn(f64) -> World) -> f64 {
    assert!(creep(&mut body(low)) < 1e-3 && creep(&mut body(high)) > 1e-3, "{low}° to {high}°");
    while high - low > 1e-4 {
        let middle = 0.5 * (low + high);
        if creep(&mut body(middle)) > 1e-3 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// A block begins to slide at the friction angle, within 0.05°, with and without adhesion D_f; 0.05° below it creeps by no
/// more than 1e-9 m/s once settled.
#[test]
fn validates_friction_angle() {
    let mut case = Case::new("friction_angle", "Block on an incline: friction angle")
        .equation("tan α = μ_s + n D_f/(m g cos α), n: points of contact")
        .source(
            "Coulomb; D_f is the paper's adhesive part of friction (Soft Robotics, DOI \
            10.1089/soro.2019.0167)",
        )
        .scene("incline-block", &[("ground.incline_deg", "…"), ("ground.adhesion_n", "0.0")])
        .note(
            "μ_s = 0.8. A block lies on the incline; after 2 s its way in one more second tells \
            whether it slides. The angle is found by bisection to 1e-4°. Blocks: 2 to 20 mm \
            thick, 80 kPa and 1 MPa, with two magnets, with one magnet along the whole block, of \
            one element. D_f = 0.2 mN a point where all points touch. The 0.0016° that all are \
            off by is the criterion's: below the transition speed static friction holds, and so \
            near the angle a block needs three seconds to it.",
        );
    let (mut errors, mut creeping) = (Vec::new(), Vec::new());
    for (name, body) in blocks() {
        for adhesion in [0.0, 2e-4].into_iter().filter(|d| *d == 0.0 || all_points_touch(name)) {
            let exact = threshold_deg(0.8, adhesion, &on_incline(0.0, 0.0, &body));
            let at = |angle| on_incline(angle, adhesion, &body);
            let found = slides_from_deg(exact - 0.5, exact + 0.5, at);
            if name == "7 mm" {
                case.absolute(
                    format!("friction angle, 7 mm, D_f = {adhesion} N"),
                    "°",
                    [found, exact],
                    0.05,
                );
            }
            errors.push(found - exact);
            creeping.push(creep(&mut at(exact - 0.05)));
        }
    }
    case.spread("friction angle, all blocks", "°", &errors, 0.05);
    case.spread("creep 0.05° below, all blocks", "m/s", &creeping, 1e-9);
    case.finish();
}

/// Feet and whole robots, whose toes and heels feel the moment of friction at the sole and so share the weight
/// unequally: they slide from arctan 0.8 on, within 0.5°, landing from 1 µm above or lying there.
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
        ("robot", &[]),
    ];
    let law = [
        ("ground.static_friction", "0.8"),
        ("ground.dynamic_friction", "0.6"),
        ("ground.adhesion_n", "0.0"),
        ("drive", ""),
    ];
    let mut case = Case::new("friction_angle_of_feet", "Robots on an incline: friction angle")
        .equation("tan α = μ_s")
        .source("Coulomb")
        .scene("robot", &law)
        .note(
            "As for blocks. A rigid foot touches the ground with toe and heel, which share its \
            weight unequally on an incline. Bodies: one foot, with its magnet along a part of it \
            or all, a tall one, and the robot; lying or landing from 1 µm.",
        );
    let exact = 0.8f64.atan().to_degrees();
    let (mut errors, mut creeping) = (Vec::new(), Vec::new());
    for (name, body) in bodies {
        for height in ["0.0", "1e-6"] {
            let at = |degrees| {
                let angle = number(degrees);
                let pose = [("ground.incline_deg", angle.as_str()), ("start.height_m", height)];
                World::new("robot", &[&law[..], &pose, body].concat())
            };
            let found = slides_from_deg(exact - 0.5, exact + 0.5, at);
            if name == "robot" {
                let what = format!("friction angle, {name}, from {height} m");
                case.absolute(what, "°", [found, exact], 0.5);
            }
            errors.push(found - exact);
            creeping.push(creep(&mut at(exact - 0.5)));
        }
    }
    case.spread("friction angle, all of them", "°", &errors, 0.5);
    case.spread("creep 0.5° below, all of them", "m/s", &creeping, 1e-9);
    case.finish();
}
