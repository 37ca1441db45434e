//! Drive magnets: their shape, how many, how they move.

use serde::{Deserialize, Serialize};

/// Equal cuboid magnets beneath the ground, magnetised along +y (their height). Their edges lie along
/// the axes; in space a yaw of the drive turns them about the vertical.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// Edge along x at yaw 0 [m].
    pub length_m: f64,
    /// Edge along z at yaw 0 [m].
    pub width_m: f64,
    /// Edge along y [m].
    pub height_m: f64,
    /// Magnitude of the remanence |Br| [T].
    pub remanence_t: f64,
    /// Which point of the magnet the heights `y_m` of this scene speak of.
    #[serde(default)]
    pub reference: Reference,
    /// One magnet, a pair or a belt.
    #[serde(default)]
    pub arrangement: Arrangement,
    /// How the arrangement moves.
    pub motion: Motion,
    /// What carries the magnets on the stage where they give way up and down; none: they are where the stage is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub suspension: Option<Suspension>,
}

/// A spring and a damper that the drive magnets stand on, all together. The vertical force of the body's magnets moves them off the height
/// of the stage, at which they rest under their weight alone. Nothing stops them, not the ground either.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Suspension {
    /// Mass of what gives way: the magnets with their holder [kg].
    pub mass_kg: f64,
    /// Stiffness [N/m].
    pub stiffness_n_m: f64,
    /// Damping [N·s/m].
    #[serde(default)]
    pub damping_n_s_m: f64,
}

/// The point of a drive magnet whose height is given. The paper's −22 mm leaves it open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reference {
    /// The centre.
    #[default]
    Centre,
    /// The top face.
    Top,
}

/// How many drive magnets there are and how they stand to each other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Arrangement {
    /// One magnet on a stage.
    #[default]
    Single,
    /// Two magnets side by side along x, centred on the stage; in space both turn about the stage
    /// with its yaw.
    Pair {
        /// Distance between their centres [m].
        spacing_m: f64,
        /// 1 where the second has the polarity of the first, −1 where it is opposed.
        second_polarity: i8,
    },
    /// A conveyor belt: `count` magnets at equal pitch that come round again, so that a robot
    /// meets them without end.
    Belt {
        /// Distance between adjacent magnets [m].
        pitch_m: f64,
        /// Number of magnets simulated around the robot.
        count: usize,
    },
}

impl Arrangement {
    /// Number of magnets.
    pub fn magnets(&self) -> usize {
        match self {
            Self::Single => 1,
            Self::Pair { .. } => 2,
            Self::Belt { count, .. } => *count,
        }
    }
}

/// Motion of the drive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Motion {
    /// Follows the actions of a controller within the limits of the stage.
    Controlled(StageLimits),
    /// Constant velocity along x from a starting point.
    Constant {
        /// Start along x [m].
        x_m: f64,
        /// Height [m], negative beneath the ground.
        y_m: f64,
        /// Velocity along x [m/s].
        speed_m_s: f64,
        /// Position along z [m]; 0 in the plane.
        #[serde(default)]
        z_m: f64,
        /// Yaw [°]; 0 in the plane.
        #[serde(default)]
        yaw_deg: f64,
    },
    /// Straight lines between points in time; at rest after the last.
    Waypoints {
        /// Times, strictly rising from 0 [s].
        time_s: Vec<f64>,
        /// Position along x at each time [m].
        x_m: Vec<f64>,
        /// Height at each time [m].
        y_m: Vec<f64>,
        /// Position along z at each time [m]; an empty list is 0 throughout, as in the plane.
        #[serde(default)]
        z_m: Vec<f64>,
        /// Yaw at each time [°]; an empty list is 0 throughout, as in the plane.
        #[serde(default)]
        yaw_deg: Vec<f64>,
    },
}

/// Limits of the stage that carries the drive. Each axis obeys them on its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StageLimits {
    /// Furthest target along x, ahead of or behind the robot's centre [m].
    pub reach_m: f64,
    /// Lowest height [m].
    pub lowest_m: f64,
    /// Greatest height [m].
    pub highest_m: f64,
    /// Greatest speed of each straight axis [m/s].
    #[serde(default = "platform_speed")]
    pub speed_m_s: f64,
    /// Greatest acceleration of each straight axis [m/s²].
    #[serde(default = "stage_acceleration")]
    pub acceleration_m_s2: f64,
    /// Furthest target to either side of the robot's centre [m]; 0 in the plane.
    #[serde(default)]
    pub lateral_reach_m: f64,
    /// Furthest yaw of the drive from the robot's heading, either way [°]; 0 in the plane.
    #[serde(default)]
    pub yaw_reach_deg: f64,
    /// Greatest speed of yaw [°/s].
    #[serde(default = "yaw_speed")]
    pub yaw_speed_deg_s: f64,
    /// Greatest acceleration of yaw [°/s²].
    #[serde(default = "yaw_acceleration")]
    pub yaw_acceleration_deg_s2: f64,
}

fn platform_speed() -> f64 {
    0.210
}

fn stage_acceleration() -> f64 {
    5.0
}

fn yaw_speed() -> f64 {
    180.0
}

fn yaw_acceleration() -> f64 {
    3600.0
}
