//! Newmark's scheme, β = γ = ½, linearly implicit in reduced coordinates, with numerical dissipation.
//!
//! In its two-step form it takes the strain at the start of the step, which stands half-way between two velocities, and
//! β Δt² of its acceleration, hence a = −β Δt, b = τ + β Δt. It adds stiffness times the change of velocity: stable for any
//! stiffness, and since that change is itself of order Δt, the Gauss–Newton stiffness is good enough. Of second order but
//! for damping, whose rate is taken at v⁺, and for Δt/100 in the geometric stiffness.
//!
//! With β = ½ alone it does not damp at all, and rods whose vibration is far faster than the step do not come to rest. As in
//! the method of Hilber, Hughes & Taylor (1977) older values help: Δt times the change of velocity between two steps is of
//! second order, so the scheme remains so. A vibration of frequency ω loses ¼ λ (ω Δt)³ of its amplitude a radian, and 10 % a
//! step where ω Δt is large; it grows for no ω Δt while λ < ½.
//!
//! A Maxwell branch bears its mean while the strain stands as at the start of the step, c = m: its dashpot stands half-way between two
//! strains, as velocities do, so this is of second order too. The change of velocity acts on the stiffness m that
//! the branch shows in a step, with β = 1 − m/2: ½ where it hardly fades, and 1 where it is a mere dashpot,
//! whose force is then that of v⁺. A vibration grows for no ω Δt and no branches.

use super::{Coefficients, Maxwell};

/// β.
const BETA: f64 = 0.5;
/// λ, the numerical dissipation.
const DISSIPATION: f64 = 0.1;
/// Least retardation time of the geometric stiffness, in steps. A tension that changes from step to step can feed
/// vibrations across it that are far faster than the step, which λ alone does not stop.
const STEADYING: f64 = 0.01;

pub(super) const COEFFICIENTS: Coefficients = Coefficients {
    name: "newmark",
    words: "Newmark, linearly implicit, magnets eliminated",
    multipliers: false,
    before: [0.0, -BETA],
    after: [1.0, BETA],
    geometric_s: |dt| [-BETA * dt, STEADYING * dt + BETA * dt],
    branch: |Maxwell { mean, .. }| {
        let seen = mean * (1.0 - 0.5 * mean);
        [mean, -seen, seen]
    },
    numerical_dissipation: DISSIPATION,
};
