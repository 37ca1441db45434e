//! What a person writes: the robot, its surroundings, the drive, how to integrate.
//!
//! A [`Scene`] is plain data in SI units (the unit is the end of each name), read from TOML,
//! validated once and then compiled into a [`Model`](crate::model::Model).
//!
//! Frame: x along the rest robot from head to tail, y up, z = x × y to the robot's side, the left one
//! of a robot that looks towards −x; the ground is y = 0. The head end of the rest robot stands at
//! x = 0 with its midline on z = 0. A drive magnet that moves in +x makes the robot crawl in −x.
//!
//! A scene moves in the plane x–y or, with `dimensions = 3`, in space. Yaw is a turn about the
//! vertical +y, anticlockwise seen from above: it turns x towards −z.

mod accuracy;
pub(crate) mod bends;
mod body;
mod check;
mod contact;
mod contact_point;
mod direction;
mod drive;
mod edit;
mod ensemble;
mod error;
mod fields;
mod lines;
mod mesh;
mod parse;
mod preset;
mod rules;
mod schema;
mod segments;
mod solver;
mod surroundings;
mod validate;

pub use crate::integrate::Integrator;
pub use body::{
    Body, Clamp, Magnet, Material, Relaxation, Rod, RodMagnet, Segment, SegmentMagnet, Segments,
    Worm,
};
pub use contact::{Contact, ContactPoints};
pub use contact_point::{ContactPoint, Foot, Frame};
#[doc(hidden)] // for the project's own tests
pub use direction::Direction;
pub use drive::{Arrangement, Drive, Motion, Reference, StageLimits, Suspension};
pub use error::{Problem, SceneError};
#[doc(hidden)] // for the project's own tests
pub use mesh::{Element, Mesh, MeshMagnet, RigidElement};
pub use preset::PRESETS;
pub(crate) use schema::quantity;
pub(crate) use segments::Plan;
pub use solver::{
    Control, Curvature, MagnetModel, Parameter, Precision, Reset, Solver, Start, Variation,
};
pub use surroundings::{Ground, MagneticTerms, UniformField};

use serde::{Deserialize, Serialize};

/// A scene: everything that a simulation needs to know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name, for reports.
    #[serde(default)]
    pub name: String,
    /// Gravitational acceleration [m/s²]; 0 leaves gravity out.
    #[serde(default = "standard_gravity")]
    pub gravity_m_s2: f64,
    /// Dimensions of the motion: 2 is the plane x–y, 3 is space.
    #[serde(default = "plane")]
    pub dimensions: usize,
    /// The soft body: a worm with feet, a uniform rod, or segments of one's own.
    pub body: Body,
    /// Its rubber.
    pub material: Material,
    /// The magnets of a worm or a rod, all of one kind; needed where the body has any. Segments describe their own.
    #[serde(default)]
    pub magnet: Option<Magnet>,
    /// Flat ground; none leaves contact out.
    #[serde(default)]
    pub ground: Option<Ground>,
    /// How the body touches.
    #[serde(default)]
    pub contact: Contact,
    /// Drive magnets beneath the ground; none leaves their wrench out.
    #[serde(default)]
    pub drive: Option<Drive>,
    /// A uniform magnetic field; none leaves it out.
    #[serde(default)]
    pub field: Option<UniformField>,
    /// Components of the magnetic wrench to keep (ablations).
    #[serde(default)]
    pub magnetic_terms: MagneticTerms,
    /// Pose at the start.
    #[serde(default)]
    pub start: Start,
    /// Time integration.
    #[serde(default)]
    pub solver: Solver,
    /// Control period and length of an episode.
    #[serde(default)]
    pub control: Control,
    /// What a reset draws at random.
    #[serde(default)]
    pub reset: Reset,
}

fn standard_gravity() -> f64 {
    9.81
}

fn plane() -> usize {
    2
}
