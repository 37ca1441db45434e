//! Newmark's scheme and backward Euler, linearly implicit in reduced coordinates.
//!
//! ```text
//! (M + Δt b Σ k g gᵀ) v⁺ = M v + Δt (F − Σ k (s + a g·v) g),   q⁺ = q + Δt v⁺
//! ```
//!
//! with strains s, gradients g and forces F at q, and a and b as [`crate::elastic::Scheme`] says. Velocities stand half a
//! step before positions (leapfrog, of which Newmark's scheme with β = 0 is another name), so forces at the
//! start of the step are of second order. Newmark's β = ½ adds stiffness times the change of velocity: stable for any
//! stiffness, and since that change is itself of order Δt, the Gauss–Newton stiffness is good enough. Backward Euler
//! takes the strain at the end instead, is of first order, and damps what oscillates faster than the step resolves.

use super::rod;
use crate::elastic::Scheme;
use crate::lanes::Isa;
use crate::model::Model;
use crate::state::Block;

/// Adds the elastic terms of a step.
#[inline(always)]
pub fn assemble<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    scheme: Scheme<I::F>,
) {
    rod::<D, I>(isa, model, block, scheme);
}
