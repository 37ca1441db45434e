//! Torque of a uniform field on a magnet.

use super::{Cuboid, MU_0};
use crate::lanes::Real;

/// A body magnet, magnetised along its own height, in a uniform field.
///
/// T = m × B with the moment m = (Br V/μ0) u, u the body's up direction, in the plane (−sin θ, cos θ);
/// there is no force.
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

    /// Torque T_z [N·m] in the field (`bx`, `by`) [T]; `cos`, `sin`: of the body's angle;
    /// `remanence` [T], signed.
    #[inline(always)]
    pub fn torque<F: Real>(&self, bx: F, by: F, cos: F, sin: F, remanence: F) -> F {
        -(remanence * self.volume) * (sin * by + cos * bx)
    }

    /// Torque [N·m] in the field `b` [T] on a body with the up direction `up`; `remanence` [T], signed.
    #[inline(always)]
    pub fn torque_in_space<F: Real>(&self, b: [F; 3], up: &[F; 3], remanence: F) -> [F; 3] {
        let moment = remanence * self.volume;
        [
            moment * (up[1] * b[2] - up[2] * b[1]),
            moment * (up[2] * b[0] - up[0] * b[2]),
            moment * (up[0] * b[1] - up[1] * b[0]),
        ]
    }
}
