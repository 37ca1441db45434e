//! Field of a uniformly magnetised cuboid in closed form.
//!
//! The charge model (Furlani 2001, Akoun & Yonnet 1984): a cuboid magnetised along z with
//! remanence J carries ± J/μ0 on its two faces across z. With corner offsets U = x ∓ a,
//! V = y ∓ b, W = z ∓ c, their norm r and the sign ± of each corner,
//!
//! B = (J/4π) Σ ± [ln(r − V), ln(r − U), atan(UV/(rW))]   (+ J ẑ inside).
//!
//! The four logarithms of an edge's two ends fold by ln((r₁+V₁)/(r₀+V₀)) = ln((R+L)/(R−L)) with
//! R = r₀ + r₁ and the edge's length L, which does not cancel on the edge's extension; the four
//! edges of a component fold into one logarithm of a ratio of products.

use super::far::{self, FAR};
use crate::lanes::Real;
use crate::lanes::math::{atan2, ln_ratio};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Flux density B [T] at a point, in the frame of a cuboid magnet at the origin.
///
/// `size_m`: edge lengths [m]; `remanence_t`: magnetisation times μ0 [T], of any direction;
/// `position_m`: the point, outside or inside. Relative error below 1e-13 within a few sizes of
/// the magnet, on its surface and on extensions of edges and faces alike, and below 1e-9 everywhere for edges of up to
/// 1 : 10, as it passes over into a cloud of dipoles 30 sizes away. On an edge itself the field is infinite and the result
/// large and finite; on a face it is the limit from outside.
pub fn field_t(
    size_m: Vector3<f64>,
    remanence_t: Vector3<f64>,
    position_m: Vector3<f64>,
) -> Vector3<f64> {
    if position_m.norm() > FAR * size_m.max() {
        return far::field_t(size_m, remanence_t, position_m);
    }
    let (half, at) = (0.5 * size_m, position_m);
    let mut field_t = Vector3::zeros();
    for n in 0..3 {
        let (s, t) = ((n + 1) % 3, (n + 2) % 3);
        if remanence_t[n] != 0.0 {
            let b = unit_field([half[s], half[t], half[n]], [at[s], at[t], at[n]]);
            field_t[s] += b[0] * remanence_t[n];
            field_t[t] += b[1] * remanence_t[n];
            field_t[n] += b[2] * remanence_t[n];
        }
    }
    field_t
}

/// B/J of a cuboid magnetised along z, at any point: the accurate form.
///
/// Evaluated at (|x|, |y|, |z|) and mirrored, so that mirror symmetry is exact.
#[inline(always)]
pub fn unit_field<F: Real>(half: [f64; 3], at: [F; 3]) -> [F; 3] {
    let [a, b, c] = half;
    let p = [at[0].abs(), at[1].abs(), at[2].abs()];
    let corners = Corners::new(half, p);
    let bx = corners.logarithm(accurate_edge);
    let by = corners.transposed().logarithm(accurate_edge);

    let near = corners.strip_angle(0, 1) - corners.strip_angle(1, 1);
    let far = corners.strip_angle(0, 0) - corners.strip_angle(1, 0);
    let inside = p[0].lt(p[0].splat(a)) & p[1].lt(p[1].splat(b)) & p[2].lt(p[2].splat(c));
    let one = at[0].splat(1.0);
    let bz = (near - far) * (0.25 / PI) + F::select(inside, one, at[0].splat(0.0));
    let sign = one.copysign(at[2]);
    [bx * one.copysign(at[0]) * sign, by * one.copysign(at[1]) * sign, bz]
}

/// B/J of a cuboid magnetised along z, at a point outside: the fast form for quadrature.
///
/// 8 square roots, 2 logarithms, 1 arctangent. Each face's solid angle Ω is that of two triangles
/// (Van Oosterom & Strackee 1983), tan(Ω/2) = N/D. Outside the cuboid both faces together turn
/// Ω/2 by less than π, so that a single arctangent needs no choice of branch. Cancellation grows
/// near the surface, as the square of an edge's length over the distance to it: below 2e-13 of |B|
/// at a tenth of the magnet's size.
#[inline(always)]
pub fn unit_field_outside<F: Real>(half: [f64; 3], at: [F; 3]) -> [F; 3] {
    let corners = Corners::new(half, at);
    let bx = corners.logarithm(plain_edge);
    let by = corners.transposed().logarithm(plain_edge);
    let near = corners.face_triangles(1);
    let far = corners.face_triangles(0);
    let turn = atan2(near[1] * far[0] - near[0] * far[1], near[0] * far[0] + near[1] * far[1]);
    [bx, by, turn * (0.5 / PI)]
}

/// Offsets from the eight corners; index 0 is the corner at the lower coordinate, so that the
/// point lies further up from it: U₀ = x + a, U₁ = x − a.
struct Corners<F> {
    u: [F; 2],
    v: [F; 2],
    w: [F; 2],
    r: [[[F; 2]; 2]; 2],
    /// Edge lengths along u and v.
    length: [f64; 2],
}

impl<F: Real> Corners<F> {
    #[inline(always)]
    fn new(half: [f64; 3], at: [F; 3]) -> Self {
        let u = [at[0] + half[0], at[0] - half[0]];
        let v = [at[1] + half[1], at[1] - half[1]];
        let w = [at[2] + half[2], at[2] - half[2]];
        let mut r = [[[u[0]; 2]; 2]; 2];
        for i in 0..2 {
            for j in 0..2 {
                let square = u[i] * u[i] + v[j] * v[j];
                for k in 0..2 {
                    r[i][j][k] = (square + w[k] * w[k]).sqrt();
                }
            }
        }
        Corners { u, v, w, r, length: [2.0 * half[0], 2.0 * half[1]] }
    }

    /// The same corners with x and y exchanged.
    #[inline(always)]
    fn transposed(&self) -> Self {
        let r = self.r;
        let r = [[r[0][0], r[1][0]], [r[0][1], r[1][1]]];
        let length = [self.length[1], self.length[0]];
        Corners { u: self.v, v: self.u, w: self.w, r, length }
    }

    /// The edge along y at the corner offsets U_i and W_k.
    #[inline(always)]
    fn edge(&self, i: usize, k: usize) -> EdgeEnds<F> {
        EdgeEnds {
            square: self.u[i] * self.u[i] + self.w[k] * self.w[k],
            v: self.v,
            r: [self.r[i][0][k], self.r[i][1][k]],
            length: self.length[1],
        }
    }

    /// B_x/J from the four edges along y.
    #[inline(always)]
    fn logarithm(&self, edge: impl Fn(EdgeEnds<F>) -> (F, F)) -> F {
        let (a, b) = (edge(self.edge(0, 0)), edge(self.edge(1, 1)));
        let (c, d) = (edge(self.edge(0, 1)), edge(self.edge(1, 0)));
        let ratio = ln_ratio((a.0 * b.0) * (c.1 * d.1), (a.1 * b.1) * (c.0 * d.0));
        ratio * (0.25 / PI)
    }

    /// atan(UV₀/(r₀W)) − atan(UV₁/(r₁W)) as the angle of a product, within ±π.
    ///
    /// On the extension of an edge both vanish together and the product is 0: so is the angle.
    #[inline(always)]
    fn strip_angle(&self, i: usize, k: usize) -> F {
        let (u, w) = (self.u[i], self.w[k]);
        let [v0, v1] = self.v;
        let [r0, r1] = [self.r[i][0][k], self.r[i][1][k]];
        atan2(u * w * (v0 * r1 - v1 * r0), r0 * r1 * w * w + u * u * v0 * v1)
    }

    /// A vector (D, N) at the angle Ω/2 of a face's solid angle.
    #[inline(always)]
    fn face_triangles(&self, k: usize) -> [F; 2] {
        let ([u0, u1], [v0, v1], w) = (self.u, self.v, self.w[k]);
        let r = [[self.r[0][0][k], self.r[0][1][k]], [self.r[1][0][k], self.r[1][1][k]]];
        let ww = w * w;
        let (uu, vv) = (u0 * u1 + ww, v0 * v1 + ww);
        let shared = r[0][0] * r[1][1] + (uu + v0 * v1);
        let d1 = r[1][0] * shared + (uu + v0 * v0) * r[1][1] + (vv + u1 * u1) * r[0][0];
        let d2 = r[0][1] * shared + (vv + u0 * u0) * r[1][1] + (uu + v1 * v1) * r[0][0];
        let n = w * (self.length[0] * self.length[1]);
        [d1 * d2 - n * n, n * (d1 + d2)]
    }
}

/// One edge along v: distance squared from its line, offsets and distances of its ends.
struct EdgeEnds<F> {
    square: F,
    v: [F; 2],
    r: [F; 2],
    length: f64,
}

/// (R + L)/(R − L) as numerator and denominator.
#[inline(always)]
fn plain_edge<F: Real>(edge: EdgeEnds<F>) -> (F, F) {
    let sum = edge.r[0] + edge.r[1];
    (sum + edge.length, sum - edge.length)
}

/// (R + L)²/(½(R² − L²)), without cancellation beside the edge.
///
/// ½(R² − L²) = ρ² + V₀V₁ + r₀r₁; where V₀V₁ < 0 it equals ρ²(1 + (ρ² + V₀² + V₁²)/(r₀r₁ − V₀V₁)).
#[inline(always)]
fn accurate_edge<F: Real>(edge: EdgeEnds<F>) -> (F, F) {
    let sum = edge.r[0] + edge.r[1] + edge.length;
    let (vv, rr) = (edge.v[0] * edge.v[1], edge.r[0] * edge.r[1]);
    let squares = edge.square + edge.v[0] * edge.v[0] + edge.v[1] * edge.v[1];
    let beside = edge.square * (squares / (rr - vv) + 1.0);
    (sum * sum, F::select(vv.lt(sum.splat(0.0)), beside, edge.square + vv + rr))
}
