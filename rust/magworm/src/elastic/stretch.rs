//! Axial springs (Bergou 2008, planar as in Huang 2020): E = ½ (EA/l) (|e| − l)².
//!
//! Gradient of |e| over the two nodes: (−t, t). In tension the force also turns with the element;
//! its geometric stiffness (T/|e|) (I − t tᵀ) is the rank-one n nᵀ in the plane and is taken along
//! implicitly. In compression it would be negative and is left out of the matrix.

use super::{Scheme, add_rank_one, add_spring, gather};
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
    for spring in &model.stretch {
        let e = spring.element;
        let t = [isa.load(&block.tangent[2 * e]), isa.load(&block.tangent[2 * e + 1])];
        let stiffness = scheme.stiffness * spring.stiffness_n_m;
        let elongation = isa.load(&block.length[e]) - spring.rest_m;
        let gradient = gather(isa, model, block, &spring.stencil, [t.map(|x| -x), t]);
        add_spring(isa, model, block, &spring.stencil, &gradient, elongation, stiffness, scheme);
        if scheme.implicit {
            let across = gather(isa, model, block, &spring.stencil, [[t[1], -t[0]], [-t[1], t[0]]]);
            let tension = elongation.max(isa.splat(0.0)) * stiffness;
            let weight = tension * isa.load(&block.inverse_length[e]) * (scheme.dt * scheme.dt);
            add_rank_one(isa, &model.band, &mut block.matrix, &spring.stencil, &across, weight);
        }
    }
}
