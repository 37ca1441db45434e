//! Wrench in the plane on a magnet whose remanence leans from up.

use super::{Cuboid, PlanarPair};
use crate::lanes::Real;

/// Drive and body magnet as in [`PlanarPair`], the body magnetised in any direction of the plane: the sum of two magnets
/// of the same shape, of which one is magnetised up and the other along the body. The latter is an upright one
/// with its edges swapped, in a frame turned by a quarter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObliquePair {
    /// Magnetised up, and its share; none where the body has no remanence up.
    up: Option<(PlanarPair, f64)>,
    /// Magnetised along the body, and its share.
    along: Option<(PlanarPair, f64)>,
}

impl ObliquePair {
    /// A pair whose integrals along the body's edges take `order` points each. `direction`: of the remanence, along the body and
    /// up; what points aside has no part in the plane.
    ///
    /// # Panics
    /// If `order` is not in 1..=[`MAX_ORDER`](super::MAX_ORDER).
    pub fn new(drive: Cuboid, body: Cuboid, direction: [f64; 3], order: usize) -> Self {
        let [along, up, _] = direction;
        let swapped = Cuboid { length_m: body.height_m, height_m: body.length_m, ..body };
        let pair =
            |body, share: f64| (share != 0.0).then(|| (PlanarPair::new(drive, body, order), share));
        Self { up: pair(body, up), along: pair(swapped, along) }
    }

    /// As [`PlanarPair::wrench`].
    #[inline(always)]
    pub fn wrench<F: Real>(&self, dx: F, dy: F, cos: F, sin: F, strength: F) -> [F; 3] {
        let mut total = [dx.splat(0.0); 3];
        if let Some((pair, share)) = &self.up {
            total = pair.wrench(dx, dy, cos, sin, strength * *share);
        }
        if let Some((pair, share)) = &self.along {
            // Turned back by a quarter, what was along is up.
            let wrench = pair.wrench(dx, dy, sin, -cos, strength * *share);
            for axis in 0..3 {
                total[axis] = total[axis] + wrench[axis];
            }
        }
        total
    }
}
