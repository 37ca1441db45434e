//! Cuboid magnets: field, wrench, dipole approximation.
//!
//! | file | model |
//! |---|---|
//! | `cuboid` | field of a cuboid in closed form, at any point: [`field_t`]; in lanes: `unit_field` |
//! | `planar` | wrench between two cuboids in the simulator's plane, in lanes: [`PlanarPair`] |
//! | `oblique` | the same between magnets of any direction in the plane: [`ObliquePair`] |
//! | `reaction` | what the target does to the source: [`reaction()`] |
//! | `spatial` | wrench between two cuboids in space, in lanes: [`SpatialPair`] |
//! | `wrench` | the same at any distance: [`wrench()`]; with `near`, `far` and `separation` |
//! | `dipole` | both magnets as points, and the error of that: [`PlanarDipole`], [`SpatialDipole`] |
//! | `far_pair` | two magnets as points wherever they point, with a bound: [`FarPair`] |
//! | `orders` | how many points two cuboids need at a distance: [`orders_by_distance`] |
//! | `uniform` | torque of a uniform field: [`UniformField`] |
//! | `quadrature` | Gauss–Legendre rules: [`GaussLegendre`] |
//!
//! All magnets have unity relative permeability and a uniform, rigid magnetisation J; "remanence"
//! is J in tesla. Such a magnet acts and feels like the charge σ = J·n/μ0 on its faces.
//!
//! Closed-form torques in the literature contain disputed terms, so the torque is always
//! integrated from the field: T = ∬ σ r × B dS, which quadrature resolves to any accuracy.
//!
//! Frames: the simulator has x along the robot, y up and z out of the plane. [`Cuboid`] names its
//! edges by these directions and is magnetised along its height; the spatial functions take
//! vectors and any magnetisation.

mod cuboid;
mod dipole;
mod far;
mod far_pair;
mod near;
mod oblique;
mod orders;
mod planar;
mod quadrature;
mod reaction;
mod separation;
mod spatial;
#[cfg(test)]
mod tests;
mod uniform;
mod wrench;

pub use cuboid::field_t;
pub use dipole::{PlanarDipole, SpatialDipole, dipole_wrench};
pub use far_pair::FarPair;
pub use oblique::ObliquePair;
pub use orders::orders_by_distance;
pub use planar::PlanarPair;
pub use quadrature::{GaussLegendre, MAX_ORDER};
pub use reaction::reaction;
pub use spatial::SpatialPair;
pub use uniform::UniformField;
pub use wrench::{Overlap, wrench};

use nalgebra::Vector3;

/// Vacuum permeability [N/A²] (CODATA 2022).
pub const MU_0: f64 = 1.256_637_061_27e-6;

/// Edge lengths of a cuboid magnet that is magnetised along its height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Edge along the robot, x [m].
    pub length_m: f64,
    /// Edge across the ground, y [m].
    pub height_m: f64,
    /// Edge across the plane of motion, z [m].
    pub width_m: f64,
}

impl Cuboid {
    /// Volume [m³].
    pub fn volume_m3(&self) -> f64 {
        self.length_m * self.height_m * self.width_m
    }
}

/// A cuboid magnet in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnet {
    /// Edge lengths [m].
    pub size_m: Vector3<f64>,
    /// Remanence with its direction [T].
    pub remanence_t: Vector3<f64>,
}

/// Force and torque on a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force [N].
    pub force_n: Vector3<f64>,
    /// Torque about the body's centre [N·m].
    pub torque_n_m: Vector3<f64>,
}
