//! The linear system of one Newton iteration: (S + Jᵀ C J) v = s + Jᵀ λ*, with λ* and C of all points.

use super::hessian::ContactHessian;
use super::touch::Touch;
use crate::lanes::{Dim, Isa, unsymmetric};
use crate::model::Model;
use crate::state::Block;

/// Solves the system into `contact.solution`.
pub(super) fn solve_linearised<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    copy(isa, model, block);
    isa.vectorize(
        #[inline(always)]
        || add_contacts::<D, I>(isa, model, block),
    );
    eliminate(isa, model, block);
}

/// Solves the system without contacts, S v = s.
pub(super) fn solve_contact_free<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    copy(isa, model, block);
    eliminate(isa, model, block);
}

fn copy<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let band = model.system.kept();
    let symmetric = model.system.kept_entries(&block.matrix);
    unsymmetric::expand(isa, band, symmetric, &mut block.contact.matrix);
    let ghosts = band.half_bandwidth();
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        block.contact.solution[ghosts + row] = block.rhs[unknown];
    }
}

fn eliminate<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (band, body) = (model.system.kept(), model.system.body());
    unsymmetric::solve(isa, band, body, &mut block.contact.matrix, &mut block.contact.solution);
    block.counters.factorisations += 1;
}

#[inline(always)]
fn add_contacts<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let band = model.system.kept();
    let ghosts = band.half_bandwidth();
    for (c, pair) in model.contacts.iter().enumerate() {
        let hessian = ContactHessian::<D, I::F>::load(isa, &block.contact.hessian, c);
        Touch::<D, I::F>::meet(
            isa,
            &mut block.contact,
            c,
            pair,
            #[inline(always)]
            |touch, work| {
                let rhs = &mut work.solution[ghosts..];
                touch.add_impulse(isa, rhs, pair.rows(), hessian.impulse);
                touch.add_hessian(isa, &mut work.matrix, band, pair.rows(), &hessian);
            },
        );
    }
}
