//! Tresca's friction and the fixed point that leads from it to Coulomb's.
//!
//! With friction bounds that do not follow the normal impulse, the equations of a step are those of a convex energy, so they
//! have a solution and the line search finds it. Coulomb's law is the fixed point F = μ λ_n(F) + D_f Δt; it is approached by
//! relaxation, F ← ½ (F + μ λ_n + D_f Δt). Where Coulomb's law has no solution, F stays as near to it as it came.

use super::law::{ContactLaw, ContactLaws};
use super::line_search::LineSearch;
use super::{Workspace, store_where};
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Largest difference |F − μ λ_n − D_f Δt| over Σ (μ λ_n + D_f Δt) below which the fixed point is reached.
const TOLERANCE: f64 = 1e-3;

/// Sets the friction bound of a point to what the normal impulse of the step before allows.
#[inline(always)]
pub(super) fn lag_friction_bound<I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    work: &mut Workspace<I::Row>,
    c: usize,
    dimensions: usize,
) {
    let coefficient = isa.load(&work.friction_coefficient[c]);
    let normal = isa.load(&work.warm_start[dimensions * c]);
    isa.store(law.friction_bound(coefficient, normal), &mut work.friction_bound[c]);
}

/// Relaxes the friction bounds in the lanes of a mask, whose iteration then goes on from where it is; the lanes of the mask
/// where the fixed point was reached.
#[inline(always)]
pub(super) fn relax_friction_bounds<I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
) -> I::M {
    let zero = isa.splat(0.0);
    let (mut difference, mut total) = (zero, zero);
    for (c, pair) in model.contacts.iter().enumerate() {
        let [coulomb, bound] = coulomb_and_tresca_bound(isa, laws.of(pair), block, c);
        difference = difference.max((coulomb - bound).abs());
        total = total + coulomb;
    }
    let reached = difference.le(total * TOLERANCE);
    let moves = mask & !reached;
    for (c, pair) in model.contacts.iter().enumerate() {
        let [coulomb, bound] = coulomb_and_tresca_bound(isa, laws.of(pair), block, c);
        store_where(isa, moves, (coulomb + bound) * 0.5, &mut block.contact.friction_bound[c]);
    }
    let mut search = LineSearch::load(isa, &block.contact.line_search);
    search.accept_next(moves, zero);
    search.store(isa, &mut block.contact.line_search);
    mask & reached
}

/// μ λ_n + D_f Δt with the normal impulse found, and the bound in force.
#[inline(always)]
fn coulomb_and_tresca_bound<I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    block: &Block<I::Row>,
    c: usize,
) -> [I::F; 2] {
    let coefficient = isa.load(&block.contact.friction_coefficient[c]);
    let coulomb = law.friction_bound(coefficient, isa.load(&block.normal_impulse[c]));
    [coulomb, isa.load(&block.contact.friction_bound[c])]
}
