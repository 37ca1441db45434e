//! The paper's scheme: explicit forces, a = τ, b = 0, and rigid magnets held by Lagrange multipliers.
//!
//! A Maxwell branch bears its mean while the strain stands as at the start of the step: its dashpot is half a step behind before and
//! ahead after, where velocities stand, so that this too is of second order.
//!
//! It has a longest stable step, see [`crate::model::ExplicitLimit`].

use super::{Coefficients, Maxwell};

pub(super) const COEFFICIENTS: Coefficients = Coefficients {
    name: "explicit",
    words: "explicit, magnets held by Lagrange multipliers",
    multipliers: true,
    before: [1.0, 0.0],
    after: [0.0, 0.0],
    geometric_s: |_| [0.0; 2],
    branch: |Maxwell { mean, .. }| [mean, 0.0, 0.0],
    numerical_dissipation: 0.0,
};
