//! Static friction that gives way within a step.
//!
//! The paper's coefficient falls from μ_s to μ_d as a point passes v_d. The speed at the start of a step decides which one
//! holds in it, so a point at rest that is thrown to u in a step would be held by μ_s for the whole of it. Its speed
//! grows evenly, so it is below v_d for the share (v_d − u⁰)/(u − u⁰) of the step; the mean coefficient follows.

use super::guess::length;
use super::law::Ground;
use super::points::start_velocity;
use super::{Mode, load_vector, store_where};
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Gives points that passed v_d in the solution of this step their mean coefficient; the lanes where there are any.
#[inline(always)]
pub(super) fn weaken<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    mask: I::M,
) -> I::M {
    let (limit, lost) = (ground.transition_speed, ground.static_friction - ground.dynamic_friction);
    let mut somewhere = limit.lt(limit);
    for (c, contact) in model.contacts.iter().enumerate() {
        let start = start_velocity::<D, I>(isa, block, c, contact);
        let end = load_vector::<D, I>(isa, &block.contact.velocity, c);
        let before = length::<I::F, D>([start[1], start[2]]);
        let after = length::<I::F, D>([end[1], end[2]]);
        let slides = isa.load(&block.mode[c]).eq(isa.splat(Mode::SLIDE));
        let passes = mask & slides & before.le(limit) & after.gt(limit);
        let gain = I::F::select(passes, after - before, limit);
        let mean = ground.dynamic_friction + lost * ((limit - before) / gain);
        store_where(isa, passes, mean, &mut block.contact.coefficient[c]);
        somewhere = somewhere | passes;
    }
    somewhere
}
