//! Semismooth Newton's iteration for the velocities of the bodies (Alart & Curnier 1991):
//!
//! ```text
//! r(v) = S v − s − Jᵀ λ(J v + û) = 0
//! (S + Jᵀ C J) v* = s + Jᵀ λ*,   d = v* − v,   v ← v + t d
//! ```
//!
//! λ is piecewise smooth, and C belongs to the piece where the iteration stands. r and u are linear in t but for λ, so their
//! changes along d are computed once a direction, and a trial costs no product with a matrix.

use super::hessian::ContactHessian;
use super::law::{ContactLaw, ContactLaws, FrictionLaw, PointState};
use super::line_search::LineSearch;
use super::touch::Touch;
use super::{ContactMode, ContactVector, Workspace, store_where};
use crate::lanes::{Components, Dim, Isa, Mask, Number, Real};
use crate::model::Model;
use crate::state::Block;

/// What a trial came to, in the lanes that made it. All others shorten their step.
pub(super) struct TrialStatus<M> {
    /// Found a solution.
    pub(super) converged: M,
    /// Accepted the trial and want a new direction.
    pub(super) accepted: M,
}

/// Starts from v = 0, where r = −s and u = û. The full step of the first direction is accepted.
#[inline(always)]
pub(super) fn begin<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (zero, one) = (isa.splat(0.0), isa.splat(1.0));
    let kept = model.system.kept();
    let symmetric = model.system.kept_entries(&block.matrix);
    let work = &mut block.contact;
    let (inverses, residuals) = (&mut *work.inverse_diagonal, &mut *work.free_residual);
    let (iterate, rhs) = (&mut *work.iterate, &*block.rhs);
    let mut size = zero;
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        let entry = isa.load(&rhs[unknown]);
        let diagonal = isa.load(&symmetric[kept.at(row, row)]);
        // Multipliers have no mass; each of their equations is solved exactly.
        let heavy = diagonal.gt(zero);
        let inverse = I::F::select(heavy, one / I::F::select(heavy, diagonal, one), zero);
        isa.store(inverse, &mut inverses[row]);
        isa.store(-entry, &mut residuals[row]);
        isa.store(zero, &mut iterate[row]);
        size = size + entry * entry * inverse;
    }
    for c in 0..model.contacts.len() {
        let bias = ContactVector::<D, I::F>::load(isa, &work.bias, c);
        bias.store(isa, &mut work.velocity, c);
    }
    let relative = <I::F as Real>::Number::RESIDUAL;
    LineSearch::new(size * (relative * relative)).store(isa, &mut work.line_search);
}

/// Newton's direction in the lanes of a mask, from the solution of the linearised system, and what changes along it.
#[inline(always)]
pub(super) fn newton_direction<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    mask: I::M,
) {
    let kept = model.system.kept();
    let (ghosts, size) = (kept.half_bandwidth(), kept.size());
    let work = &mut block.contact;
    let (solution, iterate) = (&work.solution[ghosts..][..size], &work.iterate[..size]);
    let direction = &mut work.direction[..size];
    for row in 0..size {
        let change = isa.load(&solution[row]) - isa.load(&iterate[row]);
        store_where(isa, mask, change, &mut direction[row]);
    }
    let symmetric = model.system.kept_entries(&block.matrix);
    kept.multiply(isa, symmetric, &work.direction, &mut work.free_residual_change);
    for (c, pair) in model.contacts.iter().enumerate() {
        let change = Touch::<D, I::F>::meet(
            isa,
            work,
            c,
            pair,
            #[inline(always)]
            |touch, work| touch.velocity(isa, &work.direction, pair.rows()),
        );
        change.store_where(isa, mask, &mut work.velocity_change, c);
    }
}

/// One trial of the line search in the lanes of a mask. Where it is accepted, v goes there and the law is linearised anew.
#[inline(always)]
pub(super) fn line_search_trial<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    friction: FrictionLaw,
    block: &mut Block<I::Row>,
    mask: I::M,
) -> TrialStatus<I::M> {
    let mut search = LineSearch::load(isa, &block.contact.line_search);
    let step = search.step;
    let found = residual_at::<D, I>(isa, model, laws, friction, block, step);
    let accepted = search.judge(found) & mask;
    search.store(isa, &mut block.contact.line_search);
    if accepted.any() {
        take_step(isa, &mut block.contact, step, accepted);
        for (c, pair) in model.contacts.iter().enumerate() {
            linearise_point::<D, I>(isa, laws.of(pair), friction, block, c, accepted);
        }
    }
    let converged = accepted & search.converged();
    TrialStatus { converged, accepted: accepted & !converged }
}

/// |r(v + t d)|².
#[inline(always)]
fn residual_at<D: Dim, I: Isa>(
    isa: I,
    model: &Model,
    laws: &ContactLaws<I::F>,
    friction: FrictionLaw,
    block: &mut Block<I::Row>,
    step: I::F,
) -> I::F {
    let work = &mut block.contact;
    contact_free_residual(isa, work, step);
    for (c, pair) in model.contacts.iter().enumerate() {
        let velocity = ContactVector::<D, I::F>::load(isa, &work.velocity, c);
        let change = ContactVector::<D, I::F>::load(isa, &work.velocity_change, c);
        let law = laws.of(pair);
        let point = load_point::<D, I>(isa, law, work, c);
        let found = point.impulse(law, friction, velocity + change * step);
        Touch::<D, I::F>::meet(
            isa,
            work,
            c,
            pair,
            #[inline(always)]
            |touch, work| {
                touch.add_impulse(isa, &mut work.residual, pair.rows(), -found.impulse);
            },
        );
    }
    residual_squared(isa, work)
}

/// |r|² in the metric of 1/diag S.
#[inline(always)]
pub(super) fn residual_squared<I: Isa>(isa: I, work: &Workspace<I::Row>) -> I::F {
    let residuals = &*work.residual;
    let inverses = &work.inverse_diagonal[..residuals.len()];
    let mut sum = isa.splat(0.0);
    for row in 0..residuals.len() {
        let residual = isa.load(&residuals[row]);
        sum = sum + residual * residual * isa.load(&inverses[row]);
    }
    sum
}

/// r = S (v + t d) − s, without contacts.
#[inline(always)]
pub(super) fn contact_free_residual<I: Isa>(isa: I, work: &mut Workspace<I::Row>, step: I::F) {
    let residuals = &mut *work.residual;
    let starts = &work.free_residual[..residuals.len()];
    let changes = &work.free_residual_change[..residuals.len()];
    for row in 0..residuals.len() {
        let change = isa.load(&changes[row]) * step;
        isa.store(isa.load(&starts[row]) + change, &mut residuals[row]);
    }
}

/// v ← v + t d in the lanes of a mask, and all that is linear in v.
#[inline(always)]
fn take_step<I: Isa>(isa: I, work: &mut Workspace<I::Row>, step: I::F, mask: I::M) {
    axpy(isa, step, &work.direction, &mut work.iterate, mask);
    axpy(isa, step, &work.free_residual_change, &mut work.free_residual, mask);
    axpy(isa, step, &work.velocity_change, &mut work.velocity, mask);
}

/// y ← y + t x in the lanes of a mask.
#[inline(always)]
pub(super) fn axpy<I: Isa>(isa: I, t: I::F, x: &[I::Row], y: &mut [I::Row], mask: I::M) {
    let x = &x[..y.len()];
    for k in 0..y.len() {
        let next = isa.load(&y[k]) + isa.load(&x[k]) * t;
        store_where(isa, mask, next, &mut y[k]);
    }
}

/// Impulse, mode and linearised law of a point at its velocity, in the lanes of a mask.
#[inline(always)]
fn linearise_point<D: Dim, I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    friction: FrictionLaw,
    block: &mut Block<I::Row>,
    c: usize,
    mask: I::M,
) {
    let u = ContactVector::<D, I::F>::load(isa, &block.contact.velocity, c);
    let bias = ContactVector::load(isa, &block.contact.bias, c);
    let point = load_point::<D, I>(isa, law, &block.contact, c);
    let found = point.impulse(law, friction, u);
    // A point whose friction turned round while it slid has passed the velocity at which it sticks.
    let directions = &mut block.contact.friction_direction[D::TANGENTS * c..];
    let reverses = found.direction.dot(D::Tangent::load(isa, directions)).lt(isa.splat(0.0));
    let slid = isa.load(&block.contact_mode[c]).eq(isa.splat(ContactMode::Slide.code()));
    let stick = slid & found.sliding & reverses;
    found.direction.store_where(isa, mask, directions);
    store_where(isa, mask, found.mode(), &mut block.contact_mode[c]);
    store_where(isa, mask, found.impulse.normal, &mut block.normal_impulse[c]);
    // The damper holds its share of λ⁰ − λ in this step only; the spring keeps the rest for the next.
    let (before, after) = (point.warm_start.tangent, found.impulse.tangent);
    let spring = after + (before - after) * law.damper_share;
    spring.store_where(isa, mask, &mut block.tangential_spring[D::TANGENTS * c..]);
    let hessian = ContactHessian::linearise(&point, law, friction, &found, [u, bias], stick);
    hessian.store_where(isa, mask, &mut block.contact.hessian, c);
}

#[inline(always)]
pub(super) fn load_point<D: Dim, I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    work: &Workspace<I::Row>,
    c: usize,
) -> PointState<D, I::F> {
    PointState {
        normal_mass: normal_mass(isa, law, work, c),
        warm_start: ContactVector::load(isa, &work.warm_start, c),
        coefficient: isa.load(&work.friction_coefficient[c]),
        bound: isa.load(&work.friction_bound[c]),
    }
}

/// Effective mass of a point along the normal [kg].
#[inline(always)]
pub(super) fn normal_mass<I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    work: &Workspace<I::Row>,
    c: usize,
) -> I::F {
    match work.impact_mass.get(c) {
        Some(row) => law.effective_mass.max(isa.load(row)),
        None => law.effective_mass,
    }
}
