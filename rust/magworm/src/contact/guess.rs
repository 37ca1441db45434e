//! The modes that a step starts with, and directions along the ground.

use super::{Ground, Mode};
use crate::lanes::{Isa, Real};
use crate::state::Block;

/// Speed below which a direction has no meaning [m/s].
const STILL_M_S: f64 = 1e-30;

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
    let still = length.lt(one * STILL_M_S);
    let over = one / F::select(still, one, length);
    [F::select(still, one, a[0] * over), F::select(still, zero, a[1] * over)]
}

/// a · b along the ground.
#[inline(always)]
pub(super) fn along<F: Real, const D: usize>(a: [F; 2], b: [F; 2]) -> F {
    if D == 2 { a[0] * b[0] } else { a[0] * b[0] + a[1] * b[1] }
}

/// A point that was closed, or is about to pass through the ground, starts closed. Its speed at the start
/// of the step decides: up to v_d it starts sticking and μ_s holds for the step, beyond it slides on
/// against μ_d. One coefficient per step keeps the law monotone, and its limit for small steps is the
/// paper's.
#[inline(always)]
pub(super) fn first_guess<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    c: usize,
    u_n: I::F,
    u_t: [I::F; 2],
) {
    let zero = isa.splat(0.0);
    let (open, stick, slide) =
        (isa.splat(Mode::OPEN), isa.splat(Mode::STICK), isa.splat(Mode::SLIDE));
    let before = isa.load(&block.mode[c]);
    isa.store(before, &mut block.mode_before[c]);
    let was_closed = !before.eq(open);
    let closed = was_closed | u_n.lt(zero);
    let speed = length::<I::F, D>(u_t);
    let slow = speed.le(ground.transition_speed);
    // One that slid goes on until its velocity reverses: a guess that it sticks would ask for its whole
    // momentum within one step, which no friction has.
    let moving = I::F::select(slow & !before.eq(slide), stick, slide);
    let guess = I::F::select(closed, moving, open);
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    isa.store(I::F::select(running, guess, before), &mut block.mode[c]);
    let coefficient = I::F::select(slow, ground.static_friction, ground.dynamic_friction);
    isa.store(coefficient, &mut block.coefficient[c]);
    let stuck = before.eq(stick);
    let normal = I::F::select(was_closed, isa.load(&block.normal[c]), zero);
    isa.store(normal, &mut block.warm[D * c]);
    let slip = direction::<I::F, D>(u_t);
    for t in 0..D - 1 {
        let row = (D - 1) * c + t;
        let tangential = I::F::select(stuck, isa.load(&block.tangential[row]), zero);
        isa.store(tangential, &mut block.warm[D * c + 1 + t]);
        isa.store(slip[t], &mut block.slip[row]);
    }
    if D == 3 {
        isa.store(speed, &mut block.speed[c]);
    }
    isa.store(normal, &mut block.reckoned[c]);
}
