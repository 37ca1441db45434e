//! Blocks in the air: no point touches at the start of a step, and none at its end.
//!
//! The first iterate of Newton's iteration is then the solution: one system, and nothing about contact points but that
//! they stay above the ground. Whether a whole block is in the air depends on all its lanes, and results must not;
//! so the iteration's own elimination is used, and its own test of the residual. Both ways give equal bits.

use super::newton::{follow, free_residual, size_of_residual, start, turn};
use super::search::Search;
use super::system::solve_free;
use super::{Mode, load_vector, store_where};
use crate::lanes::{Isa, Mask, Real};
use crate::model::Model;
use crate::state::Block;

/// Whether any point of the lanes of a mask touches at the start of the step.
#[inline(always)]
pub(super) fn touching<I: Isa>(isa: I, block: &Block<I::Row>, mask: I::M) -> bool {
    let mut count = isa.splat(0.0);
    for row in block.contact.touching.iter() {
        count = count + isa.load(row);
    }
    (count.gt(isa.splat(0.0)) & mask).any()
}

/// Takes the step where every lane that runs stays in the air, given that none touches at its start; whether they do.
pub(super) fn fly<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    running: I::M,
) -> bool {
    solve_free(isa, model, block);
    isa.vectorize(
        #[inline(always)]
        || {
            start::<D, I>(isa, model, block);
            turn::<D, I>(isa, model, block, running);
            let flies = solved(isa, block) & above::<D, I>(isa, model, block);
            if !(flies | !running).all() {
                return false;
            }
            let work = &mut block.contact;
            follow(isa, &mut work.known, &work.direction, isa.splat(1.0), running);
            release(isa, block, running);
            true
        },
    )
}

/// Whether the iteration would end with the whole step.
#[inline(always)]
fn solved<I: Isa>(isa: I, block: &mut Block<I::Row>) -> I::M {
    free_residual(isa, &mut block.contact, isa.splat(1.0));
    let tolerance = Search::load(isa, &block.contact.search).tolerance;
    size_of_residual(isa, &block.contact).le(tolerance)
}

/// Whether no point presses at the end of the step.
#[inline(always)]
fn above<const D: usize, I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::M {
    let work = &block.contact;
    let mut above = isa.splat(0.0).eq(isa.splat(0.0));
    for c in 0..model.contacts.len() {
        let [up, ..] = load_vector::<D, I>(isa, &work.velocity, c);
        let [change, ..] = load_vector::<D, I>(isa, &work.velocity_change, c);
        above = above & (up + change).ge(isa.splat(0.0));
    }
    above
}

/// Points in the air hold no impulses.
#[inline(always)]
fn release<I: Isa>(isa: I, block: &mut Block<I::Row>, mask: I::M) {
    let zero = isa.splat(0.0);
    for rows in [&mut block.normal, &mut block.pad] {
        for row in rows.iter_mut() {
            store_where(isa, mask, zero, row);
        }
    }
    for row in block.mode.iter_mut() {
        store_where(isa, mask, isa.splat(Mode::OPEN), row);
    }
}
