//! Wrench in the plane between magnets whose remanences lean from up.

use super::{Cuboid, Magnet, PlanarPair};
use crate::lanes::Real;

/// Drive and body magnet as in [`PlanarPair`], each magnetised in any direction of the plane: the sum of up to four pairs,
/// of which each is magnetised along one edge. A magnet that is magnetised along its length is an upright one with its
/// edges swapped, in a frame turned back by a quarter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObliquePair {
    /// By the edge along which the drive is magnetised, length or height, and that of the body: the pair and the product
    /// of both components; none where it is 0.
    parts: [[Option<(PlanarPair, f64)>; 2]; 2],
}

impl ObliquePair {
    /// A pair whose integrals along the body's edges take `order` points each. Sizes are length, height and width; what
    /// remanences point aside has no part in the plane.
    ///
    /// # Panics
    /// If `order` is not in 1..=[`MAX_ORDER`](super::MAX_ORDER).
    pub fn new(drive: &Magnet, body: &Magnet, order: usize) -> Self {
        let part = |source: usize, target: usize| {
            let strength = drive.remanence_t[source] * body.remanence_t[target];
            let pair = || PlanarPair::new(upright(drive, source), upright(body, target), order);
            (strength != 0.0).then(|| (pair(), strength))
        };
        Self { parts: [0, 1].map(|source| [0, 1].map(|target| part(source, target))) }
    }

    /// As [`PlanarPair::wrench`]; `scale` multiplies the product of both remanences.
    #[inline(always)]
    pub fn wrench<F: Real>(&self, dx: F, dy: F, cos: F, sin: F, scale: F) -> [F; 3] {
        let mut total = [dx.splat(0.0); 3];
        for source in [1, 0] {
            // Turned back by a quarter, what was along is up.
            let (x, y, c, s) = if source == 0 { (-dy, dx, -sin, cos) } else { (dx, dy, cos, sin) };
            for target in [1, 0] {
                let Some((pair, strength)) = &self.parts[source][target] else { continue };
                let (c, s) = if target == 0 { (s, -c) } else { (c, s) };
                let [fx, fy, torque] = pair.wrench(x, y, c, s, scale * *strength);
                let [fx, fy] = if source == 0 { [fy, -fx] } else { [fx, fy] };
                total = [total[0] + fx, total[1] + fy, total[2] + torque];
            }
        }
        total
    }
}

/// The cuboid as one that is magnetised along its height.
fn upright(magnet: &Magnet, along: usize) -> Cuboid {
    let size_m = magnet.size_m;
    Cuboid { length_m: size_m[1 - along], height_m: size_m[along], width_m: size_m.z }
}
