//! Backward Euler, linearly implicit in reduced coordinates.
//!
//! It takes the strain at the end of the step, a = 0, b = τ + Δt. It is of first order, stable for any stiffness, and damps
//! like a retardation time Δt what oscillates faster than the step resolves.

use super::Coefficients;

pub(super) const COEFFICIENTS: Coefficients = Coefficients {
    name: "euler",
    words: "backward Euler, linearly implicit, magnets eliminated",
    multipliers: false,
    before: [0.0, 0.0],
    after: [1.0, 1.0],
    geometric_s: |dt| [0.0, dt],
    numerical_dissipation: 0.0,
};
