//! The paper's scheme: explicit forces, a = τ, b = 0, and rigid magnets held by Lagrange multipliers.
//!
//! It has a longest stable step, see [`crate::model::ExplicitLimit`].

use super::Coefficients;

pub(super) const COEFFICIENTS: Coefficients = Coefficients {
    name: "explicit",
    words: "explicit, magnets held by Lagrange multipliers",
    multipliers: true,
    before: [1.0, 0.0],
    after: [0.0, 0.0],
    geometric_s: |_| [0.0; 2],
    numerical_dissipation: 0.0,
};
