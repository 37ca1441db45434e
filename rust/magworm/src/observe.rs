//! What an agent sees and does: the body magnets, the actuators, the last action. Spaces are derived from here.
//!
//! Lengths are in units of the magnet pitch, velocities in units of the stage's greatest speed, so that
//! all components are of the order of one.

pub use crate::specification::Specification;

use crate::actuator::{Actuator, Sizes, Stage, states};
use crate::lanes::math::atan2;
use crate::lanes::{Number, Row};
use crate::model::{Model, Robot};
use crate::specification::{Observation, Outlook, Scales};
use crate::state::Block;
use nalgebra::{UnitQuaternion, Vector3};
use std::ops::Range;

/// Speed that observations are scaled by where no actuator has a limit [m/s].
const SPEED_M_S: f64 = 0.210;

/// Number of action components: 3 in the plane; in space 4, or 5 where the stage yaws.
pub fn action_size(model: &Model) -> usize {
    sizes(model).action
}

/// Number of observation components.
pub fn size(model: &Model) -> usize {
    let Sizes { observation, action, .. } = sizes(model);
    // Pose and velocity of each magnet.
    2 * model.sizes().body() * magnets(model).len() + observation + action
}

/// The magnets that an agent sees: those of its robot.
fn magnets(model: &Model) -> Range<usize> {
    model.robots[Robot::AGENT].bodies.clone()
}

/// A scene without actuators is seen as one whose stage stands still: an agent finds all else in its place.
fn sizes(model: &Model) -> Sizes {
    match model.program.actuators.as_slice() {
        [] => Stage::sizes_in(model.sizes(), false),
        actuators => Sizes::of(actuators),
    }
}

/// The actuators of a scene, or the stage that stands for them.
fn actuators(model: &Model) -> Vec<Actuator> {
    match model.program.actuators.as_slice() {
        [] => vec![Actuator::Stage(Stage::standing(model.dimensions()))],
        actuators => actuators.to_vec(),
    }
}

/// What observations are scaled by: the magnet pitch, on the average where segments differ, or the rod's length; and the
/// greatest speed of an actuator.
pub fn scales(model: &Model) -> Scales {
    let Model { scene, mesh, .. } = model;
    let length_m = scene.body.scale_m().or(mesh.pitch_m()).unwrap_or(mesh.length_m());
    let speed_m_s = model.program.actuators.iter().find_map(Actuator::speed_m_s);
    Scales { length_m, speed_m_s: speed_m_s.unwrap_or(SPEED_M_S) }
}

/// The components of an action, in order.
pub fn action(model: &Model) -> Vec<Specification> {
    actuators(model).iter().flat_map(Actuator::action).collect()
}

/// The components of an observation, in order.
///
/// In space everything is seen from the robot: x points from its head to its tail along the ground, z to its
/// side, and the origin is under its centre.
pub fn observation(model: &Model) -> Vec<Specification> {
    let (scales, magnets) = (scales(model), magnets(model).len());
    let mut slices = if model.dimensions() == 2 {
        planar(magnets, &scales)
    } else {
        spatial(3 * magnets, &scales)
    };
    slices.extend(actuators(model).iter().flat_map(|actuator| actuator.observation(&scales)));
    slices.push(Specification::within_one("last_action", action_size(model), "the action before"));
    slices
}

fn planar(magnets: usize, scales: &Scales) -> Vec<Specification> {
    let slice = Specification::new;
    let (length, speed) = (scales.length(), scales.speed());
    vec![
        slice("magnet_x", &length, magnets, "x of each body magnet from the robot's centre"),
        slice("magnet_y", &length, magnets, "height of each body magnet over the ground"),
        slice("magnet_angle", "rad", magnets, "angle of each body magnet, anticlockwise"),
        slice("magnet_vx", &speed, magnets, "velocity of each body magnet along x"),
        slice("magnet_vy", &speed, magnets, "velocity of each body magnet along y"),
        slice("magnet_rate", &scales.rate(), magnets, "angular velocity of each body magnet"),
    ]
}

fn spatial(numbers: usize, scales: &Scales) -> Vec<Specification> {
    let slice = Specification::new;
    let velocity = "velocity of each body magnet along x, y, z";
    let rate = "angular velocity of each body magnet about x, y, z";
    vec![
        slice("magnet_position", &scales.length(), numbers, "x, y, z of each body magnet"),
        slice("magnet_rotation", "rad", numbers, "rotation vector of each body magnet"),
        slice("magnet_velocity", &scales.speed(), numbers, velocity),
        slice("magnet_rate", &scales.rate(), numbers, rate),
    ]
}

/// Writes the observation of one lane.
pub fn write<R: Row>(model: &Model, block: &Block<R>, lane: usize, row: &mut [f32]) {
    let robot = block.robot_pose(model, Robot::AGENT, lane);
    let (scales, from) = (scales(model), Outlook::new(robot));
    let mut out = Observation::new(row);
    if model.dimensions() == 2 {
        write_planar(model, block, lane, &scales, &mut out);
    } else {
        write_spatial(model, block, lane, &from, &scales, &mut out);
    }
    for (actuator, state) in states(&model.program.actuators, &block.stage) {
        actuator.observe(state, lane, &from, &scales, &mut out);
    }
    block.action.iter().for_each(|row| out.numbers(&[row[lane].f64()]));
    out.nothing();
}

fn write_planar<R: Row>(
    model: &Model,
    block: &Block<R>,
    lane: usize,
    scales: &Scales,
    out: &mut Observation<'_>,
) {
    let (per_length, per_speed) = (1.0 / scales.length_m, 1.0 / scales.speed_m_s);
    let bodies = model.bodies_of(Robot::AGENT);
    let centre = block.centre_x(model, Robot::AGENT, lane);
    let places = [(centre, per_length), (0.0, per_length), (0.0, 1.0)];
    for (k, (origin, scale)) in places.into_iter().enumerate() {
        for &dof in bodies {
            out.numbers(&[(block.q[dof + k][lane].f64() - origin) * scale]);
        }
    }
    for (k, scale) in [per_speed, per_speed, per_speed / per_length].into_iter().enumerate() {
        for &dof in bodies {
            out.numbers(&[block.v[dof + k][lane].f64() * scale]);
        }
    }
}

fn write_spatial<R: Row>(
    model: &Model,
    block: &Block<R>,
    lane: usize,
    from: &Outlook,
    scales: &Scales,
    out: &mut Observation<'_>,
) {
    let magnets = magnets(model);
    let pose = |magnet| block.magnet_pose(model, magnet, lane);
    let velocity = |magnet| block.magnet_velocity(model, magnet, lane);
    for magnet in magnets.clone() {
        out.vector(from.place(pose(magnet).position_m) / scales.length_m);
    }
    for magnet in magnets.clone() {
        out.vector(rotation_vector(from.orientation(pose(magnet).orientation)));
    }
    for magnet in magnets.clone() {
        out.vector(from.vector(velocity(magnet).linear_m_s) / scales.speed_m_s);
    }
    for magnet in magnets {
        out.vector(from.vector(velocity(magnet).angular_rad_s) / scales.rate_rad_s());
    }
}

/// Axis times angle, by the project's own arctangent: that of nalgebra differs between platforms.
fn rotation_vector(rotation: UnitQuaternion<f64>) -> Vector3<f64> {
    let (w, v) = (rotation.w, rotation.imag());
    let sine = v.norm();
    let angle_over_sine = if sine < 1e-12 { 2.0 } else { 2.0 * atan2(sine, w.abs()) / sine };
    v * angle_over_sine * if w < 0.0 { -1.0 } else { 1.0 }
}
