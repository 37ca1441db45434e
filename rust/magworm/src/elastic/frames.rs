//! Material frames in space: the axes of magnets and elements, and how they turn in time.
//!
//! A frame is an up direction u and a tangent t; side = t × u. That of a magnet turns with its angular
//! velocity. That of a soft element follows its tangent by parallel transport in time, which does not twist
//! it (Bergou 2010), and turns about it by its twist rate. So no reference frame and no angle against it are
//! kept. Rotations over a step are Cayley's, v + (w × v + ½ w × (w × v))/(1 + ¼ w²) with w = ω Δt: exactly
//! orthogonal, and the angle is that of the exponential but for w³/12. Frames are made orthonormal again at each
//! step, so that they do not drift.

use super::vector::{add_scaled, cross, dot, scaled};
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Brings the frames of the elements up to date with their tangents, and their sides with both.
#[inline(always)]
pub fn transport<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let (director, tangent, side) = (&mut *block.director, &mut *block.tangent, &mut *block.side);
    for (element, rigid) in model.coordinates.rigid.iter().enumerate() {
        let before = load3(isa, director, 6 * element + 3);
        let mut up = load3(isa, director, 6 * element);
        let mut t = load3(isa, tangent, 3 * element);
        if rigid.is_some() {
            t = before;
            store3(isa, &t, tangent, 3 * element);
        } else {
            up = carried(&up, &before, &t);
            keep3(isa, running, &up, director, 6 * element);
            keep3(isa, running, &t, director, 6 * element + 3);
        }
        store3(isa, &cross(&t, &up), side, 3 * element);
    }
}

/// u carried from t₀ to t by parallel transport, u − (u·t)/(1 + t₀·t) (t₀ + t), and made orthonormal to t.
#[inline(always)]
fn carried<F: Real>(up: &[F; 3], before: &[F; 3], t: &[F; 3]) -> [F; 3] {
    let one = up[0].splat(1.0);
    let share = dot(up, t) / (dot(before, t) + 1.0);
    upright(&add_scaled(up, -share, &add_scaled(before, one, t)), t)
}

/// u made orthogonal to t and of unit length, given that it nearly is.
#[inline(always)]
fn upright<F: Real>(up: &[F; 3], t: &[F; 3]) -> [F; 3] {
    unit(&add_scaled(up, -dot(up, t), t))
}

/// A vector of nearly unit length, made so to second order (a step of Newton's).
#[inline(always)]
fn unit<F: Real>(a: &[F; 3]) -> [F; 3] {
    scaled(a, dot(a, a) * -0.5 + 1.5)
}

/// Turns the frames over a step in the lanes of `go`: those of soft elements by their twist rate, those of
/// magnets by their angular velocity.
///
/// The angular velocity that a magnet has after it is that of its angular momentum I ω in the turned frame:
/// this is the gyroscopic torque ω × I ω, without error in the momentum.
#[inline(always)]
pub fn turn<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, go: I::M) {
    for (element, twist) in model.coordinates.twists.iter().enumerate() {
        let Some(dof) = *twist else { continue };
        let angle = isa.load(&block.next[dof]) * (0.5 * model.step_s);
        let up = load3(isa, &block.director, 6 * element);
        let side = load3(isa, &block.side, 3 * element);
        // Cayley's rotation about the tangent: tan of half the angle is ½ ω Δt.
        let over = isa.splat(2.0) / (angle * angle + 1.0);
        let turned = add_scaled(&scaled(&up, over - 1.0), angle * over, &side);
        keep3(isa, go, &turned, &mut block.director, 6 * element);
    }
    let one = isa.splat(1.0);
    for (body, &dof) in model.coordinates.bodies.iter().enumerate() {
        let element = model.mesh.magnets[body].element;
        let rate = load3(isa, &block.next, dof + 3);
        let momentum = world_inertia(isa, block, body, dof, &rate);
        let half = scaled(&rate, isa.splat(0.5 * model.step_s));
        let t = unit(&rotated(&load3(isa, &block.director, 6 * element + 3), &half));
        let up = upright(&rotated(&load3(isa, &block.director, 6 * element), &half), &t);
        let axes = [t, up, cross(&t, &up)];
        let mut after = [isa.splat(0.0); 3];
        for k in 0..3 {
            let moment = isa.load(&block.mass[dof + 3 + k]);
            // A robot without mass keeps its rate.
            let heavy = moment.gt(isa.splat(0.0));
            let of_momentum = dot(&axes[k], &momentum) / I::F::select(heavy, moment, one);
            let share = I::F::select(heavy, of_momentum, dot(&axes[k], &rate));
            after = add_scaled(&after, share, &axes[k]);
        }
        keep3(isa, go, &up, &mut block.director, 6 * element);
        keep3(isa, go, &t, &mut block.director, 6 * element + 3);
        keep3(isa, go, &after, &mut block.v, dof + 3);
    }
}

/// Cayley's rotation of `a` by twice the vector `half`.
#[inline(always)]
fn rotated<F: Real>(a: &[F; 3], half: &[F; 3]) -> [F; 3] {
    let once = cross(half, a);
    let twice = add_scaled(&once, a[0].splat(1.0), &cross(half, &once));
    add_scaled(a, a[0].splat(2.0) / (dot(half, half) + 1.0), &twice)
}

/// I ω of a magnet, with its moments of inertia about tangent, up and side in the rows of `mass`.
#[inline(always)]
fn world_inertia<I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: usize,
    dof: usize,
    rate: &[I::F; 3],
) -> [I::F; 3] {
    let mut momentum = [isa.splat(0.0); 3];
    for k in 0..3 {
        let axis = load3(isa, &block.frame, 9 * body + 3 * k);
        let share = dot(&axis, rate) * isa.load(&block.mass[dof + 3 + k]);
        momentum = add_scaled(&momentum, share, &axis);
    }
    momentum
}

/// Tangent, up and side of a magnet.
#[inline(always)]
pub fn axes<I: Isa>(isa: I, block: &Block<I::Row>, body: usize) -> [[I::F; 3]; 3] {
    [
        load3(isa, &block.frame, 9 * body),
        load3(isa, &block.frame, 9 * body + 3),
        load3(isa, &block.frame, 9 * body + 6),
    ]
}

#[inline(always)]
pub(super) fn load3<I: Isa>(isa: I, rows: &[I::Row], first: usize) -> [I::F; 3] {
    let rows = &rows[first..first + 3];
    [isa.load(&rows[0]), isa.load(&rows[1]), isa.load(&rows[2])]
}

#[inline(always)]
pub(super) fn store3<I: Isa>(isa: I, value: &[I::F; 3], rows: &mut [I::Row], first: usize) {
    let rows = &mut rows[first..first + 3];
    for axis in 0..3 {
        isa.store(value[axis], &mut rows[axis]);
    }
}

/// Writes the lanes of `mask`.
#[inline(always)]
fn keep3<I: Isa>(isa: I, mask: I::M, value: &[I::F; 3], rows: &mut [I::Row], first: usize) {
    let rows = &mut rows[first..first + 3];
    for axis in 0..3 {
        isa.store(I::F::select(mask, value[axis], isa.load(&rows[axis])), &mut rows[axis]);
    }
}
