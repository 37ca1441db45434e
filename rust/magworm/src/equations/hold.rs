//! Wrenches of the drive that act for several steps (`solver.wrench_interval`).
//!
//! Each lane computes its wrenches in the steps whose number since its reset is a multiple of the interval n; in the n − 1 steps
//! that follow, force [N] and torque [N·m] keep their components along x, y and z. What acts is (n − 1)/2 steps old on the
//! average, so the error is of first order in that age τ; a force that holds a magnet in place then feeds its motion,
//! −k x(t − τ) ≈ −k x + k τ v. The torque of a uniform field is not held: it costs next to nothing.
//!
//! Lanes may have been reset at different times. Where one is due, the block computes the wrenches of all its lanes, and each
//! takes them or keeps its own; so the bits of a lane do not depend on when its neighbours were reset.

use crate::lanes::{Dim, Isa, Number, Real, Row};
use crate::state::Block;

/// Lanes that run and take new wrenches in this step.
#[inline(always)]
pub fn due<I: Isa>(isa: I, block: &Block<I::Row>, interval: u64) -> I::M {
    // Steps since the last wrench.
    let since = I::Row::of_lanes(|lane| Number::of((block.step_count[lane] % interval) as f64));
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    running & isa.load(&since).eq(isa.splat(0.0))
}

/// Keeps the new wrench of a body magnet in the lanes that are due, and gives the others the one that they hold.
#[inline(always)]
pub fn hold<D: Dim, I: Isa>(
    isa: I,
    block: &mut Block<I::Row>,
    body: usize,
    due: I::M,
    wrench: &mut [I::F; 6],
) {
    for k in 0..D::BODY {
        let row = &mut block.wrench[D::BODY * body + k];
        wrench[k] = I::F::select(due, wrench[k], isa.load(row));
        isa.store(wrench[k], row);
    }
}
