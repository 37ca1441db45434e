//! Work on all blocks of a batch. Where it is stopped, all of them are as before.

use super::cohort::{Cohort, Seats};
use super::control::control_block;
use super::{Ensemble, Pool, StepOutput};
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::Row;
use crate::reset::apply_parameters;
use crate::state::Block;
use crate::step::Steps;
use std::sync::Arc;

/// Blocks for these environments, all unused.
pub(super) fn new_blocks<R: Row>(
    ensemble: &Ensemble,
    seats: &[Seats],
    pool: &Pool,
    interruption: &Interruption<'_>,
) -> Result<Vec<Cohort<R>>, Interrupted> {
    let mut made: Vec<Option<Cohort<R>>> = Vec::new();
    made.resize_with(seats.len(), || None);
    pool.fill(interruption, &mut made, 1, |index, cohort| {
        let seats = seats[index];
        let model = Arc::clone(&ensemble.models()[seats.scene]);
        let block = Block::new(&model);
        let Cohort { block, .. } = cohort[0].insert(Cohort { seats, model, block });
        // Now, while whoever makes them knows that there is memory for it: a call may have to keep the state.
        block.begin(interruption);
        block.forget();
    })?;
    Ok(made.into_iter().flatten().collect())
}

/// Does the work on each block. Where it is stopped, all blocks are as before.
pub(super) fn each_block<R: Row>(
    pool: &Pool,
    interruption: &Interruption<'_>,
    cohorts: &mut [Cohort<R>],
    work: impl Fn(&mut Cohort<R>) + Sync,
) -> Result<(), Interrupted> {
    pool.each(interruption, cohorts, 1, |_, cohort| {
        if cohort[0].block.begin(interruption) {
            work(&mut cohort[0]);
        }
    });
    settle(cohorts, interruption)
}

/// Ends what may have been stopped: blocks go on, or back to where they were.
pub(super) fn settle<R: Row>(
    cohorts: &mut [Cohort<R>],
    interruption: &Interruption<'_>,
) -> Result<(), Interrupted> {
    let outcome = interruption.last_asked();
    if interruption.is_possible() {
        for Cohort { model, block, .. } in cohorts {
            if outcome.is_err() && block.put_back() {
                (0..R::LANES).for_each(|lane| apply_parameters(model, block, lane));
            }
            block.forget();
        }
    }
    outcome
}

/// A control step of all blocks, each with the rows of the output that belong to it.
pub(super) fn control_step<R: Row>(
    cohorts: &mut [Cohort<R>],
    pool: Option<&rayon::ThreadPool>,
    actions: &[f64],
    output: StepOutput<'_>,
    interruption: &Interruption<'_>,
) where
    Block<R>: Steps,
{
    let work = |cohort: &mut Cohort<R>, rows: StepOutput<'_>| {
        if cohort.block.begin(interruption) {
            // Where it was stopped, the block is put back.
            let _ = control_block(cohort, actions, rows, interruption);
        }
    };
    interruption.run(pool, || deal(cohorts, output, pool.is_some(), &work));
}

/// Halves cohorts and rows until each cohort has its own: blocks may hold different numbers of environments.
fn deal<R: Row>(
    cohorts: &mut [Cohort<R>],
    output: StepOutput<'_>,
    parallel: bool,
    work: &(impl Fn(&mut Cohort<R>, StepOutput<'_>) + Sync),
) {
    let middle = cohorts.len() / 2;
    let (before, behind) = match cohorts {
        [] => return,
        [one] => return work(one, output),
        many => many.split_at_mut(middle),
    };
    let (upper, lower) = output.split_at(behind[0].seats.first - before[0].seats.first);
    let first = || deal(before, upper, parallel, work);
    let second = || deal(behind, lower, parallel, work);
    if parallel {
        rayon::join(first, second);
    } else {
        first();
        second();
    }
}
