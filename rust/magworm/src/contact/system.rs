//! The linear system of one iteration of Newton: (S + Jᵀ C J) v = s + Jᵀ f with the impulses f − C u of all points.
//!
//! A point at arm r of its body moves with V + ω × r, so a force at it is a torque r × f, and its block of the
//! matrix follows from cross products alone.

use super::law::Response;
use super::load_vector;
use crate::elastic::cross;
use crate::lanes::{Isa, Real, unsymmetric};
use crate::model::{Model, body_size};
use crate::state::Block;

/// Solves the system into `contact.target`.
pub(super) fn solve_linearised<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
) {
    copy(isa, model, block);
    isa.vectorize(
        #[inline(always)]
        || add_responses::<D, I>(isa, model, block),
    );
    eliminate(isa, model, block);
}

/// The same where no point responds: S v = s.
pub(super) fn solve_free<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    copy(isa, model, block);
    eliminate(isa, model, block);
}

fn copy<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let band = model.system.kept();
    let symmetric = model.system.kept_entries(&block.matrix);
    unsymmetric::expand(isa, band, symmetric, &mut block.contact.matrix);
    let ghosts = band.half_bandwidth();
    for (row, &unknown) in model.system.unknowns().iter().enumerate() {
        block.contact.target[ghosts + row] = block.right[unknown];
    }
}

fn eliminate<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (band, body) = (model.system.kept(), model.system.body());
    unsymmetric::solve(isa, band, body, &mut block.contact.matrix, &mut block.contact.target);
    block.counters.factorisations += 1;
}

#[inline(always)]
fn add_responses<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let band = model.system.kept();
    let ghosts = band.half_bandwidth();
    for (c, contact) in model.contacts.iter().enumerate() {
        let response = Response::load(isa, &block.contact.response, c);
        let arm = load_vector::<D, I>(isa, &block.contact.arm, c);
        let place = unsymmetric::at(band, contact.place, contact.place);
        let matrix = &mut block.contact.matrix;
        let right = &mut block.contact.target[ghosts + contact.place..];
        let f = [response.force[1], response.force[0], response.force[2]];
        add_force::<D, I>(isa, right, contact.rigid, &arm, &f);
        let stride = unsymmetric::row_length(ghosts) - 1;
        add_block::<D, I>(isa, matrix, [place, stride], contact.rigid, &arm, &columns(&response));
    }
}

/// Columns of C along x, y, z.
#[inline(always)]
fn columns<F: Real>(response: &Response<F>) -> [[F; 3]; 3] {
    let zero = response.normal.splat(0.0);
    let [xx, xz, zz] = response.along;
    let [drag_x, drag_z] = response.drag;
    [[xx, zero, xz], [drag_x, response.normal, drag_z], [xz, zero, zz]]
}

/// Adds the force at a point to the rows of its body.
#[inline(always)]
pub(super) fn add_force<const D: usize, I: Isa>(
    isa: I,
    rows: &mut [I::Row],
    rigid: bool,
    arm: &[I::F; 3],
    force: &[I::F; 3],
) {
    let rows = &mut rows[..if rigid { body_size(D) } else { D }];
    for axis in 0..D {
        add(isa, &mut rows[axis], force[axis]);
    }
    if rigid && D == 2 {
        add(isa, &mut rows[2], arm[0] * force[1] - arm[1] * force[0]);
    } else if rigid {
        let torque = cross(arm, force);
        for axis in 0..3 {
            add(isa, &mut rows[3 + axis], torque[axis]);
        }
    }
}

/// Adds Jᵀ C J to the rows of a body: entry (i, j) stands at `place` + i · stride + j.
#[inline(always)]
fn add_block<const D: usize, I: Isa>(
    isa: I,
    matrix: &mut [I::Row],
    [place, stride]: [usize; 2],
    rigid: bool,
    arm: &[I::F; 3],
    columns: &[[I::F; 3]; 3],
) {
    for row in 0..D {
        let entries = &mut matrix[place + row * stride..][..D];
        for column in 0..D {
            add(isa, &mut entries[column], columns[column][row]);
        }
    }
    if !rigid {
        return;
    }
    if D == 2 {
        let [x, y] = [columns[0], columns[1]];
        let turned = [y[0] * arm[0] - x[0] * arm[1], y[1] * arm[0] - x[1] * arm[1], arm[2]];
        let forces = [x, y, turned];
        for column in 0..3 {
            let torque = arm[0] * forces[column][1] - arm[1] * forces[column][0];
            add(isa, &mut matrix[place + 2 * stride + column], torque);
        }
        for row in 0..2 {
            add(isa, &mut matrix[place + row * stride + 2], turned[row]);
        }
        return;
    }
    // C G with G ω = ω × r: its row a is r × (row a of C).
    let mut turned = [[arm[0]; 3]; 3];
    for row in 0..3 {
        let along = cross(arm, &[columns[0][row], columns[1][row], columns[2][row]]);
        for column in 0..3 {
            turned[column][row] = along[column];
        }
    }
    for row in 0..3 {
        let of_force = &mut matrix[place + row * stride + 3..][..3];
        for column in 0..3 {
            add(isa, &mut of_force[column], turned[column][row]);
        }
        let of_torque = &mut matrix[place + (3 + row) * stride..][..6];
        for column in 0..3 {
            add(isa, &mut of_torque[column], cross(arm, &columns[column])[row]);
            add(isa, &mut of_torque[3 + column], cross(arm, &turned[column])[row]);
        }
    }
}

#[inline(always)]
fn add<I: Isa>(isa: I, entry: &mut I::Row, value: I::F) {
    isa.store(isa.load(entry) + value, entry);
}
