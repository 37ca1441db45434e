//! The line search of each lane: how far along a direction the next trial lies, and whether it is taken.
//!
//! A trial t is taken where |r|² < (1 − t/10) |r₀|², r the residual of the equation in the metric of 1/diag S.
//! Otherwise t is halved; after [`HALVINGS`] halvings the best trial is taken whatever it is. Every pass tries once in
//! every lane, so what a lane does is independent of its neighbours.

use crate::lanes::{Isa, Real};
use crate::model::rows::SEARCH;

const HALVINGS: f64 = 8.0;
/// Share of the decrease that a full step promises.
const DECREASE: f64 = 0.1;

/// State of the search.
pub(super) struct Search<F> {
    /// t.
    pub(super) step: F,
    /// |r₀|².
    pub(super) start: F,
    /// Least |r|² of the trials along this direction, and its t.
    best: [F; 2],
    /// Trials along this direction; beyond [`HALVINGS`] the next one is taken.
    trials: F,
    /// |r|² of a solution.
    pub(super) tolerance: F,
}

impl<F: Real> Search<F> {
    /// A search whose first trial, the whole step, is taken.
    #[inline(always)]
    pub(super) fn new(tolerance: F) -> Self {
        let mut this = Self {
            step: tolerance,
            start: tolerance,
            best: [tolerance; 2],
            trials: tolerance,
            tolerance,
        };
        let everywhere = tolerance.eq(tolerance);
        this.begin(everywhere);
        this.retake(everywhere, tolerance.splat(1.0));
        this
    }

    /// Starts along a new direction in the lanes of a mask.
    #[inline(always)]
    pub(super) fn begin(&mut self, mask: F::Mask) {
        let (zero, one) = (self.step.splat(0.0), self.step.splat(1.0));
        self.step = F::select(mask, one, self.step);
        self.trials = F::select(mask, zero, self.trials);
        self.best[0] = F::select(mask, one * f64::INFINITY, self.best[0]);
        self.best[1] = F::select(mask, zero, self.best[1]);
    }

    /// The next trial is t, and is taken, in the lanes of a mask.
    #[inline(always)]
    pub(super) fn retake(&mut self, mask: F::Mask, step: F) {
        self.step = F::select(mask, step, self.step);
        self.trials = F::select(mask, step.splat(HALVINGS + 1.0), self.trials);
    }

    /// The lanes that take a trial with this |r|²; the others get their next t.
    #[inline(always)]
    pub(super) fn judge(&mut self, found: F) -> F::Mask {
        let one = self.step.splat(1.0);
        let enough = found.lt((one - self.step * DECREASE) * self.start);
        let last = self.trials.gt(one * HALVINGS);
        let taken = enough | last;
        let better = found.lt(self.best[0]);
        self.best =
            [F::select(better, found, self.best[0]), F::select(better, self.step, self.best[1])];
        self.trials = self.trials + 1.0;
        let spent = self.trials.gt(one * HALVINGS);
        let next = F::select(spent, self.best[1], self.step * 0.5);
        self.step = F::select(taken, self.step, next);
        self.start = F::select(taken, found, self.start);
        taken
    }

    /// Whether the trial that was taken last is a solution.
    #[inline(always)]
    pub(super) fn solved(&self) -> F::Mask {
        self.start.le(self.tolerance)
    }

    #[inline(always)]
    pub(super) fn load<I: Isa<F = F>>(isa: I, rows: &[I::Row]) -> Self {
        Self {
            step: isa.load(&rows[0]),
            start: isa.load(&rows[1]),
            best: [isa.load(&rows[2]), isa.load(&rows[3])],
            trials: isa.load(&rows[4]),
            tolerance: isa.load(&rows[5]),
        }
    }

    #[inline(always)]
    pub(super) fn store<I: Isa<F = F>>(&self, isa: I, rows: &mut [I::Row]) {
        let [best, place] = self.best;
        let all = [self.step, self.start, best, place, self.trials, self.tolerance];
        for k in 0..SEARCH {
            isa.store(all[k], &mut rows[k]);
        }
    }
}
