//! The plane and space: sizes and products that differ between them.
//!
//! Kernels are generic over [`Dim`] and say ω × r or r × f once. In the plane an angular velocity and a torque are numbers,
//! a surface has one tangent, and a body has one rotation; in space all of these have more components.

use super::{Components, Real, Vec3, Vector};

/// [`Plane`] or [`Space`].
pub trait Dim: Copy + Send + Sync + 'static {
    /// Axes of a position: x, y, in space z.
    const AXES: usize;
    /// Rotations of a body: about z, in space about x, y, z.
    const ROTATIONS: usize;
    /// Unknowns of a body: its position, then its rotations.
    const BODY: usize = Self::AXES + Self::ROTATIONS;
    /// Tangents of a surface.
    const TANGENTS: usize = Self::AXES - 1;
    /// Products of inertia of a body: one for each pair of its rotations.
    const PRODUCTS: usize = Self::ROTATIONS * (Self::ROTATIONS - 1) / 2;
    /// Numbers of an orientation as arrays hold it: an angle, in space a quaternion.
    const ORIENTATION: usize;
    /// Axes of a stage: x and y, in space also z and yaw.
    const STAGE: usize;
    /// Where contact points stand across a foot, in its widths.
    const ACROSS: &'static [f64];

    /// Position, velocity or force.
    type Vector<F: Real>: Components<F>;
    /// Axes of a body: its tangent, whose components are cosine and sine of its angle; in space tangent, up and side.
    type Frame<F: Real>: Components<F>;
    /// Angular velocity or torque.
    type Angular<F: Real>: Components<F>;
    /// Components along the tangents of a surface.
    type Tangent<F: Real>: Components<F>;
    /// Symmetric matrix over the tangents of a surface: its lower half by rows.
    type Symmetric<F: Real>: Components<F>;

    /// ω × r.
    fn angular_cross<F: Real>(w: Self::Angular<F>, r: Self::Vector<F>) -> Self::Vector<F>;
    /// e × r with e along an axis.
    fn axis_cross<F: Real>(axis: usize, r: Self::Vector<F>) -> Self::Angular<F>;
    /// r × f.
    fn torque<F: Real>(r: Self::Vector<F>, f: Self::Vector<F>) -> Self::Angular<F>;
    /// h ω × (ω × r).
    fn centripetal<F: Real>(w: Self::Angular<F>, r: Self::Vector<F>, h: f64) -> Self::Vector<F>;
    /// |t|.
    fn length<F: Real>(t: Self::Tangent<F>) -> F;
    /// t/|t|; of a vector without length +x.
    fn direction<F: Real>(t: Self::Tangent<F>) -> Self::Tangent<F>;
    /// a I − b e eᵀ with the direction e.
    fn isotropic_less<F: Real>(a: F, b: F, e: Self::Tangent<F>) -> Self::Symmetric<F>;
    /// a I.
    fn isotropic<F: Real>(a: F) -> Self::Symmetric<F>;
    /// Column of S.
    fn column<F: Real>(s: Self::Symmetric<F>, tangent: usize) -> Self::Tangent<F>;
    /// c + S t.
    fn add_product<F: Real>(
        c: Self::Tangent<F>,
        s: Self::Symmetric<F>,
        t: Self::Tangent<F>,
    ) -> Self::Tangent<F>;
    /// A vector given along the axes of a body (tangent, up, side), along the world's; the body's frame as its rows hold it.
    fn to_world<F: Real>(frame: Self::Frame<F>, place: [f64; 3]) -> Self::Vector<F>;
    /// Axis of a body: tangent, up, in space side; the body's frame as its rows hold it.
    fn axis<F: Real>(frame: Self::Frame<F>, axis: usize) -> Self::Vector<F>;
    /// Tangents of a surface that has this normal. That of +y in the plane is +x.
    fn tangents<F: Real>(normal: Self::Vector<F>) -> [Self::Vector<F>; 2];
}

/// Motion in the plane x–y.
#[derive(Clone, Copy, Debug)]
pub struct Plane;

/// Motion in space.
#[derive(Clone, Copy, Debug)]
pub struct Space;

/// Length below which a vector has no direction.
const NO_LENGTH: f64 = 1e-30;

impl Dim for Plane {
    const AXES: usize = 2;
    const ROTATIONS: usize = 1;
    const ORIENTATION: usize = 1;
    const STAGE: usize = 2;
    const ACROSS: &'static [f64] = &[0.0];

    type Vector<F: Real> = Vector<F, 2>;
    type Frame<F: Real> = Vector<F, 2>;
    type Angular<F: Real> = Vector<F, 1>;
    type Tangent<F: Real> = Vector<F, 1>;
    type Symmetric<F: Real> = Vector<F, 1>;

    #[inline(always)]
    fn angular_cross<F: Real>(w: Vector<F, 1>, r: Vector<F, 2>) -> Vector<F, 2> {
        Vector([-(w[0] * r[1]), w[0] * r[0]])
    }
    #[inline(always)]
    fn axis_cross<F: Real>(axis: usize, r: Vector<F, 2>) -> Vector<F, 1> {
        Vector([[r[1], -r[0]][axis]])
    }
    #[inline(always)]
    fn torque<F: Real>(r: Vector<F, 2>, f: Vector<F, 2>) -> Vector<F, 1> {
        Vector([r[0] * f[1] - r[1] * f[0]])
    }
    #[inline(always)]
    fn centripetal<F: Real>(w: Vector<F, 1>, r: Vector<F, 2>, h: f64) -> Vector<F, 2> {
        -(r * (w[0] * w[0] * h))
    }
    #[inline(always)]
    fn length<F: Real>(t: Vector<F, 1>) -> F {
        t[0].abs()
    }
    #[inline(always)]
    fn direction<F: Real>(t: Vector<F, 1>) -> Vector<F, 1> {
        Vector([t[0].splat(1.0).copysign(t[0])])
    }
    #[inline(always)]
    fn isotropic_less<F: Real>(a: F, b: F, _: Vector<F, 1>) -> Vector<F, 1> {
        Vector([a - b])
    }
    #[inline(always)]
    fn isotropic<F: Real>(a: F) -> Vector<F, 1> {
        Vector([a])
    }
    #[inline(always)]
    fn column<F: Real>(s: Vector<F, 1>, _: usize) -> Vector<F, 1> {
        s
    }
    #[inline(always)]
    fn add_product<F: Real>(c: Vector<F, 1>, s: Vector<F, 1>, t: Vector<F, 1>) -> Vector<F, 1> {
        Vector([c[0] + s[0] * t[0]])
    }
    #[inline(always)]
    fn to_world<F: Real>(frame: Vector<F, 2>, [along, up, _]: [f64; 3]) -> Vector<F, 2> {
        let [cos, sin] = frame.0;
        Vector([cos * along - sin * up, sin * along + cos * up])
    }
    #[inline(always)]
    fn axis<F: Real>(frame: Vector<F, 2>, axis: usize) -> Vector<F, 2> {
        let [cos, sin] = frame.0;
        Vector([[cos, sin], [-sin, cos]][axis])
    }
    #[inline(always)]
    fn tangents<F: Real>(normal: Vector<F, 2>) -> [Vector<F, 2>; 2] {
        [Vector([normal[1], -normal[0]]); 2]
    }
}

impl Dim for Space {
    const AXES: usize = 3;
    const ROTATIONS: usize = 3;
    const ORIENTATION: usize = 4;
    const STAGE: usize = 4;
    const ACROSS: &'static [f64] = &[-0.5, 0.5];

    type Vector<F: Real> = Vec3<F>;
    type Frame<F: Real> = Vector<F, 9>;
    type Angular<F: Real> = Vec3<F>;
    type Tangent<F: Real> = Vector<F, 2>;
    type Symmetric<F: Real> = Vec3<F>;

    #[inline(always)]
    fn angular_cross<F: Real>(w: Vec3<F>, r: Vec3<F>) -> Vec3<F> {
        w.cross(r)
    }
    #[inline(always)]
    fn axis_cross<F: Real>(axis: usize, r: Vec3<F>) -> Vec3<F> {
        let zero = r[0].splat(0.0);
        Vector([[zero, -r[2], r[1]], [r[2], zero, -r[0]], [-r[1], r[0], zero]][axis])
    }
    #[inline(always)]
    fn torque<F: Real>(r: Vec3<F>, f: Vec3<F>) -> Vec3<F> {
        r.cross(f)
    }
    #[inline(always)]
    fn centripetal<F: Real>(w: Vec3<F>, r: Vec3<F>, h: f64) -> Vec3<F> {
        w.cross(w.cross(r)) * r[0].splat(h)
    }
    #[inline(always)]
    fn length<F: Real>(t: Vector<F, 2>) -> F {
        t.norm_squared().sqrt()
    }
    #[inline(always)]
    fn direction<F: Real>(t: Vector<F, 2>) -> Vector<F, 2> {
        let (zero, one) = (t[0].splat(0.0), t[0].splat(1.0));
        let length = Self::length(t);
        let none = length.lt(one * NO_LENGTH);
        let over = one / F::select(none, one, length);
        Vector::select(none, Vector([one, zero]), t * over)
    }
    #[inline(always)]
    fn isotropic_less<F: Real>(a: F, b: F, e: Vector<F, 2>) -> Vec3<F> {
        Vector([a - b * e[0] * e[0], -(b * e[0] * e[1]), a - b * e[1] * e[1]])
    }
    #[inline(always)]
    fn isotropic<F: Real>(a: F) -> Vec3<F> {
        Vector([a, a.splat(0.0), a])
    }
    #[inline(always)]
    fn column<F: Real>(s: Vec3<F>, tangent: usize) -> Vector<F, 2> {
        Vector([s[tangent], s[tangent + 1]])
    }
    #[inline(always)]
    fn add_product<F: Real>(c: Vector<F, 2>, s: Vec3<F>, t: Vector<F, 2>) -> Vector<F, 2> {
        Vector([c[0] + s[0] * t[0] + s[1] * t[1], c[1] + s[1] * t[0] + s[2] * t[1]])
    }
    #[inline(always)]
    fn to_world<F: Real>(frame: Vector<F, 9>, [along, up, side]: [f64; 3]) -> Vec3<F> {
        let [tx, ty, tz, ux, uy, uz, sx, sy, sz] = frame.0;
        Vector([
            tx * along + ux * up + sx * side,
            ty * along + uy * up + sy * side,
            tz * along + uz * up + sz * side,
        ])
    }
    #[inline(always)]
    fn axis<F: Real>(frame: Vector<F, 9>, axis: usize) -> Vec3<F> {
        let [tx, ty, tz, ux, uy, uz, sx, sy, sz] = frame.0;
        Vector([[tx, ty, tz], [ux, uy, uz], [sx, sy, sz]][axis])
    }
    /// Without a branch and without cancellation (Duff et al. 2017).
    #[inline(always)]
    fn tangents<F: Real>(normal: Vec3<F>) -> [Vec3<F>; 2] {
        let [x, y, z] = normal.0;
        let sign = z.splat(1.0).copysign(z);
        let a = -(z.splat(1.0) / (sign + z));
        let b = x * y * a;
        [Vector([x * x * a * sign + 1.0, sign * b, -(sign * x)]), Vector([b, sign + y * y * a, -y])]
    }
}
