//! Linearly implicit (backward) Euler in reduced coordinates.
//!
//! (M + Δt (Δt + τ) Σ k g gᵀ) v⁺ = M v + Δt (F − Σ k s g), with strains s and gradients g at the
//! start of the step: one Newton iteration of backward Euler with the Gauss–Newton stiffness. First
//! order; damps what oscillates faster than the step resolves. Magnetic and gravitational forces
//! are those at the start of the step with the drive at its end.

use super::springs;
use crate::elastic::Scheme;
use crate::lanes::Isa;
use crate::model::Model;
use crate::state::Block;

/// Adds the elastic terms of a step.
#[inline(always)]
pub fn assemble<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    scheme: Scheme<I::F>,
) {
    springs::<W, D, I>(isa, model, block, scheme);
}
