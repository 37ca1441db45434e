//! What a step starts from, before anything is known of its end, and directions along the ground.

use super::law::{Ground, Point, Response};
use super::points::start_velocity;
use super::{Mode, Vector, Workspace, load_vector, store_vector};
use crate::lanes::{Isa, Real};
use crate::model::Contact;
use crate::state::Block;

/// Length below which a vector has no direction.
const STILL: f64 = 1e-30;

/// Length of a vector along the ground: its one component in the plane, two in space.
#[inline(always)]
pub(super) fn length<F: Real, const D: usize>(a: [F; 2]) -> F {
    if D == 2 { a[0].abs() } else { (a[0] * a[0] + a[1] * a[1]).sqrt() }
}

/// a/|a|; in the plane a sign. Of a vector without length it is +x.
#[inline(always)]
pub(super) fn direction<F: Real, const D: usize>(a: [F; 2]) -> [F; 2] {
    let (zero, one) = (a[0].splat(0.0), a[0].splat(1.0));
    if D == 2 {
        return [one.copysign(a[0]), zero];
    }
    let length = length::<F, D>(a);
    let still = length.lt(one * STILL);
    let over = one / F::select(still, one, length);
    [F::select(still, one, a[0] * over), F::select(still, zero, a[1] * over)]
}

/// a · b along the ground.
#[inline(always)]
pub(super) fn along<F: Real, const D: usize>(a: [F; 2], b: [F; 2]) -> F {
    if D == 2 { a[0] * b[0] } else { a[0] * b[0] + a[1] * b[1] }
}

/// Coefficient, λ⁰ and first response of a point.
///
/// A point that was closed, or is about to pass through the ground, is taken as closed. Its speed at the start of the
/// step decides: up to v_d μ_s holds for the step, beyond it μ_d. One coefficient per step keeps the law
/// monotone, and its limit for small steps is the paper's.
#[inline(always)]
pub(super) fn first_guess<const D: usize, I: Isa>(
    isa: I,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    c: usize,
    contact: &Contact,
) {
    let zero = isa.splat(0.0);
    let (open, slide) = (isa.splat(Mode::OPEN), isa.splat(Mode::SLIDE));
    let before = isa.load(&block.mode[c]);
    let was_closed = !before.eq(open);
    let closed = isa.load(&block.contact.touching[c]).gt(zero);
    let bias = load_vector::<D, I>(isa, &block.contact.bias, c);
    let u = start_velocity::<D, I>(isa, block, c, contact);
    let along = [u[1], u[2]];
    let speed = length::<I::F, D>(along);
    let slow = speed.le(ground.transition_speed);
    // One that slid goes on: a guess that it sticks would ask for its whole momentum within one step, which no
    // friction has.
    let sticks = slow & !before.eq(slide);
    let normal = I::F::select(was_closed, isa.load(&block.normal[c]), zero);
    let mut warm = [normal, zero, zero];
    for t in 0..D - 1 {
        warm[1 + t] = I::F::select(was_closed, isa.load(&block.pad[(D - 1) * c + t]), zero);
    }
    let coefficient = I::F::select(slow, ground.static_friction, ground.dynamic_friction);
    let point = Point { warm, coefficient, bound: zero };
    let response = assumed::<I::F, D>(&point, ground, along, speed, &bias, closed, sticks);
    let everywhere = zero.eq(zero);
    let work = &mut block.contact;
    isa.store(coefficient, &mut work.coefficient[c]);
    store_vector::<D, I>(isa, everywhere, &warm, &mut work.warm, c);
    response.store(isa, everywhere, &mut work.response, c);
    for k in 0..2 {
        isa.store(zero, &mut work.slip[2 * c + k]);
    }
}

/// Another start, where the first led nowhere: what touches at the start of the step sticks, or slides without friction.
#[inline(always)]
pub(super) fn restart<const D: usize, I: Isa>(
    isa: I,
    ground: &Ground<I::F>,
    work: &mut Workspace<I::Row>,
    c: usize,
    sticks: bool,
    mask: I::M,
) {
    let zero = isa.splat(0.0);
    let touching = isa.load(&work.touching[c]).gt(zero);
    let normal = I::F::select(touching, ground.weight, zero);
    let held = if sticks { normal } else { zero };
    let bias = load_vector::<D, I>(isa, &work.bias, c);
    let mut force = [-(normal * bias[0]), zero, zero];
    if sticks {
        for k in 1..D {
            let stuck = isa.load(&work.warm[D * c + k]) - normal * bias[k];
            force[k] = I::F::select(touching, stuck, zero);
        }
    }
    let response = Response { force, normal, drag: [zero; 2], along: [held, zero, held] };
    response.store(isa, mask, &mut work.response, c);
}

/// The response of a point in an assumed mode: open; sticking; or sliding on in the direction in which it moves, against
/// friction that follows the normal impulse, with F/|u| across (the derivative of a direction).
#[inline(always)]
#[allow(clippy::too_many_arguments)] // a kernel: a struct of arguments would be copied
fn assumed<F: Real, const D: usize>(
    point: &Point<F>,
    ground: &Ground<F>,
    along: [F; 2],
    speed: F,
    bias: &Vector<F>,
    closed: F::Mask,
    sticks: F::Mask,
) -> Response<F> {
    let (zero, w) = (speed.splat(0.0), ground.weight);
    let d = direction::<F, D>(along);
    let normal = F::select(closed, w, zero);
    let pressed = F::select(closed, -(w * bias[0]), zero);
    let drag = F::select(sticks, zero, point.coefficient * normal);
    let adhesion = ground.friction(zero, point.warm[0]);
    let sliding = F::select(closed, point.coefficient * pressed + adhesion, zero);
    let friction = ground.friction(point.coefficient, point.warm[0]);
    let slowest = friction / w;
    let viscosity = F::select(closed, friction / (speed + slowest).max(w.splat(STILL)), zero);
    let stuck = F::select(sticks, normal, viscosity);
    let lost = F::select(sticks, zero, viscosity);
    let mut force = [pressed, zero, zero];
    for t in 0..D - 1 {
        force[1 + t] = F::select(
            sticks,
            F::select(closed, point.warm[1 + t] - w * bias[1 + t], zero),
            -(sliding * d[t]),
        );
    }
    let xx = if D == 2 { stuck - lost } else { stuck - lost * d[0] * d[0] };
    Response {
        force,
        normal,
        drag: [-(drag * d[0]), -(drag * d[1])],
        along: [xx, -(lost * d[0] * d[1]), stuck - lost * d[1] * d[1]],
    }
}
