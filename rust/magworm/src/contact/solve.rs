//! The velocities at the end of a step, with contact: Newton's iteration on S v − s = Jᵀ λ(J v).
//!
//! λ is piecewise smooth, so its derivative is that of the piece where it stands (semismooth Newton; Alart &
//! Curnier 1991). The first iterate solves the system of the modes that the step starts from; in most steps it is
//! the solution. Rigid feet may have no solution of Coulomb's law (the paradox of Painlevé), and the iteration may go
//! round: after half of the passes friction is *frozen* at the normal impulses found so far. What is left
//! minimises a convex energy, and the search finds it.

use super::guess::{along, restart};
use super::law::{Ground, Point, Response};
use super::points::point_velocity;
use super::search::Search;
use super::system::{add_force, arm, solve_linearised};
use super::{Mode, Workspace, load_vector, store_vector, store_where};
use crate::lanes::{Isa, Mask, Real};
use crate::model::Model;
use crate::state::Block;

/// Residual of a solution relative to s.
const TOLERANCE: f64 = 1e-9;
const AGREED: f64 = 1e-3;

/// Solves for the velocities of the kept unknowns at the end of the step into `next`; updates impulses and modes.
pub fn solve<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    isa.vectorize(
        #[inline(always)]
        || start::<W, D, I>(isa, model, block),
    );
    let trials = model.scene.solver.contact_iterations.div_ceil(PHASES.len());
    let mut left = running;
    for phase in PHASES {
        begin::<W, D, I>(isa, model, ground, block, left, phase);
        let still = iterate::<W, D, I>(isa, model, ground, block, left, phase.friction, trials);
        if phase.friction != Friction::Lagged {
            left = still;
        }
        if !left.any() {
            break;
        }
    }
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        block.next[unknown] = block.contact.known[row];
    }
}

/// Where an iteration starts.
#[derive(Clone, Copy, PartialEq)]
enum From {
    /// Every point in the mode that it is most likely to be in.
    Guess,
    /// Where the last iteration ended.
    Here,
    /// What touches sticks.
    Stick,
    /// What touches slides without friction.
    Slide,
}

/// What bounds friction.
#[derive(Clone, Copy, PartialEq)]
enum Friction {
    /// The normal impulse found.
    Coulomb,
    /// That of the step before.
    Lagged,
    /// The same, brought to agree with the one found as far as it will.
    Settled,
}

/// An iteration.
#[derive(Clone, Copy)]
struct Phase {
    from: From,
    friction: Friction,
}

/// The iterations of a step, until one has found a solution of Coulomb's law. The lagged one is not a solution but a
/// place to start from; the last one is what is left where there is none.
const PHASES: [Phase; 6] = [
    Phase { from: From::Guess, friction: Friction::Coulomb },
    Phase { from: From::Here, friction: Friction::Lagged },
    Phase { from: From::Here, friction: Friction::Coulomb },
    Phase { from: From::Stick, friction: Friction::Coulomb },
    Phase { from: From::Slide, friction: Friction::Coulomb },
    Phase { from: From::Here, friction: Friction::Settled },
];

/// Starts an iteration in the lanes of a mask; its first trial is taken whatever it is.
fn begin<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    mask: I::M,
    phase: Phase,
) {
    let here = phase.from == From::Here;
    isa.vectorize(
        #[inline(always)]
        || {
            let work = &mut block.contact;
            for c in 0..model.contacts.len() {
                if matches!(phase.from, From::Stick | From::Slide) {
                    restart(isa, ground, work, D, c, phase.from == From::Stick, mask);
                }
                if phase.friction != Friction::Coulomb {
                    bound_by_last::<W, D, I>(isa, ground, work, c);
                }
            }
            let mut search = Search::load(isa, &work.search);
            search.retake(mask, isa.splat(if here { 0.0 } else { 1.0 }));
            search.store(isa, &mut work.search);
        },
    );
    if !here {
        solve_linearised::<W, D, I>(isa, model, block);
        isa.vectorize(
            #[inline(always)]
            || turn::<W, D, I>(isa, model, block, mask),
        );
    }
}

/// Newton's iteration in the lanes of a mask; those that have not found a solution in so many trials.
fn iterate<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    mask: I::M,
    friction: Friction,
    trials: usize,
) -> I::M {
    let mut left = mask;
    for trial in 1..=trials {
        let taken = isa.vectorize(
            #[inline(always)]
            || attempt::<W, D, I>(isa, model, ground, block, left, friction),
        );
        block.counters.trials += 1;
        let mut solved = taken & Search::load(isa, &block.contact.search).solved();
        let mut turning = taken & !solved;
        if friction == Friction::Settled && solved.any() {
            solved = isa.vectorize(
                #[inline(always)]
                || relax::<W, D, I>(isa, model, ground, block, solved),
            );
        }
        left = left & !solved;
        turning = turning & left;
        if !left.any() || trial == trials {
            break;
        }
        if turning.any() {
            solve_linearised::<W, D, I>(isa, model, block);
            isa.vectorize(
                #[inline(always)]
                || {
                    turn::<W, D, I>(isa, model, block, turning);
                    let mut search = Search::load(isa, &block.contact.search);
                    search.begin(turning);
                    search.store(isa, &mut block.contact.search);
                },
            );
        }
    }
    left
}

/// Before the first pass: nothing moves, and nothing is known.
#[inline(always)]
fn start<const W: usize, const D: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let (zero, one) = (isa.splat(0.0), isa.splat(1.0));
    let kept = model.system.kept();
    let symmetric = model.system.kept_entries(&block.matrix);
    let work = &mut block.contact;
    let mut size = zero;
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        let right = isa.load(&block.right[unknown]);
        let diagonal = isa.load(&symmetric[kept.at(row, row)]);
        // Multipliers have no mass; each system of theirs is solved as it is.
        let heavy = diagonal.gt(zero);
        let mobility = I::F::select(heavy, one / I::F::select(heavy, diagonal, one), zero);
        isa.store(mobility, &mut work.mobility[row]);
        isa.store(-right, &mut work.imbalance[row]);
        isa.store(zero, &mut work.known[row]);
        size = size + right * right * mobility;
    }
    for c in 0..model.contacts.len() {
        let mut velocity = [zero; 3];
        velocity[0] = isa.load(&work.approach[c]);
        store_vector::<W, D, I>(isa, zero.eq(zero), &velocity, &mut work.velocity, c);
    }
    Search::new(size * (TOLERANCE * TOLERANCE)).store(isa, &mut work.search);
}

/// A new direction in the lanes of a mask, to the solution of the linearised system, and what changes along it.
#[inline(always)]
fn turn<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    mask: I::M,
) {
    let kept = model.system.kept();
    let ghosts = kept.half_bandwidth();
    let work = &mut block.contact;
    for row in 0..kept.size() {
        let change = isa.load(&work.target[ghosts + row]) - isa.load(&work.known[row]);
        store_where(isa, mask, change, &mut work.direction[row]);
    }
    kept.multiply(
        isa,
        model.system.kept_entries(&block.matrix),
        &work.direction,
        &mut work.imbalance_change,
    );
    for (c, contact) in model.contacts.iter().enumerate() {
        let arm = arm::<W, D, I>(isa, &work.arm, c);
        let change =
            point_velocity::<W, D, I>(isa, &work.direction, contact.place, contact.rigid, &arm);
        store_vector::<W, D, I>(isa, mask, &change, &mut work.velocity_change, c);
    }
}

/// One trial in the lanes that are left; which of them took it.
#[inline(always)]
fn attempt<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    left: I::M,
    friction: Friction,
) -> I::M {
    let frozen = friction != Friction::Coulomb;
    let mut search = Search::load(isa, &block.contact.search);
    let step = search.step;
    let found = residual::<W, D, I>(isa, model, ground, block, step, frozen);
    let taken = search.judge(found) & left;
    search.store(isa, &mut block.contact.search);
    if taken.any() {
        advance(isa, block, step, taken);
        for c in 0..model.contacts.len() {
            linearise::<W, D, I>(isa, ground, block, c, taken, frozen);
        }
    }
    taken
}

/// |S v − s − Jᵀ λ|² at a step along the direction.
#[inline(always)]
fn residual<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    step: I::F,
    frozen: bool,
) -> I::F {
    let work = &mut block.contact;
    for row in 0..work.residual.len() {
        let change = isa.load(&work.imbalance_change[row]) * step;
        isa.store(isa.load(&work.imbalance[row]) + change, &mut work.residual[row]);
    }
    for (c, contact) in model.contacts.iter().enumerate() {
        let mut u = load_vector::<W, D, I>(isa, &work.velocity, c);
        let change = load_vector::<W, D, I>(isa, &work.velocity_change, c);
        for k in 0..D {
            u[k] = u[k] + change[k] * step;
        }
        let point = point::<W, D, I>(isa, work, c);
        let [up, x, z] = point.impulse::<D>(ground, &u, frozen).impulse;
        let arm = arm::<W, D, I>(isa, &work.arm, c);
        let rows = &mut work.residual[contact.place..];
        add_force::<W, D, I>(isa, rows, contact.rigid, &arm, &[-x, -up, -z]);
    }
    let mut sum = isa.splat(0.0);
    for row in 0..work.residual.len() {
        let residual = isa.load(&work.residual[row]);
        sum = sum + residual * residual * isa.load(&work.mobility[row]);
    }
    sum
}

/// Goes a step along the direction in the lanes of a mask.
#[inline(always)]
fn advance<const W: usize, I: Isa<W>>(isa: I, block: &mut Block<W>, step: I::F, mask: I::M) {
    let work = &mut block.contact;
    let pairs = [
        (&mut work.known, &work.direction),
        (&mut work.imbalance, &work.imbalance_change),
        (&mut work.velocity, &work.velocity_change),
    ];
    for (rows, changes) in pairs {
        for k in 0..rows.len() {
            let next = isa.load(&rows[k]) + isa.load(&changes[k]) * step;
            store_where(isa, mask, next, &mut rows[k]);
        }
    }
}

/// Impulses, mode and response of a point at its velocity, in the lanes of a mask.
#[inline(always)]
fn linearise<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    c: usize,
    mask: I::M,
    frozen: bool,
) {
    let u = load_vector::<W, D, I>(isa, &block.contact.velocity, c);
    let approach = isa.load(&block.contact.approach[c]);
    let point = point::<W, D, I>(isa, &block.contact, c);
    let found = point.impulse::<D>(ground, &u, frozen);
    // What slid the other way passed the place where it sticks.
    let before = [0, 1].map(|k| isa.load(&block.contact.slip[2 * c + k]));
    let turned = along::<I::F, D>(found.pushed, before).lt(isa.splat(0.0));
    let slid = isa.load(&block.mode[c]).eq(isa.splat(Mode::SLIDE));
    let passed = slid & found.slides & turned;
    for k in 0..2 {
        store_where(isa, mask, found.pushed[k], &mut block.contact.slip[2 * c + k]);
    }
    store_where(isa, mask, found.mode(), &mut block.mode[c]);
    store_where(isa, mask, found.impulse[0], &mut block.normal[c]);
    for t in 0..D - 1 {
        // What the spring of the pad holds without its damper, where it does not slip.
        let spring = found.impulse[1 + t] + ground.viscous * u[1 + t];
        let held = I::F::select(found.slides, found.impulse[1 + t], spring);
        store_where(isa, mask, held, &mut block.tangential[(D - 1) * c + t]);
    }
    let response = Response::at::<D>(&point, ground, &found, &u, approach, frozen, passed);
    response.store(isa, mask, &mut block.contact.response, c);
}

/// Friction is bounded by what the normal impulse of the step before allows.
#[inline(always)]
fn bound_by_last<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    ground: &Ground<I::F>,
    work: &mut Workspace<W>,
    c: usize,
) {
    let coefficient = isa.load(&work.coefficient[c]);
    let bound = ground.friction(coefficient, isa.load(&work.warm[D * c]));
    isa.store(bound, &mut work.bound[c]);
}

/// Brings the bounds of friction halfway to those of the normal impulses found, in the lanes of a mask; the
/// lanes where they agree.
#[inline(always)]
fn relax<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    mask: I::M,
) -> I::M {
    let zero = isa.splat(0.0);
    let (mut off, mut all) = (zero, zero);
    for c in 0..model.contacts.len() {
        let coefficient = isa.load(&block.contact.coefficient[c]);
        let found = ground.friction(coefficient, isa.load(&block.normal[c]));
        let bound = isa.load(&block.contact.bound[c]);
        off = off.max((found - bound).abs());
        all = all + found;
    }
    let agreed = off.le(all * AGREED);
    let moves = mask & !agreed;
    for c in 0..model.contacts.len() {
        let coefficient = isa.load(&block.contact.coefficient[c]);
        let found = ground.friction(coefficient, isa.load(&block.normal[c]));
        let bound = isa.load(&block.contact.bound[c]);
        store_where(isa, moves, (found + bound) * 0.5, &mut block.contact.bound[c]);
    }
    let mut search = Search::load(isa, &block.contact.search);
    search.retake(moves, zero);
    search.store(isa, &mut block.contact.search);
    mask & agreed
}

#[inline(always)]
fn point<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    work: &Workspace<W>,
    c: usize,
) -> Point<I::F> {
    Point {
        warm: load_vector::<W, D, I>(isa, &work.warm, c),
        coefficient: isa.load(&work.coefficient[c]),
        bound: isa.load(&work.bound[c]),
    }
}
