//! Two magnets as points, wherever they point: what is left of a pair that is far apart, with a bound of the error.
//!
//! Two cuboids are clouds of dipoles. With ξ the difference of a place in one and a place in the other, both from their
//! centres, the force is the mean of K(d + ξ), K the force of two dipoles. Odd powers of ξ vanish in the mean. K is made of
//! third derivatives of 1/r, and a derivative of order n along any unit vectors is at most n!/rⁿ⁺¹ (a symmetric form is
//! greatest along a single direction, where it is n! P_n/rⁿ⁺¹), so the term of order k is at most
//!
//! (m m' μ0/4π) (k+1)(k+2)(k+3) E|ξ|ᵏ/rᵏ⁺⁴.
//!
//! 1/r is harmonic, so that in the second order only differences of the variances of ξ count: greatest less least.

use super::{MU_0, Magnet};
use crate::lanes::{Components, Dim, Real};

/// The dipoles of two magnets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FarPair {
    /// Product of both volumes over 4π μ0 [m⁶·A²/N].
    scale: f64,
}

impl FarPair {
    /// The dipoles of two magnets.
    pub fn new(source: &Magnet, target: &Magnet) -> Self {
        let volumes = source.size_m.product() * target.size_m.product();
        Self { scale: volumes / (4.0 * std::f64::consts::PI * MU_0) }
    }

    /// Force [N] on the target and torque about its centre [N·m]: Yung, Landecker & Villani (1998), see
    /// [`super::SpatialDipole`].
    ///
    /// `offset` [m]: from the source to the target; `a`, `b`: their directions, in the same axes; `strength` [T²]: product of
    /// both remanences.
    #[inline(always)]
    pub fn wrench<D: Dim, F: Real>(
        &self,
        offset: D::Vector<F>,
        a: D::Vector<F>,
        b: D::Vector<F>,
        strength: F,
    ) -> (D::Vector<F>, D::Angular<F>) {
        let one = strength.splat(1.0);
        let inverse_square = one / offset.norm_squared();
        let inverse = inverse_square.sqrt();
        let e = offset * inverse;
        let (along_a, along_b) = (a.dot(e), b.dot(e));
        let cubed = strength * (inverse * inverse_square) * self.scale;
        let radial = a.dot(b) - along_a * along_b * 5.0;
        let force = (a * along_b + b * along_a + e * radial) * (cubed * inverse * 3.0);
        let field = (e * (along_a * 3.0) - a) * cubed;
        (force, D::torque(b, field))
    }

    /// Bound of the error of the force at a distance beyond both half diagonals [m], whatever the directions [N/T²].
    pub fn error_n_t2(&self, source: &Magnet, target: &Magnet, distance_m: f64) -> f64 {
        let (x, y) = (Cloud::of(source), Cloud::of(target));
        let square_m2 = distance_m * distance_m;
        let reach = (x.reach_m + y.reach_m) / distance_m;
        // |x − y|⁴ = (x² + y² − 2 x·y)².
        let fourth_m4 = x.fourth_m4
            + y.fourth_m4
            + 2.0 * x.second_m2 * y.second_m2
            + 4.0 * x.greatest_m2 * y.second_m2;
        let mut sum = 60.0 * (x.spread_m2 + y.spread_m2) / square_m2;
        let mut moment = fourth_m4 / (square_m2 * square_m2);
        for k in (4..200).step_by(2) {
            let k = f64::from(k);
            sum += (k + 1.0) * (k + 2.0) * (k + 3.0) * moment;
            // No place is further from the centre than a corner.
            moment = moment * reach * reach;
        }
        self.scale * sum / (square_m2 * square_m2)
    }
}

/// Moments of the places in a cuboid.
struct Cloud {
    /// E x².
    second_m2: f64,
    /// E x⁴.
    fourth_m4: f64,
    /// Greatest variance along an edge.
    greatest_m2: f64,
    /// The same less the least one.
    spread_m2: f64,
    /// Half the diagonal.
    reach_m: f64,
}

impl Cloud {
    fn of(magnet: &Magnet) -> Self {
        let squares = magnet.size_m.component_mul(&magnet.size_m);
        let variances = squares / 12.0;
        let second_m2 = variances.sum();
        Self {
            second_m2,
            fourth_m4: squares.norm_squared() / 80.0 - variances.norm_squared()
                + second_m2 * second_m2,
            greatest_m2: variances.max(),
            spread_m2: variances.max() - variances.min(),
            reach_m: 0.5 * magnet.size_m.norm(),
        }
    }
}
