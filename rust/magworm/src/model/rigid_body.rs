//! Rigid bodies: elements of the rod that magnets make rigid.

use super::coordinates::Coordinates;
use super::{MassPart, Mesh, OffCentre, inertia};
use crate::scene::{RigidElement, Scene};
use std::ops::Range;

/// An element of the rod that is rigid, with all that it carries.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidBody {
    /// The element.
    pub element: usize,
    /// Distance of its nodes from its middle [m].
    pub half_length_m: f64,
    /// First unknown: the place of its middle, then its rotation.
    pub dof: usize,
    /// Contributions to its mass and moments of inertia, beside the rubber on its ends.
    pub inertia: Vec<MassPart>,
    /// Where its centre of mass may lie beside its middle; none costs nothing.
    pub off_centre: Option<OffCentre>,
    /// Its magnets in [`super::Model::magnets`].
    pub magnets: Range<usize>,
}

impl RigidBody {
    /// The bodies of a mesh, head first.
    pub(super) fn all(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<Self> {
        let mut rows = 0;
        let mut bodies = Vec::new();
        for (body, &RigidElement { element, half_length_m }) in mesh.bodies.iter().enumerate() {
            let off_centre = inertia::off_centre(scene, mesh, coordinates, body, rows);
            rows += off_centre.as_ref().map_or(0, |_| coordinates.sizes().moments());
            bodies.push(Self {
                element,
                half_length_m,
                dof: coordinates.bodies[body],
                inertia: inertia::body_parts(scene, mesh, coordinates, body),
                off_centre,
                magnets: mesh.magnets_of(body),
            });
        }
        bodies
    }
}
