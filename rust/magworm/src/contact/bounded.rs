//! Friction with a bound of its own, where Coulomb's law has no solution or none is found: what is left minimises a
//! convex energy (Tresca's law), and the search finds it.

use super::law::Ground;
use super::search::Search;
use super::{Workspace, store_where};
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Difference of all bounds from what Coulomb's law allows, relative to it, below which they agree.
const AGREED: f64 = 1e-3;

/// Friction is bounded by what the normal impulse of the step before allows.
#[inline(always)]
pub(super) fn bound_by_last<const D: usize, I: Isa>(
    isa: I,
    ground: &Ground<I::F>,
    work: &mut Workspace<I::Row>,
    c: usize,
) {
    let coefficient = isa.load(&work.coefficient[c]);
    let bound = ground.friction(coefficient, isa.load(&work.warm[D * c]));
    isa.store(bound, &mut work.bound[c]);
}

/// Brings the bounds of friction halfway to those of the normal impulses found, in the lanes of a mask; the
/// lanes where they agree.
#[inline(always)]
pub(super) fn relax<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
) -> I::M {
    let zero = isa.splat(0.0);
    let (mut off, mut all) = (zero, zero);
    for c in 0..model.contacts.len() {
        let [found, bound] = found_and_bound(isa, ground, block, c);
        off = off.max((found - bound).abs());
        all = all + found;
    }
    let agreed = off.le(all * AGREED);
    let moves = mask & !agreed;
    for c in 0..model.contacts.len() {
        let [found, bound] = found_and_bound(isa, ground, block, c);
        store_where(isa, moves, (found + bound) * 0.5, &mut block.contact.bound[c]);
    }
    let mut search = Search::load(isa, &block.contact.search);
    search.retake(moves, zero);
    search.store(isa, &mut block.contact.search);
    mask & agreed
}

/// What Coulomb's law allows with the normal impulse found, and the bound in force.
#[inline(always)]
fn found_and_bound<I: Isa>(
    isa: I,
    ground: &Ground<I::F>,
    block: &Block<I::Row>,
    c: usize,
) -> [I::F; 2] {
    let coefficient = isa.load(&block.contact.coefficient[c]);
    let found = ground.friction(coefficient, isa.load(&block.normal[c]));
    [found, isa.load(&block.contact.bound[c])]
}
