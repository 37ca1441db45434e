//! The laws of contact at one point, and their derivative.

use super::guess::{direction, length};
use super::{Mode, Vector};
use crate::lanes::{Isa, Real};
use crate::model::GroundLaw;
use crate::model::rows::RESPONSE;
use crate::scene::Parameter;
use crate::state::Block;

/// Adhesion is at most this multiple of the normal impulse. The paper's D_f is there however lightly a point touches
/// and gone where it does not: where its lever lifts the point, neither holds. So it fades within the last
/// fraction of a millinewton.
const GRAZE: f64 = 4.0;

/// Friction and pads of each lane in one step.
#[derive(Clone, Copy, Debug)]
pub struct Ground<F> {
    /// μ_s.
    pub static_friction: F,
    /// μ_d.
    pub dynamic_friction: F,
    /// D_f Δt [N·s].
    pub adhesion: F,
    /// v_d [m/s].
    pub transition_speed: F,
    /// w = k Δt τ [kg], τ at least Δt.
    pub weight: F,
    /// 1 − Δt/τ, the share of w that is viscous.
    pub viscous_share: F,
    /// τ [s].
    pub lead_s: F,
}

impl<F: Real> Ground<F> {
    /// The law in the lanes of a block.
    #[inline(always)]
    pub fn new(law: &GroundLaw, static_factor: F, dynamic_factor: F, dt: f64) -> Self {
        let one = static_factor.splat(1.0);
        // The step itself damps like a time Δt: that counts towards τ.
        let lead_s = law.damping_time_s.max(dt);
        let static_friction = static_factor * law.static_friction;
        Self {
            static_friction,
            // Varied on its own it could exceed the static one, which has no meaning.
            dynamic_friction: (dynamic_factor * law.dynamic_friction).min(static_friction),
            adhesion: one * (law.adhesion_n * dt),
            transition_speed: one * law.transition_speed_m_s,
            weight: one * (law.stiffness_n_m * dt * lead_s),
            viscous_share: one * (1.0 - dt / lead_s),
            lead_s: one * lead_s,
        }
    }

    /// The law with the factors of a block.
    #[inline(always)]
    pub(super) fn of<I: Isa<F = F>>(
        isa: I,
        law: &GroundLaw,
        step_s: f64,
        block: &Block<I::Row>,
    ) -> Self {
        let of_static = isa.load(&block.factors[Parameter::StaticFriction as usize]);
        let of_dynamic = isa.load(&block.factors[Parameter::DynamicFriction as usize]);
        Self::new(law, of_static, of_dynamic, step_s)
    }

    /// μ λ_n + D_f Δt, the greatest tangential impulse.
    #[inline(always)]
    pub(super) fn friction(&self, coefficient: F, normal: F) -> F {
        coefficient * normal + self.adhesion.min(normal * GRAZE)
    }

    /// Its derivative by the normal impulse.
    #[inline(always)]
    fn friction_slope(&self, coefficient: F, normal: F) -> F {
        let grazes = (normal * GRAZE).lt(self.adhesion);
        F::select(grazes, coefficient + GRAZE, coefficient)
    }
}

/// A contact point in one step.
pub(super) struct Point<F> {
    pub(super) warm: Vector<F>,
    pub(super) coefficient: F,
    /// The greatest tangential impulse, where it does not follow the normal one.
    pub(super) bound: F,
}

/// Impulses at a velocity, and what they were read from.
pub(super) struct Impulse<F: Real> {
    /// λ.
    pub(super) impulse: Vector<F>,
    /// λ_n > 0.
    pub(super) closed: F::Mask,
    /// |ξ_t| > F.
    pub(super) slides: F::Mask,
    /// F/|ξ_t| where it slides, else 1.
    pub(super) share: F,
    /// ξ_t/|ξ_t|.
    pub(super) pushed: [F; 2],
}

impl<F: Real> Impulse<F> {
    /// The mode that these are the impulses of.
    #[inline(always)]
    pub(super) fn mode(&self) -> F {
        let one = self.share;
        let closed = F::select(self.slides, one.splat(Mode::SLIDE), one.splat(Mode::STICK));
        F::select(self.closed, closed, one.splat(Mode::OPEN))
    }
}

impl<F: Real> Point<F> {
    /// λ(u): the normal part of ξ where it presses, the tangential part cut to the cone. `bounded`: to its own bound.
    #[inline(always)]
    pub(super) fn impulse<const D: usize>(
        &self,
        ground: &Ground<F>,
        u: &Vector<F>,
        bounded: bool,
    ) -> Impulse<F> {
        let (zero, one) = (u[0].splat(0.0), u[0].splat(1.0));
        let augmented = -(ground.weight * u[0]);
        let mut along = [zero; 2];
        for t in 0..D - 1 {
            along[t] = self.warm[1 + t] - ground.weight * u[1 + t];
        }
        let normal = augmented.max(zero);
        let friction = if bounded { self.bound } else { ground.friction(self.coefficient, normal) };
        let grip = length::<F, D>(along);
        let slides = grip.gt(friction);
        let share = F::select(slides, friction / F::select(slides, grip, one), one);
        // Where nothing presses nothing is held, also where the square of a tiny push is too small a number.
        let share = F::select(friction.gt(zero), share, zero);
        let impulse = [normal, along[0] * share, along[1] * share];
        let pushed = direction::<F, D>(along);
        Impulse { impulse, closed: augmented.gt(zero), slides, share, pushed }
    }
}

/// Impulses linear in the velocity without the bias: λ = `force` − C u with
///
/// ```text
///     | normal   0    0  |
/// C = | drag_x   xx   xz |
///     | drag_z   xz   zz |
/// ```
pub(super) struct Response<F> {
    pub(super) force: Vector<F>,
    pub(super) normal: F,
    pub(super) drag: [F; 2],
    /// xx, xz, zz.
    pub(super) along: [F; 3],
}

impl<F: Real> Response<F> {
    /// The law linearised at the velocity u; where a point has `passed` the place where it sticks, as if it stuck.
    #[inline(always)]
    pub(super) fn at<const D: usize>(
        point: &Point<F>,
        ground: &Ground<F>,
        found: &Impulse<F>,
        u: &Vector<F>,
        bias: &Vector<F>,
        bounded: bool,
        passed: F::Mask,
    ) -> Self {
        let (zero, w) = (u[0].splat(0.0), ground.weight);
        let normal = F::select(found.closed, w, zero);
        let slope = ground.friction_slope(point.coefficient, found.impulse[0]);
        let slides = found.slides & !passed;
        let dragged = if bounded { zero } else { F::select(slides, normal * slope, zero) };
        // w F/|ξ| across the direction of sliding, 0 along it: Coulomb's cone.
        let across = F::select(slides, found.share * w, w);
        let lost = F::select(slides, across, zero);
        let e = found.pushed;
        let mut response = Self {
            force: found.impulse,
            normal,
            drag: [dragged * e[0], dragged * e[1]],
            along: [
                across - lost * e[0] * e[0],
                -(lost * e[0] * e[1]),
                across - lost * e[1] * e[1],
            ],
        };
        if D == 2 {
            // Exactly 0 where it slides.
            response.along[0] = across - lost;
        }
        let known = [u[0] - bias[0], u[1] - bias[1], u[2] - bias[2]];
        let back = response.times::<D>(&known);
        for k in 0..D {
            response.force[k] = response.force[k] + back[k];
        }
        for t in 1..D {
            response.force[t] = F::select(passed, point.warm[t] - w * bias[t], response.force[t]);
        }
        response
    }

    /// C u.
    #[inline(always)]
    fn times<const D: usize>(&self, u: &Vector<F>) -> Vector<F> {
        let zero = self.normal.splat(0.0);
        let n = self.normal * u[0];
        if D == 2 {
            return [n, self.drag[0] * u[0] + self.along[0] * u[1], zero];
        }
        let x = self.drag[0] * u[0] + self.along[0] * u[1] + self.along[1] * u[2];
        let z = self.drag[1] * u[0] + self.along[1] * u[1] + self.along[2] * u[2];
        [n, x, z]
    }

    #[inline(always)]
    pub(super) fn load<I: Isa<F = F, M = F::Mask>>(isa: I, rows: &[I::Row], c: usize) -> Self {
        let rows = &rows[RESPONSE * c..RESPONSE * (c + 1)];
        Self {
            force: [isa.load(&rows[0]), isa.load(&rows[1]), isa.load(&rows[2])],
            normal: isa.load(&rows[3]),
            drag: [isa.load(&rows[4]), isa.load(&rows[5])],
            along: [isa.load(&rows[6]), isa.load(&rows[7]), isa.load(&rows[8])],
        }
    }

    #[inline(always)]
    pub(super) fn store<I: Isa<F = F, M = F::Mask>>(
        &self,
        isa: I,
        mask: I::M,
        rows: &mut [I::Row],
        c: usize,
    ) {
        let rows = &mut rows[RESPONSE * c..RESPONSE * (c + 1)];
        for k in 0..3 {
            super::store_where(isa, mask, self.force[k], &mut rows[k]);
            super::store_where(isa, mask, self.along[k], &mut rows[6 + k]);
        }
        super::store_where(isa, mask, self.normal, &mut rows[3]);
        for k in 0..2 {
            super::store_where(isa, mask, self.drag[k], &mut rows[4 + k]);
        }
    }
}
