//! Backward Euler, linearly implicit in reduced coordinates.
//!
//! It takes the strain at the end of the step, a = 0, b = τ + Δt. It is of first order, stable for any stiffness, and damps
//! like a retardation time Δt what oscillates faster than the step resolves.
//!
//! A Maxwell branch bears its mean while the strain stands as at the end of the step: its dashpot first flows with the strain that ended
//! the step before, c = m (1 − f), and the change of strain counts in full, b₂ = m. Energy, that of the branches included, never
//! grows.

use super::{Coefficients, Maxwell};

pub(super) const COEFFICIENTS: Coefficients = Coefficients {
    name: "euler",
    words: "backward Euler, linearly implicit, magnets eliminated",
    multipliers: false,
    before: [0.0, 0.0],
    after: [1.0, 1.0],
    geometric_s: |dt| [0.0, dt],
    branch: |Maxwell { flow, mean }| [mean * (1.0 - flow), 0.0, mean],
    numerical_dissipation: 0.0,
};
