//! Time integration: the equations of one step, A v⁺ = b, for two schemes behind one shape.
//!
//! Both are solved by the same banded factorisation and the same contact solve; they differ in their
//! unknowns and in what goes into A.

mod explicit;
mod implicit;
mod loads;

use crate::elastic::{self, Scheme};
use crate::lanes::Isa;
use crate::model::Model;
use crate::scene::{Integrator, Parameter};
use crate::state::Block;

/// Assembles matrix and right-hand side of a step, without contacts.
#[inline(always)]
pub fn assemble<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    block.matrix.fill([0.0; W]);
    inertia(isa, model, block);
    loads::gravity(isa, model, block);
    loads::magnets(isa, model, block);
    let scheme = scheme(isa, model, block);
    match model.scene.solver.integrator {
        Integrator::Implicit => implicit::assemble(isa, model, block, scheme),
        Integrator::Explicit => explicit::assemble(isa, model, block, scheme),
    }
}

/// M on the left, M v on the right.
#[inline(always)]
fn inertia<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    for dof in 0..model.coordinates.count {
        let mass = isa.load(&block.mass[dof]);
        isa.store(mass, &mut block.matrix[model.band.at(dof, dof)]);
        isa.store(mass * isa.load(&block.v[dof]), &mut block.right[dof]);
    }
}

#[inline(always)]
fn scheme<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &Block<W>) -> Scheme<I::F> {
    let factor = |parameter: Parameter| isa.load(&block.factors[parameter as usize]);
    Scheme {
        stiffness: factor(Parameter::Stiffness),
        damping_s: factor(Parameter::Damping) * model.scene.material.damping_time_s,
        dt: model.step_s,
        implicit: model.scene.solver.integrator == Integrator::Implicit,
    }
}

/// Adds the springs of the rod.
#[inline(always)]
fn springs<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    scheme: Scheme<I::F>,
) {
    elastic::stretch(isa, model, block, scheme);
    elastic::bend(isa, model, block, scheme);
}
