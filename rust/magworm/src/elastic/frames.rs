//! Material frames in space: the axes of magnets and elements, and how they turn in time.
//!
//! A frame is an up direction u and a tangent t; side = t × u. That of a magnet turns with its angular
//! velocity. That of a soft element follows its tangent by parallel transport in time, which does not twist
//! it (Bergou 2010), and turns about it by its twist rate. So no reference frame and no angle against it are
//! kept. Rotations over a step are Cayley's with w = ω Δt,
//!
//! ```text
//! v + (w × v + ½ w × (w × v))/(1 + ¼ w²)
//! ```
//!
//! exactly orthogonal, with the angle of the exponential but for w³/12. Frames are made orthonormal again at each
//! step, so that they do not drift.

use crate::lanes::{Components, Isa, Real, Vec3, Vector};
use crate::model::Model;
use crate::state::Block;

/// Brings the frames of the elements up to date with their tangents, and their sides with both.
#[inline(always)]
pub fn update_frames<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let (director, tangent, side) = (&mut *block.director, &mut *block.tangent, &mut *block.side);
    for (element, rigid) in model.coordinates.rigid.iter().enumerate() {
        let frame = &mut director[6 * element..][..6];
        let before = Vector::load(isa, &frame[3..]);
        let mut up = Vector::load(isa, frame);
        let mut t = Vector::load(isa, &tangent[3 * element..]);
        if rigid.is_some() {
            t = before;
            t.store(isa, &mut tangent[3 * element..]);
        } else {
            up = parallel_transport(up, before, t);
            up.store_where(isa, running, frame);
            t.store_where(isa, running, &mut frame[3..]);
        }
        t.cross(up).store(isa, &mut side[3 * element..]);
    }
}

/// u carried from the tangent t₀ to t, u − (u·t)/(1 + t₀·t) (t₀ + t), and made orthonormal to t.
#[inline(always)]
fn parallel_transport<F: Real>(u: Vec3<F>, before: Vec3<F>, t: Vec3<F>) -> Vec3<F> {
    let share = u.dot(t) / (before.dot(t) + 1.0);
    orthonormal(u - (before + t) * share, t)
}

/// u made orthogonal to t and of unit length, given that it nearly is.
#[inline(always)]
fn orthonormal<F: Real>(u: Vec3<F>, t: Vec3<F>) -> Vec3<F> {
    unit(u - t * u.dot(t))
}

/// A vector of nearly unit length, made so to second order (a step of Newton's).
#[inline(always)]
fn unit<F: Real>(a: Vec3<F>) -> Vec3<F> {
    a * (a.norm_squared() * -0.5 + 1.5)
}

/// Turns the frames over a step in the lanes of a mask: those of soft elements by their twist rate, those of
/// magnets by their angular velocity.
#[inline(always)]
pub fn rotate_frames<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, mask: I::M) {
    for (element, twist) in model.coordinates.twists.iter().enumerate() {
        let Some(dof) = *twist else { continue };
        let angle = isa.load(&block.end_velocity[dof]) * (0.5 * model.step_s);
        let up: Vec3<I::F> = Vector::load(isa, &block.director[6 * element..]);
        let side = Vector::load(isa, &block.side[3 * element..]);
        // Cayley's rotation about the tangent: tan of half the angle is ½ ω Δt.
        let over = isa.splat(2.0) / (angle * angle + 1.0);
        let turned = up * (over - 1.0) + side * (angle * over);
        turned.store_where(isa, mask, &mut block.director[6 * element..]);
    }
    for (body, &dof) in model.coordinates.bodies.iter().enumerate() {
        rotate_magnet(isa, model, block, [body, dof], mask);
    }
}

/// Turns the frame of a magnet over a step.
///
/// Its angular velocity afterwards is that of its angular momentum I ω in the turned frame:
/// this is the gyroscopic torque ω × I ω, without error in the momentum.
#[inline(always)]
fn rotate_magnet<I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    [body, dof]: [usize; 2],
    mask: I::M,
) {
    let element = model.bodies[body].element;
    let rate = Vector::load(isa, &block.end_velocity[dof + 3..]);
    let momentum = angular_momentum(isa, block, body, dof, rate);
    let half = rate * isa.splat(0.5 * model.step_s);
    let frame = &block.director[6 * element..][..6];
    let t = unit(rotated(Vector::load(isa, &frame[3..]), half));
    let up = orthonormal(rotated(Vector::load(isa, frame), half), t);
    let (one, zero) = (isa.splat(1.0), isa.splat(0.0));
    let mut after = Vec3::splat(zero);
    for (k, axis) in [t, up, t.cross(up)].into_iter().enumerate() {
        let moment = isa.load(&block.mass[dof + 3 + k]);
        // A robot without mass keeps its rate.
        let heavy = moment.gt(zero);
        let of_momentum = axis.dot(momentum) / I::F::select(heavy, moment, one);
        after = after + axis * I::F::select(heavy, of_momentum, axis.dot(rate));
    }
    let frame = &mut block.director[6 * element..][..6];
    up.store_where(isa, mask, frame);
    t.store_where(isa, mask, &mut frame[3..]);
    after.store_where(isa, mask, &mut block.v[dof + 3..]);
}

/// Cayley's rotation of `a` by twice the vector `half`.
#[inline(always)]
fn rotated<F: Real>(a: Vec3<F>, half: Vec3<F>) -> Vec3<F> {
    let once = half.cross(a);
    let twice = once + half.cross(once);
    a + twice * (a[0].splat(2.0) / (half.norm_squared() + 1.0))
}

/// I ω of a magnet, with its moments of inertia about tangent, up and side in the rows of `mass`.
#[inline(always)]
fn angular_momentum<I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: usize,
    dof: usize,
    rate: Vec3<I::F>,
) -> Vec3<I::F> {
    let mut momentum = Vec3::splat(isa.splat(0.0));
    for (k, axis) in body_axes(isa, block, body).into_iter().enumerate() {
        let share = axis.dot(rate) * isa.load(&block.mass[dof + 3 + k]);
        momentum = momentum + axis * share;
    }
    momentum
}

/// Tangent, up and side of a magnet.
#[inline(always)]
pub fn body_axes<I: Isa>(isa: I, block: &Block<I::Row>, body: usize) -> [Vec3<I::F>; 3] {
    let rows = &block.frame[9 * body..][..9];
    [Vector::load(isa, rows), Vector::load(isa, &rows[3..]), Vector::load(isa, &rows[6..])]
}

/// M on the left and M v on the right for the rotation of the magnets, whose inertia Σ I a aᵀ turns with their axes a.
#[inline(always)]
pub fn rotary_inertia<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    for (body, &dof) in model.coordinates.bodies.iter().enumerate() {
        let a = body_axes(isa, block, body);
        let first = dof + 3;
        for row in 0..3 {
            let mut momentum = isa.splat(0.0);
            for column in 0..3 {
                let mut entry = isa.splat(0.0);
                for k in 0..3 {
                    let moment = isa.load(&block.mass[first + k]);
                    entry = entry + moment * a[k][row] * a[k][column];
                }
                momentum = momentum + entry * isa.load(&block.v[first + column]);
                if column <= row {
                    let place = model.system.at(first + row, first + column);
                    isa.store(entry, &mut block.matrix[place]);
                }
            }
            isa.store(momentum, &mut block.rhs[first + row]);
        }
    }
}
