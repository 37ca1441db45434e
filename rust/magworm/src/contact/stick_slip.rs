//! The transition from static to dynamic friction within a step.
//!
//! ```text
//! μ = μ_d + (μ_s − μ_d) (v_d − |u⁰|)/(|u| − |u⁰|)
//! ```
//!
//! The speed |u⁰| at the start of a step decides whether μ_s or μ_d holds in it. A point at rest that is accelerated beyond v_d
//! would be held by μ_s for the whole step. Its speed grows evenly, so it is below v_d for the share of the step above, and
//! the step is solved again with the mean coefficient.

use super::law::ContactLaws;
use super::touch::start_velocity;
use super::{ContactMode, ContactVector, store_where};
use crate::lanes::{Dim, Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Gives the points that passed v_d in the solution of this step their mean coefficient; the lanes that have any.
#[inline(always)]
pub(super) fn stick_slip_transition<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
) -> I::M {
    let law = &laws.ground;
    let (limit, drop) = (law.transition_speed, law.static_friction - law.dynamic_friction);
    let mut any = limit.lt(limit);
    let on_ground =
        model.contacts.iter().enumerate().filter(|(_, pair)| pair.surface_body.is_none());
    for (c, pair) in on_ground {
        let before = D::length(start_velocity::<D, I>(isa, block, c, pair).tangent);
        let end = ContactVector::<D, I::F>::load(isa, &block.contact.velocity, c);
        let after = D::length(end.tangent);
        let slides = isa.load(&block.contact_mode[c]).eq(isa.splat(ContactMode::Slide.code()));
        let passes = mask & slides & before.le(limit) & after.gt(limit);
        let gain = I::F::select(passes, after - before, limit);
        let mean = law.dynamic_friction + drop * ((limit - before) / gain);
        store_where(isa, passes, mean, &mut block.contact.friction_coefficient[c]);
        any = any | passes;
    }
    any
}
