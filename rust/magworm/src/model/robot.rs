//! A robot of a scene: which nodes and bodies are its own.
//!
//! Springs, masses and contacts do not ask whose they are. Whoever steers, follows or watches does: a centre, a heading,
//! progress, an observation and the targets of a stage are those of one robot, so each names one. A scene has one, which
//! has all nodes and bodies.

use super::{Mesh, Model};
use std::ops::Range;

/// A robot. Its parts are numbered one after another, from head to tail.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Robot {
    /// Its nodes.
    pub nodes: Range<usize>,
    /// Its rigid bodies.
    pub bodies: Range<usize>,
}

impl Robot {
    /// Place in [`Model::robots`] of the one that an environment's agent observes and is judged by.
    pub const AGENT: usize = 0;

    /// The one that a whole mesh is made of.
    pub fn whole(mesh: &Mesh) -> Self {
        Self { nodes: 0..mesh.arc_m.len(), bodies: 0..mesh.bodies.len() }
    }
}

impl Model {
    /// First unknown of each body of a robot, see [`super::Coordinates::bodies`].
    #[inline(always)]
    pub fn bodies_of(&self, robot: usize) -> &[usize] {
        &self.coordinates.bodies[self.robots[robot].bodies.clone()]
    }
}
