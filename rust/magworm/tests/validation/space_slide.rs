//! A block that slides, sticks and spins on the ground, whatever its direction.

use crate::report::Case;
use crate::space_world::Vector;
use crate::world::{World, number};

const G: f64 = 9.81;
const STATIC: f64 = 0.8;
const DYNAMIC: f64 = 0.6;
/// Half of the edges of the foot along and across [m].
const HALF_M: [f64; 2] = [0.007, 0.006];

/// The robot of one foot that is one rigid magnet in rubber, on its four corners.
const FOOT: [(&str, &str); 12] = [
    ("dimensions", "3"),
    ("drive", ""),
    ("body.magnets", "1"),
    ("body.width_m", "0.012"),
    ("magnet.length_m", "0.014"),
    ("magnet.width_m", "0.01"),
    ("ground.static_friction", "0.8"),
    ("ground.dynamic_friction", "0.6"),
    ("ground.transition_speed_m_s", "1e-3"),
    ("ground.adhesion_n", "0.0"),
    ("solver.step_s", "1e-3"),
    ("control.step_s", "1.0"),
];

fn foot(edits: &[(&str, &str)]) -> World {
    World::new("robot", &[&FOOT[..], edits].concat())
}

/// Name, scene and edits of a body.
type Body = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

/// Bodies that slide: the rigid foot, and a rod of eight soft elements.
fn bodies() -> [Body; 2] {
    const ROD: [(&str, &str); 3] =
        [("dimensions", "3"), ("ground.incline_deg", "0.0"), ("control.step_s", "1.0")];
    [("foot", "robot", &FOOT), ("rod", "incline-block", &ROD)]
}

/// Where a body thrown at 0.7 m/s along `heading` comes to rest from its start.
fn thrown(base: &str, edits: &[(&str, &str)], heading: f64) -> Vector {
    let steps = [("solver.step_s", "1e-3"), ("material.damping_time_s", "0.02")];
    let mut world = World::new(base, &[edits, &steps].concat());
    world.run(0.3);
    let before = world.centre().1;
    let velocity = Vector::new(heading.cos(), 0.0, heading.sin()) * 0.7;
    world.set_flow(|_| velocity, Vector::zeros());
    world.run(0.4);
    assert!(world.quickest().0 < 1e-9, "still sliding at {} m/s", world.quickest().0);
    world.centre().1 - before
}

/// A block with speed v stops after v²/(2 μ_d g) − ½ v Δt whatever its direction: eight directions along the ground, of
/// which none but the first is an axis of the cone's linearisation.
#[test]
fn validates_space_stopping_distance() {
    let mut case = Case::new("space_stopping_distance", "Stopping distance in eight directions")
        .equation("v²/(2 μ_d g) − ½ v Δt along v, 0 across it")
        .source("Coulomb; the second term is that of a step that moves with its final velocity")
        .scene("robot", &FOOT)
        .note(
            "v = 0.7 m/s at 10°, 55°, … from x. *Foot*: one rigid magnet on four corners; *rod*: eight soft \
            elements on nine points. The last step may stop short by μ_d g Δt²; the contact springs under the points give by \
            1e-6 m.",
        );
    let exact = 0.49 / (2.0 * DYNAMIC * G) - 0.5 * 0.7e-3;
    for (name, base, edits) in bodies() {
        let (mut along, mut aside) = (Vec::new(), Vec::new());
        for k in 0..8 {
            let heading = f64::from(10 + 45 * k).to_radians();
            let went = thrown(base, edits, heading);
            let (sin, cos) = heading.sin_cos();
            along.push(went.x * cos + went.z * sin);
            aside.push((went.z * cos - went.x * sin) / exact);
        }
        let mean = along.iter().sum::<f64>() / 8.0;
        let off: Vec<f64> = along.iter().map(|way| way / exact - 1.0).collect();
        let uneven: Vec<f64> = along.iter().map(|way| way / mean - 1.0).collect();
        case.spread(format!("way, {name}"), "relative", &off, 8e-5);
        case.spread(
            format!("way against the mean of all directions, {name}"),
            "relative",
            &uneven,
            4e-6,
        );
        case.spread(format!("way across, {name}"), "of the way", &aside, 4e-6);
    }
    case.finish();
}

/// A foot on an incline, turned about its normal.
fn leaning(incline_deg: f64, yaw_deg: f64) -> World {
    let (incline, yaw) = (number(incline_deg), number(yaw_deg));
    let edits = [
        ("ground.incline_deg", incline.as_str()),
        ("start.yaw_deg", &yaw),
        ("solver.step_s", "2e-3"),
    ];
    foot(&edits)
}

/// Way of the second second [m], so its mean speed [m/s].
fn creep(world: &mut World) -> Vector {
    world.run(1.0);
    let before = world.centre().1;
    world.run(1.0);
    world.centre().1 - before
}

/// A foot begins to slide at atan μ_s whatever its yaw on the incline; 0.05° below it creeps by no more than 1e-9 m/s,
/// and above it slides straight down with g (sin α − μ_d cos α).
#[test]
fn validates_space_friction_angle() {
    let mut case = Case::new("space_friction_angle", "Friction angle of a yawed foot")
        .equation("tan α = μ_s; a = g (sin α − μ_d cos α) beyond")
        .source("Coulomb")
        .scene("robot", &[&FOOT[..], &[("ground.incline_deg", "…"), ("start.yaw_deg", "…")]].concat())
        .note(
            "The foot stands on four corners, its length at an angle to the line of fall. Creep and way across \
            in the second second; the acceleration is that of the second second at 45°.",
        );
    let angle = STATIC.atan().to_degrees();
    let (mut creeps, mut accelerations, mut aside) = (Vec::new(), Vec::new(), Vec::new());
    let exact = G * (1.0 - DYNAMIC) * std::f64::consts::FRAC_1_SQRT_2;
    for yaw in [0.0, 25.0, 45.0, 90.0, -120.0] {
        creeps.push(creep(&mut leaning(angle - 0.05, yaw)).norm());
        let slid = creep(&mut leaning(angle + 0.05, yaw));
        case.inside(format!("way in a second 0.05° above, yaw {yaw}°"), "m", slid.x, 0.1..=3.0);
        let mut world = leaning(45.0, yaw);
        world.run(0.2);
        let before = world.drift_in_space();
        world.run(0.3);
        let after = world.drift_in_space();
        accelerations.push((after.x - before.x) / 0.3 / exact - 1.0);
        aside.push(after.z / after.x);
    }
    case.spread("creep 0.05° below", "m/s", &creeps, 1e-9);
    case.spread("acceleration at 45°", "relative", &accelerations, 1e-9);
    case.spread("velocity across at 45°", "of that down", &aside, 4e-8);
    case.finish();
}

/// A foot that spins flat about its centre: its four corners at r bear a quarter each, so it decelerates with
/// μ_d m g r/I and stops after ω² I/(2 μ_d m g r) − ½ ω Δt.
#[test]
fn validates_space_spinning_block() {
    let mut case = Case::new("space_spinning_block", "Foot that spins on its corners")
        .equation("angle = ω² I/(2 μ_d m g r) − ½ ω Δt, r: distance of the corners")
        .source("Coulomb")
        .scene(
            "robot",
            &[&FOOT[..], &[("solver.step_s", "1e-4"), ("control.step_s", "1e-4")]].concat(),
        )
        .note(
            "Spun at ±50 rad/s about the vertical. The centre must stay where it is. Pads that take the friction up \
            and give it back turn it by 4e-4.",
        );
    for rate in [50.0, -50.0] {
        let mut world = foot(&[("solver.step_s", "1e-4"), ("control.step_s", "1e-4")]);
        world.run(0.1);
        let (mass, before) = world.centre();
        let start = world.block.robot_pose(&world.model, 0, 0)[2];
        let dof = world.model.coordinates.bodies[0];
        let spin = world.block.mass[dof + 4][0];
        world.set_flow(|_| Vector::zeros(), Vector::y() * rate);
        world.run(0.1);
        let turned = world.block.robot_pose(&world.model, 0, 0)[2] - start;
        let arm = HALF_M[0].hypot(HALF_M[1]);
        let exact = rate * rate * spin / (2.0 * DYNAMIC * mass * G * arm) - 0.5 * rate.abs() * 1e-4;
        case.relative(
            format!("angle, ω = {rate} rad/s"),
            "rad",
            [turned, exact.copysign(rate)],
            5e-4,
        );
        let moved = (world.centre().1 - before).norm();
        case.at_most(format!("way of the centre, ω = {rate} rad/s"), "m", moved, 1e-9);
        case.at_most(
            format!("speed afterwards, ω = {rate} rad/s"),
            "m/s",
            world.quickest().0,
            1e-9,
        );
    }
    case.finish();
}
