//! Integrators: which velocities count in the force of a spring. Each has a file with its coefficients.
//!
//! A spring ½ k s² with the strain s, its gradient g = ∂s/∂q and the retardation time τ gives in a step Δt the impulse
//!
//! ```text
//! −Δt k (s + a g·v + b g·v⁺) g,     a = a₀ τ + a₁ Δt,   b = b₀ τ + b₁ Δt
//! ```
//!
//! with v at the start of the step and v⁺ at its end: a number on the right of A v⁺ = b, and where b is not 0 a matrix of
//! rank one on the left; where rubber relaxes, so do its branches ([`Coefficients::branch`]). Velocities stand half a step before positions, q⁺ = q + Δt v⁺ (leapfrog, of which Newmark's
//! scheme with β = 0 is another name), so forces at the start of a step are of second order.

mod euler;
mod explicit;
mod maxwell;
mod newmark;

pub use maxwell::Maxwell;

use serde::{Deserialize, Serialize};

/// A scheme of time integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Newmark's, linearly implicit, of second order; rigid magnets eliminated.
    Newmark,
    /// Backward Euler, linearly implicit, of first order; damps like a retardation time of one step. Rigid magnets
    /// eliminated.
    Euler,
    /// The paper's: explicit forces, rigid magnets held by Lagrange multipliers.
    Explicit,
}

/// What distinguishes one integrator from another.
#[derive(Debug)]
pub struct Coefficients {
    /// Its name in scenes.
    pub name: &'static str,
    /// The same for a person.
    pub words: &'static str,
    /// Whether rigid magnets are held by Lagrange multipliers; else they are eliminated.
    pub multipliers: bool,
    /// a₀ and a₁.
    pub before: [f64; 2],
    /// b₀ and b₁.
    pub after: [f64; 2],
    /// a and b of the geometric stiffness, which has no retardation, for a step Δt [s].
    pub geometric_s: fn(f64) -> [f64; 2],
    /// c, a₂ and b₂ of a Maxwell branch that fades so in a step: with its stiffness k and the strain β of its dashpot it adds
    /// −Δt k (c (s − β) + Δt (a₂ g·v + b₂ g·v⁺)) g to the impulse of a spring.
    pub branch: fn(Maxwell) -> [f64; 3],
    /// λ: what springs take for v is (1 − λ) v + λ v⁻, with v⁻ that of the step before.
    pub numerical_dissipation: f64,
}

impl Integrator {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Newmark, Self::Euler, Self::Explicit];
    /// Their names in scenes.
    pub const NAMES: [&str; 3] =
        [newmark::COEFFICIENTS.name, euler::COEFFICIENTS.name, explicit::COEFFICIENTS.name];

    /// Its coefficients.
    #[inline(always)]
    pub const fn coefficients(self) -> &'static Coefficients {
        match self {
            Self::Newmark => &newmark::COEFFICIENTS,
            Self::Euler => &euler::COEFFICIENTS,
            Self::Explicit => &explicit::COEFFICIENTS,
        }
    }

    /// Whether no velocity at the end of a step counts; such a scheme has a longest stable step.
    pub fn is_explicit(self) -> bool {
        self.coefficients().after == [0.0, 0.0]
    }

    /// Names of those that are explicit, or of those that are not, for a message.
    pub fn names(explicit: bool) -> String {
        let such = Self::ALL.into_iter().filter(|one| one.is_explicit() == explicit);
        such.map(|one| one.coefficients().name).collect::<Vec<_>>().join(" and ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_that_scenes_are_read_with() {
        for (integrator, name) in Integrator::ALL.into_iter().zip(Integrator::NAMES) {
            assert_eq!(toml::Value::try_from(integrator), Ok(name.into()));
            assert_eq!(integrator.coefficients().name, name);
        }
    }
}
