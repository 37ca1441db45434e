//! Time integration, control, start and reset.

use crate::integrate::Integrator;
use serde::{Deserialize, Serialize};

/// Time integration of the equations of motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// Which scheme.
    pub integrator: Integrator,
    /// Time step [s].
    pub step_s: f64,
    /// Model of the wrench between two magnets.
    pub magnet_model: MagnetModel,
    /// Gauss–Legendre points per edge of a charged face in the field of the drive.
    pub quadrature_order: usize,
    /// Solver steps for which a wrench of the drive acts before it is computed anew; 1: it is computed in every step. Divides
    /// the steps of a control step, so that each begins with a new wrench. What is lost and gained: docs/performance.md.
    pub wrench_interval: usize,
    /// Most trials of the contact solve per step, shared out among its iterations, see [`crate::contact`].
    pub contact_iterations: usize,
    /// Greatest speed of a node or magnet at the end of a control step [m/s]: a robot that is faster breaks. It tells robots
    /// apart that a drive magnet threw away, as a point dipole does to a magnet that falls through it.
    pub fastest_m_s: f64,
    /// Discrete curvature of the rod.
    pub curvature: Curvature,
    /// Precision of numbers in a step.
    pub precision: Precision,
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            integrator: Integrator::Newmark,
            step_s: 2e-3,
            magnet_model: MagnetModel::Cuboid,
            quadrature_order: 3,
            wrench_interval: 1,
            contact_iterations: 120,
            fastest_m_s: 100.0,
            curvature: Curvature::Angle,
            precision: Precision::Double,
        }
    }
}

/// Curvature of a node, times its length, from its turning angle φ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Curvature {
    /// κ = φ: an arc of constant curvature is exact.
    Angle,
    /// κ = 2 tan(φ/2), the paper's (Bergou 2008): its moment is greater by φ²/3, and infinite for a fold.
    Tangent,
}

/// Precision of the numbers that a step computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// 53 bits, eight robots in a vector.
    Double,
    /// 24 bits, sixteen robots in a vector.
    Single,
}

/// Model of the wrench between two magnets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MagnetModel {
    /// Closed-form cuboid field, integrated over the charged faces.
    Cuboid,
    /// Point dipoles: good far away only.
    Dipole,
}

/// Control period and length of an episode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Control {
    /// Time between two actions [s]; a whole number of solver steps.
    pub step_s: f64,
    /// Length of an episode [s].
    pub episode_s: f64,
}

impl Default for Control {
    fn default() -> Self {
        Self { step_s: 0.02, episode_s: 10.0 }
    }
}

/// Pose and shape of the body at the start, at rest.
///
/// A body starts straight, or bent and twisted: its rest shape is straight, so it springs back. Each list of angles cuts
/// the length of the body into as many equal parts, from head to tail, and turns each part by its angle in all, spread
/// evenly over what bends in it: magnets stay straight. A clamped body bends from the wall on. Bent bodies may pass
/// through themselves: there is no contact between parts of a body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Start {
    /// Place of the head end along x [m].
    pub x_m: f64,
    /// Height of the lowest point over the ground [m]: of the contact points, and of all of a bent body; of the head end
    /// where there are no contact points.
    pub height_m: f64,
    /// Rotation in the plane x–y about the head end, anticlockwise [°].
    pub angle_deg: f64,
    /// Place of the head end along z [m]; 0 in the plane.
    pub z_m: f64,
    /// Rotation about the vertical +y through the head end, after `angle_deg`, anticlockwise seen
    /// from above [°]; 0 in the plane.
    pub yaw_deg: f64,
    /// Bending of each part in its own plane of tangent and up, anticlockwise from head to tail: its tail turns towards its
    /// up direction [°]. Empty: straight.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bends_deg: Vec<f64>,
    /// Bending of each part towards its own side, which is +z of the straight body at yaw 0 [°]; 0 in the plane.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bends_aside_deg: Vec<f64>,
    /// Twist of each part about its own tangent, which turns up towards side [°]; 0 in the plane.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub twists_deg: Vec<f64>,
}

/// What a reset draws at random, from each environment's own seed and episode.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Reset {
    /// Whether a controlled drive starts at a random place within its limits; else it starts
    /// centred and low.
    pub random_drive: bool,
    /// Parameters to vary.
    pub vary: Vec<Variation>,
}

/// A parameter multiplied by a factor drawn uniformly from [low, high].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variation {
    /// Which parameter.
    pub parameter: Parameter,
    /// Smallest factor.
    pub low: f64,
    /// Largest factor.
    pub high: f64,
}

/// Parameters that each environment of a batch may have for its own, as factors of the scene's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// Young's modulus, and with it the stiffness of every branch that relaxes.
    Stiffness,
    /// Kelvin–Voigt retardation time.
    Damping,
    /// Mass of rubber and magnets.
    Mass,
    /// Remanence of the body magnets.
    Remanence,
    /// Static coefficient of friction.
    StaticFriction,
    /// Dynamic coefficient of friction.
    DynamicFriction,
    /// Velocity of a drive in constant motion.
    DriveSpeed,
    /// Horizontal force of the drive.
    HorizontalForce,
    /// Vertical force of the drive.
    VerticalForce,
    /// Torque of the drive.
    Torque,
    /// Forces and torques of the body's magnets on each other.
    Mutual,
}

impl Parameter {
    /// The name used in scenes and from Python.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::Damping => "damping",
            Self::Mass => "mass",
            Self::Remanence => "remanence",
            Self::StaticFriction => "static_friction",
            Self::DynamicFriction => "dynamic_friction",
            Self::DriveSpeed => "drive_speed",
            Self::HorizontalForce => "horizontal_force",
            Self::VerticalForce => "vertical_force",
            Self::Torque => "torque",
            Self::Mutual => "mutual",
        }
    }
}
