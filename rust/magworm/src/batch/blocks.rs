//! Work on all blocks of a batch. Where it is stopped, all of them are as before.

use super::control::{ControlRows, control_block};
use super::{Pool, StepOutput};
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::Row;
use crate::model::Model;
use crate::observe;
use crate::reset::apply_parameters;
use crate::state::Block;
use crate::step::Steps;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;

/// Blocks for so many environments, all unused.
pub(super) fn new_blocks<R: Row>(
    model: &Model,
    count: usize,
    pool: &Pool,
    interruption: &Interruption<'_>,
) -> Result<Vec<Block<R>>, Interrupted> {
    let mut made: Vec<Option<Block<R>>> = Vec::new();
    made.resize_with(count.div_ceil(R::LANES), || None);
    pool.fill(interruption, &mut made, 1, |_, block| {
        let made = block[0].insert(Block::new(model));
        // Now, while whoever makes them knows that there is memory for it: a call may have to keep the state.
        made.begin(interruption);
        made.forget();
    })?;
    Ok(made.into_iter().flatten().collect())
}

/// Environments of each of these blocks.
pub(super) fn lanes_of<R: Row>(_: &[Block<R>]) -> usize {
    R::LANES
}

/// Does the work on each block, which it is given with its index. Where it is stopped, all blocks are as before.
pub(super) fn each_block<R: Row>(
    model: &Model,
    pool: &Pool,
    interruption: &Interruption<'_>,
    blocks: &mut [Block<R>],
    work: impl Fn(usize, &mut Block<R>) + Sync,
) -> Result<(), Interrupted> {
    pool.each(interruption, blocks, 1, |index, block| {
        if block[0].begin(interruption) {
            work(index, &mut block[0]);
        }
    });
    settle(model, blocks, interruption)
}

/// Ends what may have been stopped: blocks go on, or back to where they were.
pub(super) fn settle<R: Row>(
    model: &Model,
    blocks: &mut [Block<R>],
    interruption: &Interruption<'_>,
) -> Result<(), Interrupted> {
    let outcome = interruption.last_asked();
    if interruption.is_possible() {
        for block in blocks {
            if outcome.is_err() && block.put_back() {
                (0..R::LANES).for_each(|lane| apply_parameters(model, block, lane));
            }
            block.forget();
        }
    }
    outcome
}

pub(super) fn place<R: Row>(blocks: &[Block<R>], environment: usize) -> (&Block<R>, usize) {
    (&blocks[environment / R::LANES], environment % R::LANES)
}

pub(super) fn place_mut<R: Row>(
    blocks: &mut [Block<R>],
    environment: usize,
) -> (&mut Block<R>, usize) {
    (&mut blocks[environment / R::LANES], environment % R::LANES)
}

/// Blocks with the rows of the output that belong to each.
pub(super) fn control_step<R: Row>(
    model: &Model,
    blocks: &mut [Block<R>],
    pool: Option<&rayon::ThreadPool>,
    actions: &[f64],
    output: StepOutput<'_>,
    interruption: &Interruption<'_>,
) where
    Block<R>: Steps,
{
    let width = observe::size(model);
    let work = |index: usize, block: &mut Block<R>, rows: ControlRows<'_>| {
        if block.begin(interruption) {
            // Where it was stopped, the block is put back.
            let _ = control_block(model, block, index * R::LANES, actions, rows, interruption);
        }
    };
    let StepOutput { observation, progress_m, status } = output;
    interruption.run(pool, || match pool {
        None => {
            let rows = observation.chunks_mut(R::LANES * width);
            let rows = rows.zip(progress_m.chunks_mut(R::LANES)).zip(status.chunks_mut(R::LANES));
            for (index, (block, rows)) in blocks.iter_mut().zip(rows).enumerate() {
                work(index, block, ControlRows::new(rows));
            }
        }
        Some(_) => {
            let rows = observation.par_chunks_mut(R::LANES * width);
            let rows =
                rows.zip(progress_m.par_chunks_mut(R::LANES)).zip(status.par_chunks_mut(R::LANES));
            blocks.par_iter_mut().zip(rows).enumerate().for_each(|(index, (block, rows))| {
                work(index, block, ControlRows::new(rows));
            });
        }
    });
}
