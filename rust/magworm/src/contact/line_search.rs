//! The line search of each lane along a Newton direction d: backtracking on the residual r.
//!
//! ```text
//! accept t where |r(v + t d)|² < (1 − t/10) |r(v)|², else halve t
//! ```
//!
//! |r|² is taken in the metric of 1/diag S [J]. After eight halvings the trial with the least residual is accepted, so that
//! the iteration leaves a place where the direction does not descend. Each pass makes one trial in every lane; so what a lane
//! does is independent of its neighbours.

use crate::lanes::{Isa, Real};
use crate::model::rows::LINE_SEARCH;

/// Trials along a direction before the best of them is accepted.
const MAX_HALVINGS: f64 = 8.0;
/// Share of the decrease that a full step promises which is asked for (Armijo).
const SUFFICIENT_DECREASE: f64 = 0.1;

/// State of the search.
pub(super) struct LineSearch<F> {
    /// t of the next trial.
    pub(super) step: F,
    /// |r(v)|² where the direction begins.
    pub(super) start: F,
    /// Least |r|² of the trials along this direction.
    best: F,
    /// t of that trial.
    best_step: F,
    /// Trials along this direction; the next one is accepted if there were more than [`MAX_HALVINGS`].
    trials: F,
    /// |r|² below which v is a solution.
    pub(super) tolerance: F,
}

impl<F: Real> LineSearch<F> {
    /// A search that accepts its first trial, the full step.
    #[inline(always)]
    pub(super) fn new(tolerance: F) -> Self {
        let mut this = Self {
            step: tolerance,
            start: tolerance,
            best: tolerance,
            best_step: tolerance,
            trials: tolerance,
            tolerance,
        };
        let everywhere = tolerance.eq(tolerance);
        this.begin_direction(everywhere);
        this.accept_next(everywhere, tolerance.splat(1.0));
        this
    }

    /// Begins a new direction in the lanes of a mask.
    #[inline(always)]
    pub(super) fn begin_direction(&mut self, mask: F::Mask) {
        let (zero, one) = (self.step.splat(0.0), self.step.splat(1.0));
        self.step = F::select(mask, one, self.step);
        self.trials = F::select(mask, zero, self.trials);
        self.best = F::select(mask, one * f64::INFINITY, self.best);
        self.best_step = F::select(mask, zero, self.best_step);
    }

    /// Makes t the next trial in the lanes of a mask, and accepts it whatever its residual.
    #[inline(always)]
    pub(super) fn accept_next(&mut self, mask: F::Mask, step: F) {
        self.step = F::select(mask, step, self.step);
        self.trials = F::select(mask, step.splat(MAX_HALVINGS + 1.0), self.trials);
    }

    /// The lanes that accept a trial with this |r|²; the others get their next t.
    #[inline(always)]
    pub(super) fn judge(&mut self, found: F) -> F::Mask {
        let one = self.step.splat(1.0);
        let decreases = found.lt((one - self.step * SUFFICIENT_DECREASE) * self.start);
        let last = self.trials.gt(one * MAX_HALVINGS);
        let accepted = decreases | last;
        let better = found.lt(self.best);
        self.best = F::select(better, found, self.best);
        self.best_step = F::select(better, self.step, self.best_step);
        self.trials = self.trials + 1.0;
        let exhausted = self.trials.gt(one * MAX_HALVINGS);
        let next = F::select(exhausted, self.best_step, self.step * 0.5);
        self.step = F::select(accepted, self.step, next);
        self.start = F::select(accepted, found, self.start);
        accepted
    }

    /// Whether the trial accepted last is a solution.
    #[inline(always)]
    pub(super) fn converged(&self) -> F::Mask {
        self.start.le(self.tolerance)
    }

    #[inline(always)]
    pub(super) fn load<I: Isa<F = F>>(isa: I, rows: &[I::Row]) -> Self {
        Self {
            step: isa.load(&rows[0]),
            start: isa.load(&rows[1]),
            best: isa.load(&rows[2]),
            best_step: isa.load(&rows[3]),
            trials: isa.load(&rows[4]),
            tolerance: isa.load(&rows[5]),
        }
    }

    #[inline(always)]
    pub(super) fn store<I: Isa<F = F>>(&self, isa: I, rows: &mut [I::Row]) {
        let all = [self.step, self.start, self.best, self.best_step, self.trials, self.tolerance];
        for k in 0..LINE_SEARCH {
            isa.store(all[k], &mut rows[k]);
        }
    }
}
