//! What an agent sees and does, declared once: name, unit, size, bounds. Spaces are derived from here.
//!
//! Lengths are in units of the magnet pitch, velocities in units of the stage's greatest speed, so that
//! all components are of the order of one.

use crate::drive::Path;
use crate::model::Model;
use crate::scene::Body;
use crate::state::Block;

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

/// Number of action components.
pub const ACTION_SIZE: usize = 3;

const PER_MAGNET: usize = 6;
const DRIVE: usize = 4;

/// Number of observation components.
pub fn size(model: &Model) -> usize {
    PER_MAGNET * model.magnets() + DRIVE + ACTION_SIZE
}

/// Length that observations are scaled by [m]: the magnet pitch, or the rod's length.
pub fn length_scale_m(model: &Model) -> f64 {
    match &model.scene.body {
        Body::Worm(worm) => worm.pitch_m,
        Body::Rod(rod) => rod.length_m,
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
pub fn observation(model: &Model) -> Vec<Specification> {
    let magnets = model.magnets();
    let length = format!("{} m", length_scale_m(model));
    let speed = format!("{} m/s", speed_scale_m_s(model));
    let turn = format!("{} rad/s", speed_scale_m_s(model) / length_scale_m(model));
    let slice = |name, unit: &str, size, description| Specification {
        name,
        unit: unit.to_string(),
        size,
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
        description,
    };
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
        Specification {
            low: -1.0,
            high: 1.0,
            ..slice("last_action", "1", ACTION_SIZE, "the action before")
        },
    ]
}

/// The components of an action, in order.
pub fn action() -> Vec<Specification> {
    let component = |name, description| Specification {
        name,
        unit: "1".to_string(),
        size: 1,
        low: -1.0,
        high: 1.0,
        description,
    };
    vec![
        component(
            "position",
            "target along the robot: −1 and 1 are the stage's reach ahead of and behind its centre",
        ),
        component("height", "target height: −1 is the lowest, 1 the highest of the stage"),
        component("speed", "travel speed of each axis: −1 is none, 1 the stage's limit"),
    ]
}

/// Writes the observation of one lane.
pub fn write<const W: usize>(model: &Model, block: &Block<W>, lane: usize, row: &mut [f32]) {
    let per_length = 1.0 / length_scale_m(model);
    let per_speed = 1.0 / speed_scale_m_s(model);
    let scale = [per_length, per_length, 1.0, per_speed, per_speed, per_speed / per_length];
    let centre = block.centre_x(model, lane);
    let magnets = model.magnets();
    for (magnet, &dof) in model.coordinates.bodies.iter().enumerate() {
        for k in 0..3 {
            let origin = if k == 0 { centre } else { 0.0 };
            row[k * magnets + magnet] = ((block.q[dof + k][lane] - origin) * scale[k]) as f32;
            row[(k + 3) * magnets + magnet] = (block.v[dof + k][lane] * scale[k + 3]) as f32;
        }
    }
    let rest = &mut row[PER_MAGNET * magnets..];
    if let Some(drive) = &model.program.drive {
        let x = drive.layout.position(0, block.stage[0][lane], centre);
        rest[0] = ((x - centre) * per_length) as f32;
        rest[1] = (block.stage[1][lane] * per_length) as f32;
        rest[2] = (block.stage[2][lane] * per_speed) as f32;
        rest[3] = (block.stage[3][lane] * per_speed) as f32;
    } else {
        rest[..DRIVE].fill(0.0);
    }
    for k in 0..ACTION_SIZE {
        rest[DRIVE + k] = block.action[k][lane] as f32;
    }
}
