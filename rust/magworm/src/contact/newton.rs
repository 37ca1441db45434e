//! One iteration of Newton and its line search: a direction, trials along it, and the law linearised where one is taken.

use super::guess::along;
use super::law::{Ground, Point, Response};
use super::points::point_velocity;
use super::search::Search;
use super::system::add_force;
use super::{Mode, Workspace, load_vector, store_vector, store_where};
use crate::lanes::{Isa, Mask, Number, Real};
use crate::model::Model;
use crate::state::Block;

/// Before the first iteration: nothing moves, and nothing is known.
#[inline(always)]
pub(super) fn start<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (zero, one) = (isa.splat(0.0), isa.splat(1.0));
    let kept = model.system.kept();
    let symmetric = model.system.kept_entries(&block.matrix);
    let work = &mut block.contact;
    let (mobilities, imbalance) = (&mut *work.mobility, &mut *work.imbalance);
    let (known, rights) = (&mut *work.known, &*block.right);
    let mut size = zero;
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        let right = isa.load(&rights[unknown]);
        let diagonal = isa.load(&symmetric[kept.at(row, row)]);
        // Multipliers have no mass; each system of theirs is solved as it is.
        let heavy = diagonal.gt(zero);
        let mobility = I::F::select(heavy, one / I::F::select(heavy, diagonal, one), zero);
        isa.store(mobility, &mut mobilities[row]);
        isa.store(-right, &mut imbalance[row]);
        isa.store(zero, &mut known[row]);
        size = size + right * right * mobility;
    }
    for c in 0..model.contacts.len() {
        let velocity = load_vector::<D, I>(isa, &work.bias, c);
        store_vector::<D, I>(isa, zero.eq(zero), &velocity, &mut work.velocity, c);
    }
    Search::new(size * (<I::F as Real>::Number::RESIDUAL * <I::F as Real>::Number::RESIDUAL))
        .store(isa, &mut work.search);
}

/// A new direction in the lanes of a mask, to the solution of the linearised system, and what changes along it.
#[inline(always)]
pub(super) fn turn<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    mask: I::M,
) {
    let kept = model.system.kept();
    let ghosts = kept.half_bandwidth();
    let work = &mut block.contact;
    let size = kept.size();
    let (target, known) = (&work.target[ghosts..][..size], &work.known[..size]);
    let direction = &mut work.direction[..size];
    for row in 0..size {
        let change = isa.load(&target[row]) - isa.load(&known[row]);
        store_where(isa, mask, change, &mut direction[row]);
    }
    kept.multiply(
        isa,
        model.system.kept_entries(&block.matrix),
        &work.direction,
        &mut work.imbalance_change,
    );
    for (c, contact) in model.contacts.iter().enumerate() {
        let arm = load_vector::<D, I>(isa, &work.arm, c);
        let change =
            point_velocity::<D, I>(isa, &work.direction, contact.place, contact.rigid, &arm);
        store_vector::<D, I>(isa, mask, &change, &mut work.velocity_change, c);
    }
}

/// One trial in the lanes that are left; which of them took it.
#[inline(always)]
pub(super) fn attempt<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    left: I::M,
    bounded: bool,
) -> I::M {
    let mut search = Search::load(isa, &block.contact.search);
    let step = search.step;
    let found = residual::<D, I>(isa, model, ground, block, step, bounded);
    let taken = search.judge(found) & left;
    search.store(isa, &mut block.contact.search);
    if taken.any() {
        advance(isa, block, step, taken);
        for c in 0..model.contacts.len() {
            linearise::<D, I>(isa, ground, block, c, taken, bounded);
        }
    }
    taken
}

/// |S v − s − Jᵀ λ|² at a step along the direction.
#[inline(always)]
fn residual<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    step: I::F,
    bounded: bool,
) -> I::F {
    let work = &mut block.contact;
    free_residual(isa, work, step);
    for (c, contact) in model.contacts.iter().enumerate() {
        let mut u = load_vector::<D, I>(isa, &work.velocity, c);
        let change = load_vector::<D, I>(isa, &work.velocity_change, c);
        for k in 0..D {
            u[k] = u[k] + change[k] * step;
        }
        let point = point::<D, I>(isa, work, c);
        let [up, x, z] = point.impulse::<D>(ground, &u, bounded).impulse;
        let arm = load_vector::<D, I>(isa, &work.arm, c);
        let rows = &mut work.residual[contact.place..];
        add_force::<D, I>(isa, rows, contact.rigid, &arm, &[-x, -up, -z]);
    }
    size_of_residual(isa, work)
}

/// |r|² in the metric of 1/diag S.
#[inline(always)]
pub(super) fn size_of_residual<I: Isa>(isa: I, work: &Workspace<I::Row>) -> I::F {
    let residuals = &*work.residual;
    let mobilities = &work.mobility[..residuals.len()];
    let mut sum = isa.splat(0.0);
    for row in 0..residuals.len() {
        let residual = isa.load(&residuals[row]);
        sum = sum + residual * residual * isa.load(&mobilities[row]);
    }
    sum
}

/// S v − s at a step along the direction.
#[inline(always)]
pub(super) fn free_residual<I: Isa>(isa: I, work: &mut Workspace<I::Row>, step: I::F) {
    let residuals = &mut *work.residual;
    let imbalance = &work.imbalance[..residuals.len()];
    let changes = &work.imbalance_change[..residuals.len()];
    for row in 0..residuals.len() {
        let change = isa.load(&changes[row]) * step;
        isa.store(isa.load(&imbalance[row]) + change, &mut residuals[row]);
    }
}

/// Goes a step along the direction in the lanes of a mask.
#[inline(always)]
fn advance<I: Isa>(isa: I, block: &mut Block<I::Row>, step: I::F, mask: I::M) {
    let work = &mut block.contact;
    follow(isa, &mut work.known, &work.direction, step, mask);
    follow(isa, &mut work.imbalance, &work.imbalance_change, step, mask);
    follow(isa, &mut work.velocity, &work.velocity_change, step, mask);
}

/// Adds a step along changes in the lanes of a mask.
#[inline(always)]
pub(super) fn follow<I: Isa>(
    isa: I,
    rows: &mut [I::Row],
    changes: &[I::Row],
    step: I::F,
    mask: I::M,
) {
    let changes = &changes[..rows.len()];
    for k in 0..rows.len() {
        let next = isa.load(&rows[k]) + isa.load(&changes[k]) * step;
        store_where(isa, mask, next, &mut rows[k]);
    }
}

/// Impulses, mode and response of a point at its velocity, in the lanes of a mask.
#[inline(always)]
fn linearise<const D: usize, I: Isa>(
    isa: I,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    c: usize,
    mask: I::M,
    bounded: bool,
) {
    let u = load_vector::<D, I>(isa, &block.contact.velocity, c);
    let bias = load_vector::<D, I>(isa, &block.contact.bias, c);
    let point = point::<D, I>(isa, &block.contact, c);
    let found = point.impulse::<D>(ground, &u, bounded);
    // What slid the other way passed the place where it sticks.
    let slip = &mut block.contact.slip;
    let before = [isa.load(&slip[2 * c]), isa.load(&slip[2 * c + 1])];
    let turned = along::<I::F, D>(found.pushed, before).lt(isa.splat(0.0));
    let slid = isa.load(&block.mode[c]).eq(isa.splat(Mode::SLIDE));
    let passed = slid & found.slides & turned;
    for k in 0..2 {
        store_where(isa, mask, found.pushed[k], &mut slip[2 * c + k]);
    }
    store_where(isa, mask, found.mode(), &mut block.mode[c]);
    store_where(isa, mask, found.impulse[0], &mut block.normal[c]);
    for t in 1..D {
        // The pad gives by (λ⁰ − λ)/w; what its spring holds then remains for the next step.
        let given = (point.warm[t] - found.impulse[t]) * ground.viscous_share;
        let held = found.impulse[t] + given;
        store_where(isa, mask, held, &mut block.pad[(D - 1) * c + t - 1]);
    }
    let response = Response::at::<D>(&point, ground, &found, &u, &bias, bounded, passed);
    response.store(isa, mask, &mut block.contact.response, c);
}

#[inline(always)]
fn point<const D: usize, I: Isa>(isa: I, work: &Workspace<I::Row>, c: usize) -> Point<I::F> {
    Point {
        warm: load_vector::<D, I>(isa, &work.warm, c),
        coefficient: isa.load(&work.coefficient[c]),
        bound: isa.load(&work.bound[c]),
    }
}
