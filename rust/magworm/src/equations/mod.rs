//! The equations of one step, A v⁺ = b:
//!
//! ```text
//! (M + Δt b Σ k g gᵀ) v⁺ = M v + Δt (F − Σ k (s + a g·v) g),   q⁺ = q + Δt v⁺
//! ```
//!
//! with strains s, gradients g and forces F at q, and the a and b of the integrator, see [`crate::integrate`]. All
//! integrators are solved by the same banded factorisation and the same contact solve.

mod hold;
mod loads;
mod off_centre;
mod ties;

use crate::elastic::{self, Scheme};
use crate::lanes::{Dim, Isa};
use crate::model::Model;
use crate::scene::Parameter;
use crate::state::Block;

pub use loads::{gravity, magnets};
pub use off_centre::carry;

/// Begins matrix and right-hand side of a step: inertia alone.
#[inline(always)]
pub fn inertia<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    model.system.clear(isa, &mut block.matrix);
    diagonal_inertia(isa, model, block);
    if D::AXES == 3 {
        rotary_inertia(isa, model, block);
    }
    off_centre::inertia::<D, I>(isa, model, block);
}

/// Adds the springs of the rod, and the multipliers where magnets are held by them.
#[inline(always)]
pub fn springs<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let scheme = scheme(isa, model, block);
    elastic::stretch::<D, I>(isa, model, block, scheme);
    if D::AXES == 2 {
        elastic::bend(isa, model, block, scheme);
    } else {
        elastic::bend_and_twist(isa, model, block, scheme);
    }
    ties::constrain::<D, I>(isa, model, block);
}

/// M on the left, M v on the right.
#[inline(always)]
fn diagonal_inertia<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (count, matrix) = (model.coordinates.count, &mut *block.matrix);
    let (masses, speeds) = (&block.mass[..count], &block.v[..count]);
    let right = &mut block.right[..count];
    for dof in 0..count {
        let mass = isa.load(&masses[dof]);
        isa.store(mass, &mut matrix[model.system.at(dof, dof)]);
        isa.store(mass * isa.load(&speeds[dof]), &mut right[dof]);
    }
}

/// The same for the rotation of the magnets in space, whose inertia Σ I a aᵀ turns with their axes a.
#[inline(always)]
fn rotary_inertia<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    for (body, &dof) in model.coordinates.bodies.iter().enumerate() {
        let axes = elastic::axes(isa, block, body);
        let first = dof + 3;
        for row in 0..3 {
            let mut momentum = isa.splat(0.0);
            for column in 0..3 {
                let mut entry = isa.splat(0.0);
                for k in 0..3 {
                    let moment = isa.load(&block.mass[first + k]);
                    entry = entry + moment * axes[k][row] * axes[k][column];
                }
                momentum = momentum + entry * isa.load(&block.v[first + column]);
                if column <= row {
                    let place = model.system.at(first + row, first + column);
                    isa.store(entry, &mut block.matrix[place]);
                }
            }
            isa.store(momentum, &mut block.right[first + row]);
        }
    }
}

#[inline(always)]
fn scheme<I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> Scheme<I::F> {
    let factor = |parameter: Parameter| isa.load(&block.factors[parameter as usize]);
    let damping_s = factor(Parameter::Damping) * model.scene.material.damping_time_s;
    let integrator = model.scene.solver.integrator.coefficients();
    Scheme::new(integrator, factor(Parameter::Stiffness), damping_s, model.step_s)
}
