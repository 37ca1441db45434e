//! The velocities at the end of a step, with contact: an active-set iteration on one banded system.
//!
//! Each pass assumes a mode for every contact, solves, and checks the assumption: a closed point
//! that would pull opens, an open one that would sink closes, a sticking one beyond μ λ_n + D_f Δt
//! slides, a sliding one whose velocity reverses sticks. The normal impulse that friction reckons with
//! is extrapolated from the passes before; both are iterated until nothing changes. Lanes that are done are
//! frozen, so the passes a neighbour still needs do not touch their bits.

use super::{Mode, SLOTS};
use crate::elastic::{add_rank_one, add_scaled, rate};
use crate::lanes::{Isa, Mask, Real};
use crate::model::{GroundLaw, Model};
use crate::state::Block;

/// Relative change of a reckoned normal impulse below which it counts as settled.
const SETTLED: f64 = 1e-5;
/// The same, beyond which friction is no longer that of the point: half of it.
const FAR: f64 = 0.5;
/// Passes in which points may change their mode in every way. Points that share a foot may then take turns
/// without end, so from here on a pass changes either what touches or how what touches slides, in turn. That
/// treats all points alike: a mirrored robot moves as the mirror image.
const PATIENCE: usize = 10;

/// Friction and penalty of each lane in one step.
#[derive(Clone, Copy, Debug)]
pub struct Ground<F> {
    /// μ_s.
    pub static_friction: F,
    /// μ_d.
    pub dynamic_friction: F,
    /// D_f Δt [N·s].
    pub adhesion: F,
    /// v_d [m/s].
    pub transition_speed: F,
    /// w [kg].
    pub weight: F,
    /// Impulse below which changes do not matter [N·s].
    pub negligible: F,
}

impl<F: Real> Ground<F> {
    /// The law in the lanes of a block.
    #[inline(always)]
    pub fn new(law: &GroundLaw, static_factor: F, dynamic_factor: F, dt: f64) -> Self {
        let one = static_factor.splat(1.0);
        let static_friction = static_factor * law.static_friction;
        Self {
            static_friction,
            // Varied on its own it could exceed the static one, which has no meaning.
            dynamic_friction: (dynamic_factor * law.dynamic_friction).min(static_friction),
            adhesion: one * (law.adhesion_n * dt),
            transition_speed: one * law.transition_speed_m_s,
            weight: one * law.weight_kg,
            // A ten-millionth of a node's weight over the step.
            negligible: one * (law.node_mass_kg * 1e-7 * 9.81 * dt),
        }
    }
}

/// Solves for the velocities at the end of the step into `next`; updates impulses and modes.
#[inline(always)]
pub fn solve<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    let mut done = isa.load(&block.running[0]).eq(isa.splat(0.0));
    let (mut refactor, mut wild) = (true, done);
    for pass in 0..model.scene.solver.contact_iterations {
        solve_assumed(isa, model, ground, block, done, refactor);
        let change = update_modes(isa, model, ground, block, done, pass);
        done = done | !(change.modes | change.impulses);
        refactor = (change.modes & !done).any();
        wild = change.wild & !done;
        if done.all() {
            return;
        }
    }
    if wild.any() {
        stick(isa, model, block, !wild);
        solve_assumed(isa, model, ground, block, !wild, true);
        update_modes(isa, model, ground, block, !wild, 0);
    }
}

/// Solves under the modes as they are assumed.
#[inline(always)]
fn solve_assumed<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    done: I::M,
    refactor: bool,
) {
    if refactor {
        assemble_matrix(isa, model, ground, block);
        model.band.factor(isa, &mut block.factor);
        block.counters.factorisations += 1;
    }
    assemble_right(isa, model, ground, block);
    model.band.solve(isa, &block.factor, &mut block.solution);
    block.counters.solves += 1;
    accept(isa, block, done);
}

/// Where the passes have run out and friction reckons with an impulse that grows from pass to pass: what is
/// closed sticks in this step. That is a projection, which only takes energy.
#[inline(always)]
fn stick<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>, done: I::M) {
    let (open, stuck) = (isa.splat(Mode::OPEN), isa.splat(Mode::STICK));
    for c in 0..model.contacts.len() {
        let mode = isa.load(&block.mode[c]);
        store_unless(isa, done, I::F::select(mode.eq(open), open, stuck), &mut block.mode[c]);
    }
}

/// Which lanes a pass has changed.
struct Change<M> {
    modes: M,
    impulses: M,
    /// Friction of a sliding point is far from its normal impulse, or drives it.
    wild: M,
}

#[inline(always)]
fn assemble_matrix<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    block.factor.copy_from_slice(&block.matrix);
    let zero = isa.splat(0.0);
    let mut row = [zero; SLOTS];
    for (c, contact) in model.contacts.iter().enumerate() {
        let mode = isa.load(&block.mode[c]);
        let closed = I::F::select(mode.eq(isa.splat(Mode::OPEN)), zero, ground.weight);
        let stuck = I::F::select(mode.eq(isa.splat(Mode::STICK)), ground.weight, zero);
        let weights = [closed, stuck];
        for direction in 0..2 {
            jacobian(isa, block, c, direction, &mut row);
            let weight = weights[direction];
            add_rank_one(isa, &mut block.factor, &contact.stencil, &row, weight);
        }
    }
}

#[inline(always)]
fn assemble_right<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    block.solution.copy_from_slice(&block.right);
    let zero = isa.splat(0.0);
    let mut row = [zero; SLOTS];
    for (c, contact) in model.contacts.iter().enumerate() {
        let mode = isa.load(&block.mode[c]);
        let open = mode.eq(isa.splat(Mode::OPEN));
        let stuck = mode.eq(isa.splat(Mode::STICK));
        let held = isa.load(&block.warm[2 * c]) - ground.weight * isa.load(&block.approach[c]);
        let coefficient = isa.load(&block.coefficient[c]);
        let friction = coefficient * isa.load(&block.reckoned[c]) + ground.adhesion;
        let sliding =
            I::F::select(stuck, isa.load(&block.warm[2 * c + 1]), -friction.copysign(mode));
        let impulses = [I::F::select(open, zero, held), I::F::select(open, zero, sliding)];
        for direction in 0..2 {
            jacobian(isa, block, c, direction, &mut row);
            let impulse = impulses[direction];
            add_scaled(isa, &mut block.solution, &contact.stencil, &row, impulse);
        }
    }
}

#[inline(always)]
fn jacobian<const W: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    contact: usize,
    direction: usize,
    row: &mut [I::F; SLOTS],
) {
    let first = SLOTS * (2 * contact + direction);
    let rows = &block.jacobian[first..first + SLOTS];
    for slot in 0..SLOTS {
        row[slot] = isa.load(&rows[slot]);
    }
}

/// Writes the lanes that are not done.
#[inline(always)]
fn store_unless<const W: usize, I: Isa<W>>(isa: I, done: I::M, new: I::F, row: &mut [f64; W]) {
    isa.store(I::F::select(done, isa.load(row), new), row);
}

/// Takes the solution over in lanes that are not done.
#[inline(always)]
fn accept<const W: usize, I: Isa<W>>(isa: I, block: &mut Block<W>, done: I::M) {
    for row in 0..block.solution.len() {
        store_unless(isa, done, isa.load(&block.solution[row]), &mut block.next[row]);
    }
}

#[inline(always)]
fn update_modes<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    done: I::M,
    pass: usize,
) -> Change<I::M> {
    let zero = isa.splat(0.0);
    let never = zero.lt(zero);
    let mut change = Change { modes: never, impulses: never, wild: never };
    let (mut normal_row, mut tangential_row) = ([zero; SLOTS], [zero; SLOTS]);
    for (c, contact) in model.contacts.iter().enumerate() {
        jacobian(isa, block, c, 0, &mut normal_row);
        jacobian(isa, block, c, 1, &mut tangential_row);
        let u_n =
            rate(isa, &block.next, &contact.stencil, &normal_row) + isa.load(&block.approach[c]);
        let u_t = rate(isa, &block.next, &contact.stencil, &tangential_row);
        let point = Point {
            mode: isa.load(&block.mode[c]),
            normal: isa.load(&block.warm[2 * c]) - ground.weight * u_n,
            held: isa.load(&block.warm[2 * c + 1]) - ground.weight * u_t,
            reckoned: isa.load(&block.reckoned[c]),
            coefficient: isa.load(&block.coefficient[c]),
            u_n,
            u_t,
        };
        let after = point.after(isa, ground);
        let moved = !after.mode.eq(point.mode);
        let closed = !after.mode.eq(isa.splat(Mode::OPEN));
        let sliding = closed & !after.mode.eq(isa.splat(Mode::STICK));
        let drift = (after.normal - point.reckoned).abs();
        let unsettled = sliding & drift.gt(after.normal * SETTLED + ground.negligible);
        change.modes = change.modes | (moved & !done);
        change.impulses = change.impulses | (unsettled & !done);
        let slid = point.mode.abs().eq(isa.splat(Mode::SLIDE_FORWARD));
        let far = drift.gt(point.reckoned * FAR + ground.negligible);
        let driven = (u_t * point.mode).lt(-ground.transition_speed);
        change.wild = change.wild | (slid & (far | driven));
        let parted = point.mode.eq(isa.splat(Mode::OPEN)) | !closed;
        let waits = if pass < PATIENCE {
            never
        } else if pass.is_multiple_of(2) {
            parted
        } else {
            !parted
        };
        store_unless(isa, done | waits, after.mode, &mut block.mode[c]);
        store_unless(isa, done, after.normal, &mut block.normal[c]);
        store_unless(isa, done, after.tangential, &mut block.tangential[c]);
        let next = extrapolate(isa, block, c, point.reckoned, after.normal);
        store_unless(isa, done, next, &mut block.reckoned[c]);
    }
    change
}

/// The normal impulse to reckon with in the next pass.
///
/// For fixed modes the impulse found is linear in the impulse reckoned with, so a secant through
/// two passes finds where both agree (Aitken's Δ²). Where the impulse found grows about as fast as the one
/// reckoned with, or faster, there is no such place nearby and the impulse found is taken.
#[inline(always)]
fn extrapolate<const W: usize, I: Isa<W>>(
    isa: I,
    block: &mut Block<W>,
    c: usize,
    reckoned: I::F,
    found: I::F,
) -> I::F {
    let earlier_reckoned = isa.load(&block.earlier[2 * c]);
    let earlier_found = isa.load(&block.earlier[2 * c + 1]);
    isa.store(reckoned, &mut block.earlier[2 * c]);
    isa.store(found, &mut block.earlier[2 * c + 1]);
    let run = reckoned - earlier_reckoned;
    let rise = found - earlier_found;
    let gentle = (rise * run).lt(run * run * 0.8);
    let agreed =
        found + (found - reckoned) * rise / I::F::select(gentle, run - rise, isa.splat(1.0));
    I::F::select(gentle & agreed.gt(isa.splat(0.0)), agreed, found)
}

/// A contact point after a pass, under the mode it was assumed in.
struct Point<F> {
    mode: F,
    /// λ_n if it was closed.
    normal: F,
    /// λ_t if it was sticking.
    held: F,
    /// λ_n that friction reckoned with.
    reckoned: F,
    /// μ of this step.
    coefficient: F,
    u_n: F,
    u_t: F,
}

/// Mode and impulses that the laws ask for.
struct After<F> {
    mode: F,
    normal: F,
    tangential: F,
}

impl<F: Real> Point<F> {
    #[inline(always)]
    fn after<const W: usize, I: Isa<W, F = F, M = F::Mask>>(
        &self,
        isa: I,
        ground: &Ground<F>,
    ) -> After<F> {
        let zero = isa.splat(0.0);
        let (open, stick) = (isa.splat(Mode::OPEN), isa.splat(Mode::STICK));
        let forward = isa.splat(Mode::SLIDE_FORWARD);
        let is_open = self.mode.eq(open);
        let is_stuck = self.mode.eq(stick);

        // Open points: close where they would sink, sticking if slow.
        let sinks = self.u_n.lt(isa.splat(-1e-12));
        let slow = self.u_t.abs().le(ground.transition_speed);
        let landing = F::select(slow, stick, forward.copysign(self.u_t));
        let from_open = F::select(sinks, landing, open);

        // Closed points: open where they would pull, else hold or slide. Friction opposes sliding.
        let normal = self.normal.max(zero);
        let limit = self.coefficient * normal + ground.adhesion;
        let slips = self.held.abs().gt(limit);
        let from_stick = F::select(slips, forward.copysign(-self.held), stick);
        let reverses = (self.u_t * self.mode).lt(zero);
        let from_slide = F::select(reverses, stick, self.mode);
        let pulls = self.normal.lt(zero);
        let from_closed = F::select(pulls, open, F::select(is_stuck, from_stick, from_slide));

        let mode = F::select(is_open, from_open, from_closed);
        let normal = F::select(is_open, zero, normal);
        let friction = self.coefficient * normal + ground.adhesion;
        let sliding = -friction.copysign(mode);
        // Within the cone even where the passes run out: the next step starts from it.
        let held = self.held.clamp(-limit, limit);
        let tangential = F::select(mode.eq(stick), held, sliding);
        let tangential = F::select(mode.eq(open) | is_open, zero, tangential);
        After { mode, normal, tangential }
    }
}
