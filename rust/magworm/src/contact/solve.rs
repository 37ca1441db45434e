//! The velocities at the end of a step, with contact: the solution of S v − s = Jᵀ λ(J v).
//!
//! λ is piecewise smooth, so Newton's iteration takes the derivative of the piece where it stands (semismooth Newton;
//! Alart & Curnier 1991), with a line search. The first iterate solves the system of the modes that the step starts
//! from; in most steps it is the solution. Where an iteration goes round, another one starts elsewhere. Rigid feet may
//! have several solutions or none (the paradox of Painlevé), so what follows most closely from the step before comes
//! first.

use super::bounded::{bound_by_last, relax};
use super::flight::{fly, touching};
use super::guess::{first_guess, restart};
use super::law::Ground;
use super::newton::{attempt, start, turn};
use super::onset::weaken;
use super::search::Search;
use super::system::solve_linearised;
use crate::lanes::{Isa, Mask, Real};
use crate::model::Model;
use crate::state::Block;

/// Solves for the velocities of the kept unknowns at the end of the step into `next`; updates impulses and modes.
pub fn solve<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(law) = &model.program.ground else { return };
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let touching = isa.vectorize(
        #[inline(always)]
        || touching(isa, block, running),
    );
    if touching || !fly::<D, I>(isa, model, block, running) {
        let ground = isa.vectorize(
            #[inline(always)]
            || Ground::of(isa, law, model.step_s, block),
        );
        press::<D, I>(isa, model, &ground, block, running);
    }
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        block.next[unknown] = block.contact.known[row];
    }
}

/// The step of a block in which some point may touch.
fn press<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    running: I::M,
) {
    isa.vectorize(
        #[inline(always)]
        || {
            for (c, contact) in model.contacts.iter().enumerate() {
                first_guess::<D, I>(isa, ground, block, c, contact);
            }
            start::<D, I>(isa, model, block);
        },
    );
    let left = settle::<D, I>(isa, model, ground, block, running, &PHASES);
    let weaker = isa.vectorize(
        #[inline(always)]
        || weaken::<D, I>(isa, model, ground, block, running & !left),
    );
    if weaker.any() {
        settle::<D, I>(isa, model, ground, block, weaker, &AGAIN);
    }
}

/// Goes through phases in the lanes of a mask; those for which none found a solution.
fn settle<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
    phases: &[Phase],
) -> I::M {
    let trials = model.scene.solver.contact_iterations.div_ceil(PHASES.len() + AGAIN.len());
    let mut left = mask;
    for &phase in phases {
        begin::<D, I>(isa, model, ground, block, left, phase);
        let still = iterate::<D, I>(isa, model, ground, block, left, phase.friction, trials);
        if phase.friction != Friction::Lagged {
            left = still;
        }
        if !left.any() {
            break;
        }
    }
    left
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

/// The iterations that follow where static friction gave way within the step.
const AGAIN: [Phase; 2] = [
    Phase { from: From::Here, friction: Friction::Coulomb },
    Phase { from: From::Here, friction: Friction::Settled },
];

/// Starts an iteration in the lanes of a mask; its first trial is taken whatever it is.
fn begin<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
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
                    restart::<D, I>(isa, ground, work, c, phase.from == From::Stick, mask);
                }
                if phase.friction != Friction::Coulomb {
                    bound_by_last::<D, I>(isa, ground, work, c);
                }
            }
            let mut search = Search::load(isa, &work.search);
            search.retake(mask, isa.splat(if here { 0.0 } else { 1.0 }));
            search.store(isa, &mut work.search);
        },
    );
    if !here {
        solve_linearised::<D, I>(isa, model, block);
        isa.vectorize(
            #[inline(always)]
            || turn::<D, I>(isa, model, block, mask),
        );
    }
}

/// Newton's iteration in the lanes of a mask; those that have not found a solution in so many trials.
fn iterate<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
    friction: Friction,
    trials: usize,
) -> I::M {
    let mut left = mask;
    for trial in 1..=trials {
        let taken = isa.vectorize(
            #[inline(always)]
            || attempt::<D, I>(isa, model, ground, block, left, friction != Friction::Coulomb),
        );
        block.counters.trials += 1;
        let mut solved = taken & Search::load(isa, &block.contact.search).solved();
        let mut turning = taken & !solved;
        if friction == Friction::Settled && solved.any() {
            solved = isa.vectorize(
                #[inline(always)]
                || relax::<D, I>(isa, model, ground, block, solved),
            );
        }
        left = left & !solved;
        turning = turning & left;
        if !left.any() || trial == trials {
            break;
        }
        if turning.any() {
            solve_linearised::<D, I>(isa, model, block);
            isa.vectorize(
                #[inline(always)]
                || {
                    turn::<D, I>(isa, model, block, turning);
                    let mut search = Search::load(isa, &block.contact.search);
                    search.begin(turning);
                    search.store(isa, &mut block.contact.search);
                },
            );
        }
    }
    left
}
