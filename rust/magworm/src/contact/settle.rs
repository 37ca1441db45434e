//! The normal impulses that friction reckons with, from pass to pass.
//!
//! For fixed modes the impulses found, N(r), are linear in the impulses r that friction reckoned with, and the
//! law asks for N(r) = r. Points of one foot hang together: what one of them slides against lifts another. So
//! the residual f = N(r) − r of all sliding points is brought to zero by Anderson's acceleration with a memory
//! of two passes (Anderson 1965; Walker & Ni 2011): the combination of the last changes of r that would have
//! cancelled f to first order.

use super::Mode;
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Rows of memory of a contact: r and f of the pass before, and how both had changed in it.
pub const MEMORY: usize = 4;
/// Growth of the impulse found with the impulse reckoned with, beyond which there is no solution nearby.
const STEEP: f64 = 0.8;
/// Relative determinant below which two changes count as one.
const PARALLEL: f64 = 1e-8;

/// Forgets the passes of the step before.
#[inline(always)]
pub(super) fn forget<const W: usize, I: Isa<W>>(isa: I, block: &mut Block<W>) {
    isa.store(isa.splat(0.0), &mut block.remembered[0]);
}

/// The impulses to reckon with in the next pass, in the lanes that are not done. A lane whose modes have changed
/// starts anew. Where there is nothing to extrapolate from, the share `pace` of the change is taken.
#[inline(always)]
pub(super) fn settle<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    done: I::M,
    moved: I::M,
    pace: f64,
) {
    let (zero, one) = (isa.splat(0.0), isa.splat(1.0));
    let passes = I::F::select(moved, zero, isa.load(&block.remembered[0]));
    let known = [passes.gt(zero), passes.gt(one)];
    let mut sums =
        Sums { a11: zero, a12: zero, a22: zero, b1: zero, b2: zero, run: zero, rise: zero };
    for c in 0..model.contacts.len() {
        sums.add(&Point::load(isa, block, c, known));
    }
    let [g1, g2] = sums.weights();
    let anew = passes.eq(zero);
    let steep = (sums.rise + sums.run).gt(sums.run * STEEP);
    for c in 0..model.contacts.len() {
        let point = Point::load(isa, block, c, known);
        let found = point.reckoned + point.residual;
        let agreed = found
            - g1 * (point.changes[0][0] + point.changes[0][1])
            - g2 * (point.changes[1][0] + point.changes[1][1]);
        let sound = !steep & !anew & agreed.gt(zero);
        let next = I::F::select(sound, agreed, point.reckoned + point.residual * pace);
        let row = &mut block.reckoned[c];
        isa.store(I::F::select(done, isa.load(row), next), row);
        let [dr, df] = point.changes[0];
        let kept = [point.reckoned, point.residual, dr, df];
        let memory = &mut block.memory[MEMORY * c..MEMORY * (c + 1)];
        for k in 0..MEMORY {
            isa.store(I::F::select(done, isa.load(&memory[k]), kept[k]), &mut memory[k]);
        }
    }
    let row = &mut block.remembered[0];
    isa.store(I::F::select(done, isa.load(row), passes + 1.0), row);
}

/// A contact after a pass.
struct Point<F> {
    reckoned: F,
    residual: F,
    /// Changes of r and f in this pass and in the one before; 0 where they are not known.
    changes: [[F; 2]; 2],
}

impl<F: Real> Point<F> {
    #[inline(always)]
    fn load<const W: usize, I: Isa<W, F = F, M = F::Mask>>(
        isa: I,
        block: &Block<W>,
        c: usize,
        known: [F::Mask; 2],
    ) -> Self {
        let zero = isa.splat(0.0);
        let slides = isa.load(&block.mode[c]).eq(isa.splat(Mode::SLIDE));
        let memory = &block.memory[MEMORY * c..MEMORY * (c + 1)];
        let reckoned = isa.load(&block.reckoned[c]);
        let residual = isa.load(&block.normal[c]) - reckoned;
        let (last, before) = (slides & known[0], slides & known[1]);
        let now = [
            F::select(last, reckoned - isa.load(&memory[0]), zero),
            F::select(last, residual - isa.load(&memory[1]), zero),
        ];
        let earlier = [
            F::select(before, isa.load(&memory[2]), zero),
            F::select(before, isa.load(&memory[3]), zero),
        ];
        Self { reckoned, residual, changes: [now, earlier] }
    }
}

/// Normal equations of the least squares |f − Σ γ Δf|, and the last change of r and of f along it.
struct Sums<F> {
    a11: F,
    a12: F,
    a22: F,
    b1: F,
    b2: F,
    run: F,
    rise: F,
}

impl<F: Real> Sums<F> {
    #[inline(always)]
    fn add(&mut self, point: &Point<F>) {
        let [[r1, f1], [_, f2]] = point.changes;
        self.a11 = self.a11 + f1 * f1;
        self.a12 = self.a12 + f1 * f2;
        self.a22 = self.a22 + f2 * f2;
        self.b1 = self.b1 + f1 * point.residual;
        self.b2 = self.b2 + f2 * point.residual;
        self.run = self.run + r1 * r1;
        self.rise = self.rise + r1 * f1;
    }

    #[inline(always)]
    fn weights(&self) -> [F; 2] {
        let (zero, one) = (self.a11.splat(0.0), self.a11.splat(1.0));
        let none = !self.a11.gt(zero);
        let single = F::select(none, zero, self.b1 / F::select(none, one, self.a11));
        let determinant = self.a11 * self.a22 - self.a12 * self.a12;
        let both = determinant.gt(self.a11 * self.a22 * PARALLEL);
        let over = one / F::select(both, determinant, one);
        let first = (self.b1 * self.a22 - self.b2 * self.a12) * over;
        let second = (self.b2 * self.a11 - self.b1 * self.a12) * over;
        [F::select(both, first, single), F::select(both, second, zero)]
    }
}
