//! A step that is taken in parts.
//!
//! Rigid feet with friction may have no consistent modes at a long step: the active set then takes turns without
//! end. In parts of the step they nearly always have. Impulses of contacts are kept per whole step, so those
//! that the parts start from are parts of them.

use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Puts modes and impulses back to those of the start of the step, the impulses over `parts`, in the lanes of
/// `mask`.
#[inline(always)]
pub fn divide<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    mask: I::M,
    parts: f64,
) {
    for c in 0..model.contacts.len() {
        let before = isa.load(&block.mode_before[c]);
        isa.store(I::F::select(mask, before, isa.load(&block.mode[c])), &mut block.mode[c]);
        let start = isa.load(&block.warm[D * c]) / parts;
        isa.store(I::F::select(mask, start, isa.load(&block.normal[c])), &mut block.normal[c]);
        for t in 0..D - 1 {
            let start = isa.load(&block.warm[D * c + 1 + t]) / parts;
            let row = &mut block.tangential[(D - 1) * c + t];
            isa.store(I::F::select(mask, start, isa.load(row)), row);
        }
    }
}

/// Impulses of a part times `parts`: those of a whole step.
#[inline(always)]
pub fn join<const W: usize, I: Isa<W>>(isa: I, block: &mut Block<W>, mask: I::M, parts: f64) {
    for rows in [&mut block.normal, &mut block.tangential] {
        for k in 0..rows.len() {
            let impulse = isa.load(&rows[k]);
            isa.store(I::F::select(mask, impulse * parts, impulse), &mut rows[k]);
        }
    }
}
