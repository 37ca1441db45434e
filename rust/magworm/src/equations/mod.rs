//! The equations of one step, A v⁺ = b:
//!
//! ```text
//! (M + Δt b Σ k g gᵀ) v⁺ = M v + Δt (F − Σ k (s + a g·v) g),   q⁺ = q + Δt v⁺
//! ```
//!
//! with strains s, gradients g and forces F at q, and the a and b of the integrator, see [`crate::integrate`]; branches of rubber
//! that relaxes add to s, a and b. All
//! integrators are solved by the same banded factorisation and the same contact solve.

mod hold;
mod loads;
mod mutual;
mod off_centre;
mod ties;

use crate::elastic::{self, Rod, Scheme};
use crate::lanes::Isa;
use crate::model::Model;
use crate::scene::Parameter;
use crate::state::Block;

pub use loads::{gravity, magnets};
pub use mutual::{Cuboids, mutual};
pub use off_centre::carry;

/// Begins matrix and right-hand side of a step: inertia alone.
#[inline(always)]
pub fn inertia<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    model.system.clear(isa, &mut block.matrix);
    diagonal_inertia(isa, model, block);
    D::rotary_inertia(isa, model, block);
    off_centre::inertia::<D, I>(isa, model, block);
}

/// Adds the springs of the rod, and the multipliers where magnets are held by them.
#[inline(always)]
pub fn springs<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let scheme = scheme(isa, model, block);
    elastic::stretch::<D, I>(isa, model, block, scheme);
    D::bend(isa, model, block, scheme);
    ties::constrain::<D, I>(isa, model, block);
}

/// M on the left, M v on the right.
#[inline(always)]
fn diagonal_inertia<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (count, matrix) = (model.coordinates.count, &mut *block.matrix);
    let (masses, speeds) = (&block.mass[..count], &block.v[..count]);
    let (rhs, places) = (&mut block.rhs[..count], &model.diagonal[..count]);
    for dof in 0..count {
        let mass = isa.load(&masses[dof]);
        isa.store(mass, &mut matrix[places[dof]]);
        isa.store(mass * isa.load(&speeds[dof]), &mut rhs[dof]);
    }
}

#[inline(always)]
fn scheme<I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> Scheme<I::F> {
    let factor = |parameter: Parameter| isa.load(&block.factors[parameter as usize]);
    let damping_s = factor(Parameter::Damping) * model.scene.material.damping_time_s;
    let integrator = model.scene.solver.integrator.coefficients();
    let stiffness = factor(Parameter::Stiffness);
    Scheme::new(integrator, &model.program.relaxation, stiffness, damping_s, model.step_s)
}
