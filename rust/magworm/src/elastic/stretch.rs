//! Axial springs (Bergou 2008, planar as in Huang 2020): E = ½ (EA/l) (|e| − l)².
//!
//! Gradient of |e| over the two nodes: (−t, t). In tension the force also turns with the element;
//! its geometric stiffness (T/|e|) (I − t tᵀ) is the rank-one n nᵀ of each normal n, one in the plane and two
//! in space, and enters the step as springs do. In compression it would be negative and is left out of the matrix.

use super::relax::Dashpots;
use super::rod::{Frames, Rod};
use super::{
    Equations, MAX_STENCIL, Positions, Scheme, Springs, add_force, add_rank_one,
    generalised_gradient, strain_rate,
};
use crate::lanes::{Components, Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Adds all axial springs to the equations of a step.
#[inline(always)]
pub fn assemble<D: Rod, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    scheme: Scheme<I::F>,
) {
    let (matrix, rhs, v) = (&mut *block.matrix, &mut *block.rhs, &*block.spring_velocity);
    let (tangent, length, inverse_length) =
        (&*block.tangent, &*block.length, &*block.inverse_length);
    let frames = Frames { director: &block.director, side: &block.side };
    let positions = Positions { node: &block.node, q: &block.q };
    let mut equations = Equations { matrix, rhs, v };
    let relaxation = &model.program.relaxation;
    let mut dashpots =
        Dashpots::new(isa, relaxation, &mut block.stretch_dashpot, &block.running[0]);
    let mut gradient = [isa.splat(0.0); MAX_STENCIL];
    for (way, spring) in model.stretch.iter().enumerate() {
        let e = spring.element;
        let stencil = &spring.stencil;
        let t = D::Vector::load(isa, &tangent[D::AXES * e..]);
        let stiffness = scheme.stiffness * spring.stiffness_n_m;
        let strain = dashpots.act(way, isa.load(&length[e]) - spring.rest_m);
        generalised_gradient::<D, I, 2>(isa, positions, stencil, &[-t, t], &mut gradient);
        let springs =
            Springs { stencil, gradients: [&gradient], strains: [strain], stiffness: [stiffness] };
        springs.add(isa, &mut equations, scheme);
        if !scheme.implicit() {
            continue;
        }
        let tension = strain.max(isa.splat(0.0)) * stiffness;
        let force = tension * isa.load(&inverse_length[e]) * scheme.dt;
        let [before_s, after_s] = scheme.geometric_s;
        for normal in 0..D::TANGENTS {
            let n = D::normal(isa, frames, e, t, normal);
            generalised_gradient::<D, I, 2>(isa, positions, stencil, &[-n, n], &mut gradient);
            add_rank_one(isa, equations.matrix, stencil, &gradient, force * after_s);
            let turned = strain_rate(isa, equations.v, stencil, &gradient) * before_s;
            add_force(isa, equations.rhs, stencil, &gradient, -(force * turned));
        }
    }
}
