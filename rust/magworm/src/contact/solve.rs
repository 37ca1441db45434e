//! The velocities at the end of a step, with contact: an active-set iteration on one banded system.
//!
//! Each pass assumes a mode for every contact, solves, and holds what it found against the laws (`law`): a
//! closed point that would pull opens, an open one that would sink closes, a sticking one beyond
//! μ λ_n + D_f Δt slides, a sliding one that would be held sticks. The normal impulse that friction reckons
//! with is extrapolated from the passes before (`settle`); both are iterated until nothing changes. Lanes
//! that are done are frozen, so the passes a neighbour still needs do not touch their bits.

use super::cone::{linearise, outdated, veer};
use super::guess::along;
use super::law::{Ground, Point, jacobian, load2};
use super::settle::{forget, settle};
use super::{MOST_DIRECTIONS, Mode, SLOTS, store_unless};
use crate::elastic::add_rank;
use crate::lanes::{Isa, Mask, Real};
use crate::model::Model;
use crate::state::Block;

/// Relative change of a reckoned normal impulse below which it counts as settled.
const SETTLED: f64 = 1e-5;
/// Passes in which everything may change at once: modes, directions and the impulses that friction reckons with.
/// That may go round and round, so from here on what touches is settled first, with the friction of the pass
/// before; then friction takes half of what it found.
pub const PATIENCE: usize = 8;
/// Passes from which on friction reckons with the impulses that it has: what is left is a convex problem. Rigid
/// feet may have no solution of Coulomb's law (the paradox of Painlevé).
const FROZEN: usize = 14;

/// Solves for the velocities at the end of the step into `next`, in at most `passes` passes; updates impulses
/// and modes. Which lanes have not settled by then.
pub fn solve<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    passes: usize,
) -> I::M {
    isa.vectorize(
        #[inline(always)]
        || iterate::<W, D, I>(isa, model, ground, block, passes),
    )
}

#[inline(always)]
fn iterate<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    passes: usize,
) -> I::M {
    let mut done = isa.load(&block.running[0]).eq(isa.splat(0.0));
    let mut stale = !done;
    block.wild.fill([0.0; W]);
    forget(isa, block);
    for pass in 0..passes {
        let refactor = stale.any();
        solve_assumed::<W, D, I>(isa, model, ground, block, done, refactor.then_some(stale));
        let change = judge::<W, D, I>(isa, model, ground, block, done, pass);
        let wild = I::F::select(change.wild, isa.splat(1.0), isa.splat(0.0));
        store_unless(isa, done, wild, &mut block.wild[0]);
        done = done | !(change.modes | change.impulses);
        stale = (change.modes | change.directions) & !done;
        if done.all() {
            break;
        }
    }
    !done
}

/// Where frozen friction drives a point, what is closed sticks in this step. That is a projection, which only takes
/// energy.
pub fn hold<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    isa.vectorize(
        #[inline(always)]
        || {
            let wild = isa.load(&block.wild[0]).eq(isa.splat(1.0));
            if wild.any() {
                stick(isa, model, block, !wild);
                solve_assumed::<W, D, I>(isa, model, ground, block, !wild, Some(wild));
                judge::<W, D, I>(isa, model, ground, block, !wild, 0);
            }
        },
    );
}

/// What is closed sticks.
#[inline(always)]
fn stick<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>, done: I::M) {
    let (open, stuck) = (isa.splat(Mode::OPEN), isa.splat(Mode::STICK));
    for c in 0..model.contacts.len() {
        let mode = isa.load(&block.mode[c]);
        store_unless(isa, done, I::F::select(mode.eq(open), open, stuck), &mut block.mode[c]);
    }
}

/// Solves under the modes as they are assumed; `stale`: lanes whose matrix has changed, if any has.
fn solve_assumed<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    done: I::M,
    stale: Option<I::M>,
) {
    if let Some(stale) = stale {
        isa.vectorize(
            #[inline(always)]
            || {
                if D == 3 {
                    linearise(isa, model, ground, block, stale);
                }
                assemble_matrix::<W, D, I>(isa, model, ground, block);
            },
        );
        model.band.factor(isa, &mut block.factor);
        block.counters.factorisations += 1;
    }
    isa.vectorize(
        #[inline(always)]
        || assemble_right::<W, D, I>(isa, model, ground, block),
    );
    model.band.solve(isa, &block.factor, &mut block.solution);
    block.counters.solves += 1;
    isa.vectorize(
        #[inline(always)]
        || accept(isa, block, done),
    );
}

/// Which lanes a pass has changed.
struct Change<M> {
    modes: M,
    impulses: M,
    /// A sliding point has another velocity than friction was linearised about.
    directions: M,
    /// Frozen friction drives a point.
    wild: M,
}

#[inline(always)]
fn assemble_matrix<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    block.factor.copy_from_slice(&block.matrix);
    let zero = isa.splat(0.0);
    let (mut rows, mut across) = ([[zero; SLOTS]; MOST_DIRECTIONS], [zero; SLOTS]);
    for (c, contact) in model.contacts.iter().enumerate() {
        let mode = isa.load(&block.mode[c]);
        let open = mode.eq(isa.splat(Mode::OPEN));
        if open.all() {
            continue;
        }
        let closed = I::F::select(open, zero, ground.weight);
        let stuck = I::F::select(mode.eq(isa.splat(Mode::STICK)), ground.weight, zero);
        jacobian::<W, D, I>(isa, block, c, &mut rows);
        let (matrix, stencil) = (&mut *block.factor, &contact.stencil);
        if D == 2 {
            add_rank(isa, matrix, stencil, [&rows[0], &rows[1]], [closed, stuck]);
        } else {
            let [x, z] = load2::<W, 3, I>(isa, &block.across, 4 * c);
            for slot in 0..SLOTS {
                across[slot] = rows[1][slot] * x + rows[2][slot] * z;
            }
            let viscosity = isa.load(&block.across[4 * c + 2]);
            let slides = I::F::select(mode.eq(isa.splat(Mode::SLIDE)), viscosity, zero);
            let gradients = [&rows[0][..], &rows[1][..], &rows[2][..], &across[..]];
            add_rank(isa, matrix, stencil, gradients, [closed, stuck, stuck, slides]);
        }
    }
}

#[inline(always)]
fn assemble_right<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    block.solution.copy_from_slice(&block.right);
    let zero = isa.splat(0.0);
    let mut rows = [[zero; SLOTS]; MOST_DIRECTIONS];
    for (c, contact) in model.contacts.iter().enumerate() {
        let mode = isa.load(&block.mode[c]);
        let open = mode.eq(isa.splat(Mode::OPEN));
        if open.all() {
            continue;
        }
        let stuck = mode.eq(isa.splat(Mode::STICK));
        let held = isa.load(&block.warm[D * c]) - ground.weight * isa.load(&block.approach[c]);
        let coefficient = isa.load(&block.coefficient[c]);
        let friction = ground.friction(coefficient, isa.load(&block.reckoned[c]));
        let mut impulses = [I::F::select(open, zero, held); MOST_DIRECTIONS];
        for t in 0..D - 1 {
            let mut sliding = -(friction * isa.load(&block.slip[(D - 1) * c + t]));
            if D == 3 {
                let across =
                    isa.load(&block.across[4 * c + 2]) * isa.load(&block.across[4 * c + 3]);
                sliding = sliding + across * isa.load(&block.across[4 * c + t]);
            }
            let warm = isa.load(&block.warm[D * c + 1 + t]);
            impulses[1 + t] = I::F::select(open, zero, I::F::select(stuck, warm, sliding));
        }
        jacobian::<W, D, I>(isa, block, c, &mut rows);
        for slot in 0..contact.stencil.count {
            let entry = &mut block.solution[contact.stencil.dofs[slot]];
            let mut sum = isa.load(entry);
            for direction in 0..D {
                sum = sum + rows[direction][slot] * impulses[direction];
            }
            isa.store(sum, entry);
        }
    }
}

/// Takes the solution over in lanes that are not done.
#[inline(always)]
fn accept<const W: usize, I: Isa<W>>(isa: I, block: &mut Block<W>, done: I::M) {
    for row in 0..block.solution.len() {
        store_unless(isa, done, isa.load(&block.solution[row]), &mut block.next[row]);
    }
}

/// Holds the solution against the laws: new modes, impulses and directions.
fn judge<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    done: I::M,
    pass: usize,
) -> Change<I::M> {
    isa.vectorize(
        #[inline(always)]
        || judge_all::<W, D, I>(isa, model, ground, block, done, pass),
    )
}

#[inline(always)]
fn judge_all<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    done: I::M,
    pass: usize,
) -> Change<I::M> {
    let zero = isa.splat(0.0);
    let never = zero.lt(zero);
    let mut change = Change { modes: never, impulses: never, directions: never, wild: never };
    let frozen = pass >= FROZEN;
    let parting =
        if pass < PATIENCE { never } else { parting::<W, D, I>(isa, model, ground, block, frozen) };
    for c in 0..model.contacts.len() {
        let point = Point::found::<W, D, I>(isa, model, ground, block, c, frozen);
        let after = point.after::<W, D, I>(isa, ground);
        let moved = !after.mode.eq(point.mode);
        let closed = !after.mode.eq(isa.splat(Mode::OPEN));
        let sliding = closed & !after.mode.eq(isa.splat(Mode::STICK));
        let drift = (after.normal - point.reckoned).abs();
        let tolerance = after.normal * SETTLED + ground.negligible;
        if frozen {
            let slid = point.mode.eq(isa.splat(Mode::SLIDE));
            let driven = along::<I::F, D>(point.u_t, point.slip).lt(-ground.transition_speed);
            change.wild = change.wild | (slid & driven);
        }
        let mut unsettled = if frozen { never } else { sliding & drift.gt(tolerance) };
        if D == 3 {
            let kept = done | parting;
            let off = outdated(isa, ground, block, c, &point, &after);
            let strays = sliding & veer(isa, ground, block, c, &point, &after, kept).gt(tolerance);
            change.directions = change.directions | (strays & off & !done);
            unsettled = unsettled | strays;
        }
        change.modes = change.modes | (moved & !done);
        change.impulses = change.impulses | (unsettled & !done);
        let parted = point.mode.eq(isa.splat(Mode::OPEN)) | !closed;
        let waits = parting & !parted;
        store_unless(isa, done | waits, after.mode, &mut block.mode[c]);
        store_unless(isa, done, after.normal, &mut block.normal[c]);
        if frozen {
            // One that opens now has no friction if it closes again, or it might take turns.
            let opens = !done & after.mode.eq(isa.splat(Mode::OPEN));
            let row = &mut block.reckoned[c];
            isa.store(I::F::select(opens, zero, isa.load(row)), row);
        }
        for t in 0..D - 1 {
            let row = (D - 1) * c + t;
            store_unless(isa, done, after.tangential[t], &mut block.tangential[row]);
            store_unless(isa, done | waits, after.slip[t], &mut block.slip[row]);
        }
    }
    if !frozen {
        let pace = if pass < PATIENCE { 1.0 } else { 0.5 };
        settle(isa, model, block, done | parting, change.modes, pace);
    }
    change
}

/// The lanes in which some point opens or closes.
#[inline(always)]
fn parting<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &Block<W>,
    frozen: bool,
) -> I::M {
    let open = isa.splat(Mode::OPEN);
    let mut parting = open.lt(open);
    for c in 0..model.contacts.len() {
        let point = Point::found::<W, D, I>(isa, model, ground, block, c, frozen);
        let after = point.after::<W, D, I>(isa, ground);
        let (was, is) = (point.mode.eq(open), after.mode.eq(open));
        parting = parting | (was & !is) | (!was & is);
    }
    parting
}
