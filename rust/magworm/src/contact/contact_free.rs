//! Steps without contact: no point is active at the start of a step in any lane of a block, and none at its end.
//!
//! The first iterate of Newton's iteration is then the solution, of one system S v = s. Whether all lanes of a block are free
//! depends on all of them, and the results of a lane must not; so the iteration's own elimination and its own test of
//! convergence are used, and both ways give equal bits.

use super::line_search::LineSearch;
use super::newton::{axpy, begin, contact_free_residual, newton_direction, residual_squared};
use super::newton_system::solve_contact_free;
use super::{ContactMode, ContactVector, store_where};
use crate::lanes::{Dim, Isa, Mask, Real};
use crate::model::Model;
use crate::state::Block;

/// Whether any point is active in the lanes of a mask.
#[inline(always)]
pub(super) fn any_active<I: Isa>(isa: I, block: &Block<I::Row>, mask: I::M) -> bool {
    let mut count = isa.splat(0.0);
    for row in block.contact.active.iter() {
        count = count + isa.load(row);
    }
    (count.gt(isa.splat(0.0)) & mask).any()
}

/// Takes the step if it ends without contact in all lanes of a mask, given that no point is active at its start; whether it
/// did.
pub(super) fn try_contact_free_step<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    mask: I::M,
) -> bool {
    solve_contact_free(isa, model, block);
    isa.vectorize(
        #[inline(always)]
        || {
            begin::<D, I>(isa, model, block);
            newton_direction::<D, I>(isa, model, block, mask);
            let free = full_step_converges(isa, block) & all_open::<D, I>(isa, model, block);
            if !(free | !mask).all() {
                return false;
            }
            let work = &mut block.contact;
            axpy(isa, isa.splat(1.0), &work.direction, &mut work.iterate, mask);
            clear_impulses(isa, block, mask);
            true
        },
    )
}

/// Whether the iteration would end with the full step.
#[inline(always)]
fn full_step_converges<I: Isa>(isa: I, block: &mut Block<I::Row>) -> I::M {
    contact_free_residual(isa, &mut block.contact, isa.splat(1.0));
    let tolerance = LineSearch::load(isa, &block.contact.line_search).tolerance;
    residual_squared(isa, &block.contact).le(tolerance)
}

/// Whether no point presses after the full step.
#[inline(always)]
fn all_open<D: Dim, I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::M {
    let work = &block.contact;
    let mut open = isa.splat(0.0).eq(isa.splat(0.0));
    for c in 0..model.contacts.len() {
        let u = ContactVector::<D, I::F>::load(isa, &work.velocity, c);
        let change = ContactVector::<D, I::F>::load(isa, &work.velocity_change, c);
        open = open & (u.normal + change.normal).ge(isa.splat(0.0));
    }
    open
}

/// Opens all contacts in the lanes of a mask.
#[inline(always)]
fn clear_impulses<I: Isa>(isa: I, block: &mut Block<I::Row>, mask: I::M) {
    let zero = isa.splat(0.0);
    for rows in [&mut block.normal_impulse, &mut block.tangential_spring] {
        for row in rows.iter_mut() {
            store_where(isa, mask, zero, row);
        }
    }
    for row in block.contact_mode.iter_mut() {
        store_where(isa, mask, isa.splat(ContactMode::Open.code()), row);
    }
}
