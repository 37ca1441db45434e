//! The contact law of one point: λ as a function of u.
//!
//! ```text
//! λ_n = max(0, −w u_n)
//! ξ_t = λ⁰ − w u_t,   λ_t = ξ_t min(1, F/|ξ_t|)
//! F   = μ λ_n + min(D_f Δt, 4 λ_n)      Coulomb
//! F   = a number for each point         Tresca
//! ```
//!
//! Symbols and units as in [`crate::contact`]. Reading the cone from ξ is due to Alart & Curnier (1991).

use super::{ContactMode, ContactVector};
use crate::lanes::{Dim, Isa, Real};
use crate::model::{ContactPair, ContactParameters};
use crate::scene::Parameter;
use crate::state::Block;

/// Adhesion is at most this multiple of λ_n. The paper's D_f jumps to 0 where a point lifts off; where its lever lifts the
/// point, neither value has a solution. So D_f fades within the last fraction of a millinewton.
const ADHESION_LIMIT: f64 = 4.0;

/// Which bound friction has.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FrictionLaw {
    /// In proportion to the normal impulse.
    Coulomb,
    /// Given for each point beforehand.
    Tresca,
}

/// Parameters of the contact law in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactLaw<F> {
    /// μ_s.
    pub(super) static_friction: F,
    /// μ_d.
    pub(super) dynamic_friction: F,
    /// D_f Δt [N·s].
    adhesion: F,
    /// v_d [m/s].
    pub(super) transition_speed: F,
    /// w = k Δt τ [kg].
    pub(super) effective_mass: F,
    /// 1 − Δt/τ, the share of w that is the damper's.
    pub(super) damper_share: F,
    /// τ [s].
    pub(super) dissipation_time_s: F,
}

impl<F: Real> ContactLaw<F> {
    /// The law with the friction factors of the lanes of a block.
    #[inline(always)]
    pub(super) fn new<I: Isa<F = F>>(
        isa: I,
        parameters: &ContactParameters,
        step_s: f64,
        block: &Block<I::Row>,
    ) -> Self {
        let factor = |parameter: Parameter| isa.load(&block.factors[parameter as usize]);
        let one = isa.splat(1.0);
        // The step itself damps like a time Δt: that counts towards τ.
        let dissipation_time_s = parameters.dissipation_time_s.max(step_s);
        let static_friction = factor(Parameter::StaticFriction) * parameters.static_friction;
        let dynamic_friction = factor(Parameter::DynamicFriction) * parameters.dynamic_friction;
        Self {
            static_friction,
            // Varied on its own it could exceed the static one, which has no meaning.
            dynamic_friction: dynamic_friction.min(static_friction),
            adhesion: one * (parameters.adhesion_n * step_s),
            transition_speed: one * parameters.transition_speed_m_s,
            effective_mass: one * (parameters.stiffness_n_m * step_s * dissipation_time_s),
            damper_share: one * (1.0 - step_s / dissipation_time_s),
            dissipation_time_s: one * dissipation_time_s,
        }
    }

    /// F(λ_n) of Coulomb's law.
    #[inline(always)]
    pub(super) fn friction_bound(&self, coefficient: F, normal: F) -> F {
        coefficient * normal + self.adhesion.min(normal * ADHESION_LIMIT)
    }

    /// dF/dλ_n.
    #[inline(always)]
    pub(super) fn friction_bound_slope(&self, coefficient: F, normal: F) -> F {
        let limited = (normal * ADHESION_LIMIT).lt(self.adhesion);
        F::select(limited, coefficient + ADHESION_LIMIT, coefficient)
    }
}

/// The laws of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactLaws<F> {
    /// That of the ground.
    pub(super) ground: ContactLaw<F>,
    /// That of bodies that meet: without friction.
    bodies: ContactLaw<F>,
}

impl<F: Real> ContactLaws<F> {
    #[inline(always)]
    pub(super) fn new(ground: ContactLaw<F>) -> Self {
        let none = ground.adhesion.splat(0.0);
        let bodies =
            ContactLaw { static_friction: none, dynamic_friction: none, adhesion: none, ..ground };
        Self { ground, bodies }
    }

    /// That of a pair.
    #[inline(always)]
    pub(super) fn of(&self, pair: &ContactPair) -> &ContactLaw<F> {
        if pair.surface_body.is_none() { &self.ground } else { &self.bodies }
    }
}

/// What the law of a point needs beside its velocity.
#[derive(Clone, Copy)]
pub(super) struct PointState<D: Dim, F: Real> {
    /// w along the normal.
    pub(super) normal_mass: F,
    /// λ of the step before: λ_n, and along the tangents λ⁰.
    pub(super) warm_start: ContactVector<D, F>,
    /// μ.
    pub(super) coefficient: F,
    /// F of Tresca's law.
    pub(super) bound: F,
}

/// λ at a velocity, and how it was found.
#[derive(Clone, Copy)]
pub(super) struct ContactImpulse<D: Dim, F: Real> {
    /// λ.
    pub(super) impulse: ContactVector<D, F>,
    /// λ_n > 0.
    pub(super) closed: F::Mask,
    /// |ξ_t| > F.
    pub(super) sliding: F::Mask,
    /// min(1, F/|ξ_t|).
    pub(super) cut: F,
    /// ξ_t/|ξ_t|.
    pub(super) direction: D::Tangent<F>,
}

impl<D: Dim, F: Real> PointState<D, F> {
    /// λ(u).
    #[inline(always)]
    pub(super) fn impulse(
        &self,
        law: &ContactLaw<F>,
        friction: FrictionLaw,
        u: ContactVector<D, F>,
    ) -> ContactImpulse<D, F> {
        let (zero, one) = (u.normal.splat(0.0), u.normal.splat(1.0));
        let augmented_normal = -(self.normal_mass * u.normal);
        let augmented = self.warm_start.tangent - u.tangent * law.effective_mass;
        let normal = augmented_normal.max(zero);
        let bound = match friction {
            FrictionLaw::Coulomb => law.friction_bound(self.coefficient, normal),
            FrictionLaw::Tresca => self.bound,
        };
        let length = D::length(augmented);
        let sliding = length.gt(bound);
        let cut = F::select(sliding, bound / F::select(sliding, length, one), one);
        // Also where the square of a tiny ξ_t is too small a number, and its length 0.
        let cut = F::select(bound.gt(zero), cut, zero);
        ContactImpulse {
            impulse: ContactVector::new(normal, augmented * cut),
            closed: augmented_normal.gt(zero),
            sliding,
            cut,
            direction: D::direction(augmented),
        }
    }
}

impl<D: Dim, F: Real> ContactImpulse<D, F> {
    /// The mode of a point with this impulse.
    #[inline(always)]
    pub(super) fn mode(&self) -> F {
        let code = |mode: ContactMode| self.cut.splat(mode.code());
        let closed = F::select(self.sliding, code(ContactMode::Slide), code(ContactMode::Stick));
        F::select(self.closed, closed, code(ContactMode::Open))
    }
}
