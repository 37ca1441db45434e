//! What an agent sees and does, declared once: name, unit, size, bounds. Spaces are derived from here.
//!
//! Lengths are in units of the magnet pitch, velocities in units of the stage's greatest speed, so that
//! all components are of the order of one.

use crate::drive::Path;
use crate::lanes::math::{atan2, sin_cos};
use crate::lanes::{Number, Row};
use crate::model::Model;
use crate::scene::Body;
use crate::state::Block;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// One named slice of an observation or action.
#[derive(Clone, Debug, PartialEq)]
pub struct Specification {
    /// Name.
    pub name: &'static str,
    /// Unit of its components.
    pub unit: String,
    /// Number of components.
    pub size: usize,
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// One sentence.
    pub description: &'static str,
}

/// Number of action components: 3 in the plane; in space 4, or 5 where the stage yaws.
pub fn action_size(model: &Model) -> usize {
    match model.program.drive.as_ref().map(|drive| &drive.path) {
        Some(Path::Controlled(limits)) => limits.action_size(model.dimensions()),
        _ if model.dimensions() == 3 => 4,
        _ => 3,
    }
}

/// Number of observation components.
pub fn size(model: &Model) -> usize {
    let (per_magnet, drive) = if model.dimensions() == 2 { (6, 4) } else { (12, 9) };
    per_magnet * model.magnets() + drive + action_size(model)
}

/// Length that observations are scaled by [m]: the magnet pitch, on the average where segments differ, or the rod's length.
pub fn length_scale_m(model: &Model) -> f64 {
    match &model.scene.body {
        Body::Worm(worm) => worm.pitch_m,
        Body::Rod(rod) => rod.length_m,
        Body::Segments(_) => model.mesh.pitch_m().unwrap_or(model.mesh.length_m()),
    }
}

/// Speed that observations are scaled by [m/s]: the stage's limit, or 0.21 m/s where there is none.
pub fn speed_scale_m_s(model: &Model) -> f64 {
    match model.program.drive.as_ref().map(|drive| &drive.path) {
        Some(Path::Controlled(limits)) => limits.speed_m_s,
        _ => 0.210,
    }
}

/// The components of an observation, in order.
///
/// In space everything is seen from the robot: x points from its head to its tail along the ground, z to its
/// side, and the origin is under its centre.
pub fn observation(model: &Model) -> Vec<Specification> {
    let mut slices = if model.dimensions() == 2 { planar(model) } else { spatial(model) };
    slices.push(Specification {
        low: -1.0,
        high: 1.0,
        ..slice("last_action", "1", action_size(model), "the action before")
    });
    slices
}

fn slice(name: &'static str, unit: &str, size: usize, description: &'static str) -> Specification {
    let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
    Specification { name, unit: unit.to_string(), size, low, high, description }
}

/// Units of lengths, speeds and rates.
fn units(model: &Model) -> [String; 3] {
    [
        format!("{} m", length_scale_m(model)),
        format!("{} m/s", speed_scale_m_s(model)),
        format!("{} rad/s", speed_scale_m_s(model) / length_scale_m(model)),
    ]
}

fn planar(model: &Model) -> Vec<Specification> {
    let (magnets, [length, speed, turn]) = (model.magnets(), units(model));
    vec![
        slice("magnet_x", &length, magnets, "x of each body magnet from the robot's centre"),
        slice("magnet_y", &length, magnets, "height of each body magnet over the ground"),
        slice("magnet_angle", "rad", magnets, "angle of each body magnet, anticlockwise"),
        slice("magnet_vx", &speed, magnets, "velocity of each body magnet along x"),
        slice("magnet_vy", &speed, magnets, "velocity of each body magnet along y"),
        slice("magnet_rate", &turn, magnets, "angular velocity of each body magnet"),
        slice(
            "drive_position",
            &length,
            2,
            "x of the drive from the robot's centre, and its height",
        ),
        slice("drive_velocity", &speed, 2, "velocity of the drive along x and y"),
    ]
}

fn spatial(model: &Model) -> Vec<Specification> {
    let (magnets, [length, speed, turn]) = (3 * model.magnets(), units(model));
    vec![
        slice("magnet_position", &length, magnets, "x, y, z of each body magnet"),
        slice("magnet_rotation", "rad", magnets, "rotation vector of each body magnet"),
        slice("magnet_velocity", &speed, magnets, "velocity of each body magnet along x, y, z"),
        slice("magnet_rate", &turn, magnets, "angular velocity of each body magnet about x, y, z"),
        slice("drive_position", &length, 3, "x, y, z of the drive"),
        slice("drive_yaw", "1", 2, "cosine and sine of the drive's yaw"),
        slice("drive_velocity", &speed, 3, "velocity of the drive along x, y, z"),
        slice("drive_rate", &turn, 1, "angular velocity of the drive about y"),
    ]
}

/// The components of an action, in order.
pub fn action(model: &Model) -> Vec<Specification> {
    let component = |name, description| Specification {
        low: -1.0,
        high: 1.0,
        ..slice(name, "1", 1, description)
    };
    let mut components = vec![
        component(
            "position",
            "target along the robot: −1 and 1 are the stage's reach ahead of and behind its centre",
        ),
        component(
            "lateral",
            "target to the robot's side: −1 and 1 are the stage's lateral reach right and left of it",
        ),
        component("height", "target height: −1 is the lowest, 1 the highest of the stage"),
        component("speed", "travel speed of each axis: −1 is none, 1 the stage's limit"),
        component(
            "yaw",
            "target yaw from the robot's heading: −1 and 1 are the stage's reach, 1 anticlockwise from above",
        ),
    ];
    if model.dimensions() == 2 {
        components.remove(1);
    }
    components.truncate(action_size(model));
    components
}

/// Writes the observation of one lane.
pub fn write<R: Row>(model: &Model, block: &Block<R>, lane: usize, row: &mut [f32]) {
    let rest = if model.dimensions() == 2 {
        write_planar(model, block, lane, row)
    } else {
        write_spatial(model, block, lane, row)
    };
    for (k, last) in row[rest..].iter_mut().enumerate() {
        *last = block.action[k][lane].f64() as f32;
    }
}

/// Writes all but the action; how many numbers that are.
fn write_planar<R: Row>(model: &Model, block: &Block<R>, lane: usize, row: &mut [f32]) -> usize {
    let per_length = 1.0 / length_scale_m(model);
    let per_speed = 1.0 / speed_scale_m_s(model);
    let scale = [per_length, per_length, 1.0, per_speed, per_speed, per_speed / per_length];
    let centre = block.centre_x(model, lane);
    let magnets = model.magnets();
    for (magnet, &dof) in model.coordinates.bodies.iter().enumerate() {
        for k in 0..3 {
            let origin = if k == 0 { centre } else { 0.0 };
            row[k * magnets + magnet] = ((block.q[dof + k][lane].f64() - origin) * scale[k]) as f32;
            row[(k + 3) * magnets + magnet] = (block.v[dof + k][lane].f64() * scale[k + 3]) as f32;
        }
    }
    let rest = &mut row[6 * magnets..];
    if let Some(drive) = &model.program.drive {
        let x = drive.layout.position(0, block.stage[0][lane].f64(), centre);
        rest[0] = ((x - centre) * per_length) as f32;
        rest[1] = (block.stage[1][lane].f64() * per_length) as f32;
        rest[2] = (block.stage[2][lane].f64() * per_speed) as f32;
        rest[3] = (block.stage[3][lane].f64() * per_speed) as f32;
    } else {
        rest[..4].fill(0.0);
    }
    6 * magnets + 4
}

/// Writes all but the action; how many numbers that are.
fn write_spatial<R: Row>(model: &Model, block: &Block<R>, lane: usize, row: &mut [f32]) -> usize {
    let (length, speed) = (length_scale_m(model), speed_scale_m_s(model));
    let rate = speed / length;
    let [x, z, heading] = block.robot_pose(model, lane);
    let (sin, cos) = sin_cos(heading);
    let robot_from_world = Matrix3::new(cos, 0.0, -sin, 0.0, 1.0, 0.0, sin, 0.0, cos);
    let robot_from_world = Rotation3::from_matrix_unchecked(robot_from_world);
    let origin = Vector3::new(x, 0.0, z);
    let mut put = Cursor { row, at: 0 };
    let pose = |magnet| block.magnet_pose(model, magnet, lane);
    let velocity = |magnet| block.magnet_velocity(model, magnet, lane);
    for magnet in 0..model.magnets() {
        put.vector(robot_from_world * (pose(magnet).position_m - origin) / length);
    }
    for magnet in 0..model.magnets() {
        put.vector(rotation_vector(robot_from_world * pose(magnet).orientation));
    }
    for magnet in 0..model.magnets() {
        put.vector(robot_from_world * velocity(magnet).linear_m_s / speed);
    }
    for magnet in 0..model.magnets() {
        put.vector(robot_from_world * velocity(magnet).angular_rad_s / rate);
    }
    let Some(drive) = &model.program.drive else {
        put.row[put.at..put.at + 9].fill(0.0);
        return put.at + 9;
    };
    let stage: [f64; 8] = std::array::from_fn(|k| block.stage[k][lane].f64());
    let belt_x = match drive.layout.circumference_m {
        Some(_) => drive.layout.position(0, stage[0], x),
        None => stage[0],
    };
    put.vector(robot_from_world * (Vector3::new(belt_x, stage[1], stage[2]) - origin) / length);
    let (sin, cos) = sin_cos(stage[3] - heading);
    put.numbers(&[cos, sin]);
    put.vector(robot_from_world * Vector3::new(stage[4], stage[5], stage[6]) / speed);
    put.numbers(&[stage[7] / rate]);
    put.at
}

/// Axis times angle, by the project's own arctangent: that of nalgebra differs between platforms.
fn rotation_vector(rotation: UnitQuaternion<f64>) -> Vector3<f64> {
    let (w, v) = (rotation.w, rotation.imag());
    let sine = v.norm();
    let angle_over_sine = if sine < 1e-12 { 2.0 } else { 2.0 * atan2(sine, w.abs()) / sine };
    v * angle_over_sine * if w < 0.0 { -1.0 } else { 1.0 }
}

/// Writes numbers one after the other.
struct Cursor<'a> {
    row: &'a mut [f32],
    at: usize,
}

impl Cursor<'_> {
    fn numbers(&mut self, numbers: &[f64]) {
        for &number in numbers {
            self.row[self.at] = number as f32;
            self.at += 1;
        }
    }

    fn vector(&mut self, vector: Vector3<f64>) {
        self.numbers(vector.as_slice());
    }
}
