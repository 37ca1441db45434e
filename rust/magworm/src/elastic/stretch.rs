//! Axial springs (Bergou 2008, planar as in Huang 2020): E = ½ (EA/l) (|e| − l)².
//!
//! Gradient of |e| over the two nodes: (−t, t). In tension the force also turns with the element;
//! its geometric stiffness (T/|e|) (I − t tᵀ) is the rank-one n nᵀ in the plane and is taken along
//! implicitly. In compression it would be negative and is left out of the matrix.

use super::{Equations, MOST, Places, Scheme, Spring, add_rank_one, gather};
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Adds all axial springs to the equations of a step.
#[inline(always)]
pub fn assemble<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    scheme: Scheme<I::F>,
) {
    let (matrix, right, v) = (&mut *block.matrix, &mut *block.right, &*block.v);
    let (tangent, length, inverse_length) =
        (&*block.tangent, &*block.length, &*block.inverse_length);
    let places = Places { node: &block.node, q: &block.q };
    let mut equations = Equations { matrix, right, v };
    let mut gradient = [isa.splat(0.0); MOST];
    for spring in &model.stretch {
        let e = spring.element;
        let t = [isa.load(&tangent[2 * e]), isa.load(&tangent[2 * e + 1])];
        let stiffness = scheme.stiffness * spring.stiffness_n_m;
        let strain = isa.load(&length[e]) - spring.rest_m;
        gather(isa, places, &spring.stencil, &[[-t[0], -t[1]], t], &mut gradient);
        Spring { stencil: &spring.stencil, gradient: &gradient, strain, stiffness }.add(
            isa,
            &mut equations,
            scheme,
        );
        if scheme.implicit {
            let across = [[t[1], -t[0]], [-t[1], t[0]]];
            gather(isa, places, &spring.stencil, &across, &mut gradient);
            let tension = strain.max(isa.splat(0.0)) * stiffness;
            let weight = tension * isa.load(&inverse_length[e]) * (scheme.dt * scheme.dt);
            add_rank_one(isa, equations.matrix, &spring.stencil, &gradient, weight);
        }
    }
}
