//! Torque of a uniform field on a magnet.

use super::{Cuboid, MU_0};
use crate::lanes::{Real, Vec3};

/// A body magnet in a uniform field.
///
/// T = m × B with the moment m = (Br V/μ0) u along the unit vector u; there is no force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformField {
    /// Volume over μ0 [m³·A²/N].
    volume: f64,
}

impl UniformField {
    /// The magnet `body`.
    pub fn new(body: Cuboid) -> Self {
        UniformField { volume: body.volume_m3() / MU_0 }
    }

    /// Torque [N·m] in the field `b` [T] on a body with its moment along `u`; `remanence` [T], signed.
    #[inline(always)]
    pub fn torque<F: Real>(&self, b: Vec3<F>, u: Vec3<F>, remanence: F) -> Vec3<F> {
        u.cross(b) * (remanence * self.volume)
    }
}
