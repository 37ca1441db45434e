//! The velocities of the bodies at the end of a step, with contact.
//!
//! Newton's iteration ([`super::newton`]) is started in several ways, one after the other, until one converges: from the modes
//! of the step before, which in most steps are those of the solution; from the solution with lagged friction; with all points
//! sticking; with all sliding without friction. The equations may have several solutions, so what follows most closely from the
//! step before comes first. They may have none (Painlevé's paradox); the last strategy ends where friction agrees with
//! Coulomb's law as far as it will.

use super::contact_free::{any_active, try_contact_free_step};
use super::initial::{cold_start, warm_start};
use super::law::{ContactLaw, ContactLaws, FrictionLaw};
use super::line_search::LineSearch;
use super::newton::{begin, line_search_trial, newton_direction};
use super::newton_system::solve_linearised;
use super::rebound;
use super::stick_slip::stick_slip_transition;
use super::tresca::{lag_friction_bound, relax_friction_bounds};
use crate::lanes::{Dim, Isa, Mask, Real};
use crate::model::Model;
use crate::state::Block;

/// Where an iteration starts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Start {
    /// Every point in the mode that follows from the step before.
    Warm,
    /// Where the strategy before ended.
    Here,
    /// Active points stick.
    Sticking,
    /// Active points slide without friction.
    Frictionless,
}

/// What bounds friction.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Friction {
    /// The normal impulse: Coulomb's law.
    Coulomb,
    /// The normal impulse of the step before: Tresca's law. Its solution is a start for others.
    Lagged,
    /// A bound of its own, relaxed towards Coulomb's law: Tresca's law with a fixed point.
    FixedPoint,
}

impl Friction {
    fn law(self) -> FrictionLaw {
        match self {
            Self::Coulomb => FrictionLaw::Coulomb,
            Self::Lagged | Self::FixedPoint => FrictionLaw::Tresca,
        }
    }
}

/// A way to look for a solution.
#[derive(Clone, Copy)]
struct Strategy {
    start: Start,
    friction: Friction,
}

/// The strategies of a step in their order.
const STRATEGIES: [Strategy; 6] = [
    Strategy { start: Start::Warm, friction: Friction::Coulomb },
    Strategy { start: Start::Here, friction: Friction::Lagged },
    Strategy { start: Start::Here, friction: Friction::Coulomb },
    Strategy { start: Start::Sticking, friction: Friction::Coulomb },
    Strategy { start: Start::Frictionless, friction: Friction::Coulomb },
    Strategy { start: Start::Here, friction: Friction::FixedPoint },
];

/// The strategies from a solution of other friction or other rebound.
const FROM_HERE: [Strategy; 2] = [
    Strategy { start: Start::Here, friction: Friction::Coulomb },
    Strategy { start: Start::Here, friction: Friction::FixedPoint },
];

/// Solves for the velocities of the kept unknowns at the end of the step into `next`; updates impulses and modes.
pub fn solve<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(parameters) = &model.program.contact else { return };
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let active = isa.vectorize(
        #[inline(always)]
        || any_active(isa, block, running),
    );
    if active || !try_contact_free_step::<D, I>(isa, model, block, running) {
        let laws = isa.vectorize(
            #[inline(always)]
            || ContactLaws::new(ContactLaw::new(isa, parameters, model.step_s, block)),
        );
        solve_contact::<D, I>(isa, model, &laws, block, running);
    }
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        block.end_velocity[unknown] = block.contact.iterate[row];
    }
}

/// Solves a step in which some point may be active, and once more where static friction gave way in it.
fn solve_contact<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    running: I::M,
) {
    isa.vectorize(
        #[inline(always)]
        || {
            for (c, pair) in model.contacts.iter().enumerate() {
                warm_start::<D, I>(isa, laws.of(pair), block, c, pair);
            }
            begin::<D, I>(isa, model, block);
        },
    );
    let unconverged = run_strategies::<D, I>(isa, model, laws, block, running, &STRATEGIES);
    let passes = isa.vectorize(
        #[inline(always)]
        || stick_slip_transition::<D, I>(isa, model, laws, block, running & !unconverged),
    );
    if passes.any() {
        run_strategies::<D, I>(isa, model, laws, block, passes, &FROM_HERE);
    }
    if model.restitutes() {
        give_up_rebounds_that_gain::<D, I>(isa, model, laws, block, running);
    }
}

/// Solves a step again without rebound where rebound gave energy.
fn give_up_rebounds_that_gain<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    running: I::M,
) {
    let gains = isa.vectorize(
        #[inline(always)]
        || rebound::gains_energy::<D, I>(isa, model, laws, block, running),
    );
    if gains.any() {
        isa.vectorize(
            #[inline(always)]
            || rebound::give_up::<D, I>(isa, model, &mut block.contact, gains),
        );
        run_strategies::<D, I>(isa, model, laws, block, gains, &FROM_HERE);
    }
}

/// Runs strategies in the lanes of a mask until each has converged; the lanes in which none did.
fn run_strategies<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
    strategies: &[Strategy],
) -> I::M {
    let mut unconverged = mask;
    for &strategy in strategies {
        start::<D, I>(isa, model, laws, block, unconverged, strategy);
        let rest = iterate::<D, I>(isa, model, laws, block, unconverged, strategy.friction);
        if strategy.friction != Friction::Lagged {
            unconverged = rest;
        }
        if !unconverged.any() {
            break;
        }
    }
    unconverged
}

/// Starts a strategy in the lanes of a mask. Its first trial is accepted whatever its residual.
fn start<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
    strategy: Strategy,
) {
    let here = strategy.start == Start::Here;
    isa.vectorize(
        #[inline(always)]
        || {
            let work = &mut block.contact;
            for (c, pair) in model.contacts.iter().enumerate() {
                match strategy.start {
                    Start::Sticking => cold_start::<D, I>(isa, laws.of(pair), work, c, true, mask),
                    Start::Frictionless => {
                        cold_start::<D, I>(isa, laws.of(pair), work, c, false, mask)
                    }
                    Start::Warm | Start::Here => {}
                }
                if strategy.friction != Friction::Coulomb {
                    lag_friction_bound(isa, laws.of(pair), work, c, D::AXES);
                }
            }
            let mut search = LineSearch::load(isa, &work.line_search);
            search.accept_next(mask, isa.splat(if here { 0.0 } else { 1.0 }));
            search.store(isa, &mut work.line_search);
        },
    );
    if !here {
        solve_linearised::<D, I>(isa, model, block);
        isa.vectorize(
            #[inline(always)]
            || newton_direction::<D, I>(isa, model, block, mask),
        );
    }
}

/// Newton's iteration in the lanes of a mask; those that have not converged within their share of the trials of a step.
fn iterate<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
    friction: Friction,
) -> I::M {
    let again = if model.restitutes() { 2 } else { 1 };
    let strategies = STRATEGIES.len() + again * FROM_HERE.len();
    let trials = model.scene.solver.contact_iterations.div_ceil(strategies);
    let mut unconverged = mask;
    for trial in 1..=trials {
        let mut status = isa.vectorize(
            #[inline(always)]
            || line_search_trial::<D, I>(isa, model, laws, friction.law(), block, unconverged),
        );
        block.counters.trials += 1;
        if friction == Friction::FixedPoint && status.converged.any() {
            status.converged = isa.vectorize(
                #[inline(always)]
                || relax_friction_bounds(isa, model, laws, block, status.converged),
            );
        }
        unconverged = unconverged & !status.converged;
        if !unconverged.any() || trial == trials {
            break;
        }
        if status.accepted.any() {
            next_direction::<D, I>(isa, model, block, status.accepted);
        }
    }
    unconverged
}

/// Begins a new direction in the lanes of a mask.
fn next_direction<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, mask: I::M) {
    solve_linearised::<D, I>(isa, model, block);
    isa.vectorize(
        #[inline(always)]
        || {
            newton_direction::<D, I>(isa, model, block, mask);
            let mut search = LineSearch::load(isa, &block.contact.line_search);
            search.begin_direction(mask);
            search.store(isa, &mut block.contact.line_search);
        },
    );
}
