//! Wrench between two cuboids in the simulator's plane: the kernel of every step.

use super::{Cuboid, GaussLegendre, MU_0};
use crate::lanes::Real;
use crate::lanes::math::{atan2, ln_ratio};

/// Drive and body magnet, both centred in z = 0, the drive axis-aligned and the body turned about
/// z, both magnetised along their own height.
///
/// The charge model: the faces across the magnetisation carry σ = ± Br/μ0, and
/// F = ∬ σ B dS, T = ∬ σ r × B dS over the two charged faces of the body (Furlani 2001).
/// Integration along z is exact, since faces of both magnets stay parallel to z; only the
/// integral along the body's length is left to Gauss–Legendre quadrature.
///
/// Cost of one [`wrench`](Self::wrench) of order n, per lane: 16 n square roots, 12 n divisions,
/// about 670 n additions and multiplications; among them 8 n logarithms and 4 n arctangents.
/// There are no points along z, so that wide magnets cost neither time nor
/// accuracy. Drive 40 × 5 × 40 mm, body 10 × 3 × 10 mm, centres 22 mm apart in height, over a
/// sweep of poses, relative to the sweep's largest force and torque:
///
/// | order | error of the force | error of the torque |
/// |---|---|---|
/// | 1 | 4e-2 | 7e-2 |
/// | 2 | 8e-4 | 2e-3 |
/// | 3 | 2e-5 | 3e-5 |
/// | 4 | 3e-7 | 5e-7 |
/// | 5 | 5e-9 | 9e-9 |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarPair {
    /// Half of the drive's length and height [m].
    drive: [f64; 2],
    /// Half of the body's length and height [m].
    body: [f64; 2],
    /// Sum and difference of the half widths [m].
    v: [f64; 2],
    rule: GaussLegendre,
}

impl PlanarPair {
    /// A pair whose integral along the body's length takes `order` points per face.
    ///
    /// # Panics
    /// If `order` is not in 1..=[`MAX_ORDER`](super::MAX_ORDER).
    pub fn new(drive: Cuboid, body: Cuboid, order: usize) -> Self {
        let (half_drive, half_body) = (0.5 * drive.width_m, 0.5 * body.width_m);
        PlanarPair {
            drive: [0.5 * drive.length_m, 0.5 * drive.height_m],
            body: [0.5 * body.length_m, 0.5 * body.height_m],
            v: [half_drive + half_body, (half_drive - half_body).abs()],
            rule: GaussLegendre::new(order),
        }
    }

    /// Force (F_x, F_y) [N] and torque T_z about the body's centre [N·m] on the body.
    ///
    /// `dx`, `dy` [m]: from the drive's centre to the body's; `cos`, `sin`: of the body's angle;
    /// `strength` [T²]: product of both remanences, negative where they oppose.
    #[inline(always)]
    pub fn wrench<F: Real>(&self, dx: F, dy: F, cos: F, sin: F, strength: F) -> [F; 3] {
        let zero = dx.splat(0.0);
        let mut total = [zero; 3];
        for (node, weight) in self.rule.nodes().iter().zip(self.rule.weights()) {
            for side in [1.0, -1.0] {
                let (along, up) = (self.body[0] * node, self.body[1] * side);
                let rx = cos * along - sin * up;
                let ry = sin * along + cos * up;
                let [bx, by] = self.line_integral(dx + rx, dy + ry);
                let charge = weight * side;
                total[0] = total[0] + bx * charge;
                total[1] = total[1] + by * charge;
                total[2] = total[2] + (rx * by - ry * bx) * charge;
            }
        }
        let scale = strength * (self.body[0] / (std::f64::consts::TAU * MU_0));
        [total[0] * scale, total[1] * scale, total[2] * scale]
    }

    /// (2π/Br) ∫ (B_x, B_y) dz over the body's width, at (x, y) from the drive's centre [m].
    ///
    /// With corner offsets U = x ± a, W = y ∓ c, V_1,2 = b ± β, ρ² = U² + W², r² = ρ² + V² and
    /// signs ± of the corners, integrating Akoun & Yonnet's (1984) field along z gives
    /// ∫ B_x ∝ Σ ± [r − V ln((r + V)/ρ)], ∫ B_y ∝ Σ ± [V atan(UV/(rW)) + W artanh(U/r)],
    /// each at V_1 minus at V_2. Logarithms with a common factor fold into one of a ratio of
    /// products. Arctangents fold into the angle of a product of r W + i U V; their sum is half
    /// the difference of the solid angles of the drive's faces, hence within ±π outside it.
    #[inline(always)]
    fn line_integral<F: Real>(&self, x: F, y: F) -> [F; 2] {
        let [a, c] = self.drive;
        let [v1, v2] = self.v;
        let (u, w) = ([x + a, x - a], [y - c, y + c]);
        let uu = [u[0] * u[0], u[1] * u[1]];
        let ww = [w[0] * w[0], w[1] * w[1]];
        let square = [uu[0] + ww[0], uu[1] + ww[0], uu[0] + ww[1], uu[1] + ww[1]];
        let (r1, r2) = (radii(square, v1), radii(square, v2));

        let plus = square[0] * square[3];
        let minus = square[1] * square[2];
        let distances = (r1[0] - r1[1]) - (r1[2] - r1[3]) - ((r2[0] - r2[1]) - (r2[2] - r2[3]));
        let mut bx = distances - edge_logarithm(r1, v1, plus, minus) * (0.5 * v1);
        let mut by = face_angle(r1, u, w, v1) * v1;
        // Of magnets of one width these terms are 0.
        if v2 > 0.0 {
            bx = bx + edge_logarithm(r2, v2, plus, minus) * (0.5 * v2);
            by = by - face_angle(r2, u, w, v2) * v2;
        }
        let rims = rim_logarithm(r1[0] + r1[1], r2[0] + r2[1], 2.0 * a) * w[0]
            - rim_logarithm(r1[2] + r1[3], r2[2] + r2[3], 2.0 * a) * w[1];
        [bx, by + rims]
    }
}

// Corners are listed as: face y = +c with x = −a, +a, then face y = −c with x = −a, +a.

/// Distances r from ρ² and V.
#[inline(always)]
fn radii<F: Real>(square: [F; 4], v: f64) -> [F; 4] {
    let vv = v * v;
    [
        (square[0] + vv).sqrt(),
        (square[1] + vv).sqrt(),
        (square[2] + vv).sqrt(),
        (square[3] + vv).sqrt(),
    ]
}

/// 2 Σ ± ln((r + V)/ρ), given the products of ρ² of either sign.
#[inline(always)]
fn edge_logarithm<F: Real>(r: [F; 4], v: f64, plus: F, minus: F) -> F {
    let p = (r[0] + v) * (r[3] + v);
    let q = (r[1] + v) * (r[2] + v);
    ln_ratio(p * p * minus, q * q * plus)
}

/// Σ ± 2 artanh(2a/R) of one face's rim, R the sum of the distances to the ends of a side.
#[inline(always)]
fn rim_logarithm<F: Real>(r1: F, r2: F, length: f64) -> F {
    ln_ratio((r1 + length) * (r2 - length), (r1 - length) * (r2 + length))
}

/// Σ ± atan(UV/(rW)).
#[inline(always)]
fn face_angle<F: Real>(r: [F; 4], u: [F; 2], w: [F; 2], v: f64) -> F {
    let uv = [u[0] * v, u[1] * v];
    let near = turned_back(r[0] * w[0], uv[0], r[1] * w[0], uv[1]);
    let far = turned_back(r[2] * w[1], uv[0], r[3] * w[1], uv[1]);
    let (re, im) = turned_back(near.0, near.1, far.0, far.1);
    atan2(im, re)
}

/// (p + i q)(s − i t): its angle is the difference of both angles.
#[inline(always)]
fn turned_back<F: Real>(p: F, q: F, s: F, t: F) -> (F, F) {
    (p * s + q * t, q * s - p * t)
}
