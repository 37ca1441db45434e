//! The laws of contact at one point: what a pass has found, and what Signorini's and Coulomb's laws make of it.
//!
//! Friction is read from the augmented impulse ξ = λ⁰ − w u_t (Alart & Curnier 1991): within the cone the point
//! sticks with λ_t = ξ; beyond it slides with λ_t = F ξ/|ξ|, which is −F u_t/|u_t| where it moves. So a point that
//! slides while its foot is held by others has a direction too.

use super::guess::{along, direction, length};
use super::{MOST_DIRECTIONS, Mode, SLOTS, jacobian_rows};
use crate::lanes::{Isa, Real};
use crate::model::{GroundLaw, Model, body_size};
use crate::state::Block;

/// Adhesion is at most this multiple of the normal impulse. The paper's D_f is there however lightly a point touches
/// and gone where it does not: where its lever lifts the point, neither holds. So it fades within the last
/// fraction of a millinewton.
const GRAZE: f64 = 4.0;

/// Friction and penalty of each lane in one step.
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
    /// w [kg].
    pub weight: F,
    /// Impulse below which changes do not matter [N·s].
    pub negligible: F,
    /// Speed below which an open point does not sink [m/s]: what a closed one beside it may still be off.
    pub slack: F,
}

impl<F: Real> Ground<F> {
    /// μ λ_n + D_f Δt, the greatest tangential impulse.
    #[inline(always)]
    pub(super) fn friction(&self, coefficient: F, normal: F) -> F {
        coefficient * normal + self.adhesion.min(normal * GRAZE)
    }

    /// The law in the lanes of a block.
    #[inline(always)]
    pub fn new(law: &GroundLaw, static_factor: F, dynamic_factor: F, dt: f64) -> Self {
        let one = static_factor.splat(1.0);
        let static_friction = static_factor * law.static_friction;
        Self {
            static_friction,
            // Varied on its own it could exceed the static one, which has no meaning.
            dynamic_friction: (dynamic_factor * law.dynamic_friction).min(static_friction),
            adhesion: one * (law.adhesion_n * dt),
            transition_speed: one * law.transition_speed_m_s,
            weight: one * law.weight_kg,
            // A ten-millionth of a node's weight over the step.
            negligible: one * (law.node_mass_kg * 1e-7 * 9.81 * dt),
            // The penalty's residual under ten times a node's weight.
            slack: one * (law.node_mass_kg * 10.0 * 9.81 * dt / law.weight_kg),
        }
    }
}

/// A contact point after a pass, under the mode it was assumed in.
pub(super) struct Point<F> {
    pub(super) mode: F,
    /// λ_n if it was closed.
    pub(super) normal: F,
    /// λ_n that bounds friction.
    pub(super) bound: F,
    /// λ_t if it was sticking.
    pub(super) held: [F; 2],
    /// λ_n that friction reckoned with.
    pub(super) reckoned: F,
    /// μ of this step.
    pub(super) coefficient: F,
    /// d that friction reckoned with.
    pub(super) slip: [F; 2],
    pub(super) u_n: F,
    pub(super) u_t: [F; 2],
}

/// Mode, impulses and direction of sliding that the laws ask for.
pub(super) struct After<F> {
    pub(super) mode: F,
    pub(super) normal: F,
    pub(super) tangential: [F; 2],
    pub(super) slip: [F; 2],
}

impl<F: Real> Point<F> {
    #[inline(always)]
    pub(super) fn found<const W: usize, const D: usize, I: Isa<W, F = F, M = F::Mask>>(
        isa: I,
        model: &Model,
        ground: &Ground<F>,
        block: &Block<W>,
        c: usize,
        frozen: bool,
    ) -> Self {
        let stencil = &model.contacts[c].stencil;
        let zero = isa.splat(0.0);
        let mut rows = [[zero; SLOTS]; MOST_DIRECTIONS];
        jacobian::<W, D, I>(isa, block, c, &mut rows);
        let mut u = [zero; MOST_DIRECTIONS];
        for slot in 0..stencil.count {
            let velocity = isa.load(&block.next[stencil.dofs[slot]]);
            for direction in 0..D {
                u[direction] = u[direction] + rows[direction][slot] * velocity;
            }
        }
        let u_n = u[0] + isa.load(&block.approach[c]);
        let (mut u_t, mut held) = ([zero; 2], [zero; 2]);
        for t in 0..D - 1 {
            u_t[t] = u[1 + t];
            held[t] = isa.load(&block.warm[D * c + 1 + t]) - ground.weight * u_t[t];
        }
        let normal = isa.load(&block.warm[D * c]) - ground.weight * u_n;
        let reckoned = isa.load(&block.reckoned[c]);
        Self {
            mode: isa.load(&block.mode[c]),
            normal,
            bound: if frozen { reckoned } else { normal.max(isa.splat(0.0)) },
            held,
            reckoned,
            coefficient: isa.load(&block.coefficient[c]),
            slip: load2::<W, D, I>(isa, &block.slip, (D - 1) * c),
            u_n,
            u_t,
        }
    }

    #[inline(always)]
    pub(super) fn after<const W: usize, const D: usize, I: Isa<W, F = F, M = F::Mask>>(
        &self,
        isa: I,
        ground: &Ground<F>,
    ) -> After<F> {
        let zero = isa.splat(0.0);
        let (open, stick) = (isa.splat(Mode::OPEN), isa.splat(Mode::STICK));
        let slide = isa.splat(Mode::SLIDE);
        let is_open = self.mode.eq(open);
        let is_stuck = self.mode.eq(stick);

        // Open points: close where they would sink, sticking if slow.
        let sinks = self.u_n.lt(-ground.slack);
        let slow = length::<F, D>(self.u_t).le(ground.transition_speed);
        let from_open = F::select(sinks, F::select(slow, stick, slide), open);

        // Closed points: open where they would pull, else hold or slide. Friction opposes sliding.
        let normal = self.normal.max(zero);
        let limit = ground.friction(self.coefficient, self.bound);
        let grip = length::<F, D>(self.held);
        let slips = grip.gt(limit);
        let from_stick = F::select(slips, slide, stick);
        let pushed = direction::<F, D>([-self.held[0], -self.held[1]]);
        let reverses = along::<F, D>(pushed, self.slip).lt(zero) | !slips;
        let from_slide = F::select(reverses, stick, slide);
        let pulls = self.normal.lt(zero);
        let from_closed = F::select(pulls, open, F::select(is_stuck, from_stick, from_slide));

        let mode = F::select(is_open, from_open, from_closed);
        let normal = F::select(is_open, zero, normal);
        let friction = limit;
        let landing = direction::<F, D>(self.u_t);
        // Within the cone even where the passes run out: the next step starts from it.
        let within = if D == 2 { F::select(slips, limit, grip) } else { limit / grip.max(limit) };
        let mut after = After { mode, normal, tangential: [zero; 2], slip: [zero; 2] };
        for t in 0..D - 1 {
            after.slip[t] = F::select(is_open, landing[t], pushed[t]);
            let held = if D == 2 { -(within * pushed[t]) } else { self.held[t] * within };
            let sliding = -(friction * after.slip[t]);
            let tangential = F::select(mode.eq(stick), held, sliding);
            after.tangential[t] = F::select(mode.eq(open) | is_open, zero, tangential);
        }
        after
    }
}

/// The rows of a contact's Jacobian: normal, then along x, in space along z.
#[inline(always)]
pub(super) fn jacobian<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    contact: usize,
    rows: &mut [[I::F; SLOTS]; MOST_DIRECTIONS],
) {
    let first = jacobian_rows(D) * contact;
    let stored = &block.jacobian[first..first + jacobian_rows(D)];
    for direction in 0..D {
        for slot in 0..body_size(D) {
            rows[direction][slot] = isa.load(&stored[body_size(D) * direction + slot]);
        }
    }
}

/// A vector along the ground: D − 1 rows.
#[inline(always)]
pub(super) fn load2<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    rows: &[[f64; W]],
    first: usize,
) -> [I::F; 2] {
    let second = if D == 3 { isa.load(&rows[first + 1]) } else { isa.splat(0.0) };
    [isa.load(&rows[first]), second]
}
