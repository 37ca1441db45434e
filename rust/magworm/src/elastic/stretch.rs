//! Axial springs (Bergou 2008, planar as in Huang 2020): E = ½ (EA/l) (|e| − l)².
//!
//! Gradient of |e| over the two nodes: (−t, t). In tension the force also turns with the element;
//! its geometric stiffness (T/|e|) (I − t tᵀ) is the rank-one n nᵀ of each normal n, one in the plane and two
//! in space, and enters the step as springs do. In compression it would be negative and is left out of the matrix.

use super::{Equations, MOST, Places, Scheme, Springs, add_rank_one, add_scaled, gather, rate};
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Adds all axial springs to the equations of a step.
#[inline(always)]
pub fn assemble<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    scheme: Scheme<I::F>,
) {
    let (matrix, right, v) = (&mut *block.matrix, &mut *block.right, &*block.lagged);
    let (tangent, length, inverse_length) =
        (&*block.tangent, &*block.length, &*block.inverse_length);
    let (director, side) = (&*block.director, &*block.side);
    let places = Places { node: &block.node, q: &block.q };
    let mut equations = Equations { matrix, right, v };
    let mut gradient = [isa.splat(0.0); MOST];
    for spring in &model.stretch {
        let e = spring.element;
        let mut t = [isa.splat(0.0); D];
        for axis in 0..D {
            t[axis] = isa.load(&tangent[D * e + axis]);
        }
        let stiffness = scheme.stiffness * spring.stiffness_n_m;
        let strain = isa.load(&length[e]) - spring.rest_m;
        gather::<D, I, 2>(isa, places, &spring.stencil, &opposed(&t), &mut gradient);
        let springs = Springs {
            stencil: &spring.stencil,
            gradients: [&gradient],
            strains: [strain],
            stiffness: [stiffness],
        };
        springs.add(isa, &mut equations, scheme);
        if !scheme.implicit() {
            continue;
        }
        let tension = strain.max(isa.splat(0.0)) * stiffness;
        let force = tension * isa.load(&inverse_length[e]) * scheme.dt;
        let [before_s, after_s] = scheme.geometric_s;
        let mut n = t;
        for normal in 1..D {
            if D == 2 {
                n[0] = -t[1];
                n[1] = t[0];
            } else {
                let rows = if normal == 1 { &director[6 * e..] } else { &side[3 * e..] };
                for axis in 0..D {
                    n[axis] = isa.load(&rows[axis]);
                }
            }
            gather::<D, I, 2>(isa, places, &spring.stencil, &opposed(&n), &mut gradient);
            add_rank_one(isa, equations.matrix, &spring.stencil, &gradient, force * after_s);
            let turned = rate(isa, equations.v, &spring.stencil, &gradient) * before_s;
            add_scaled(isa, equations.right, &spring.stencil, &gradient, -(force * turned));
        }
    }
}

/// (−a, a): gradients over the nodes of an element of the length along a.
#[inline(always)]
fn opposed<F: Real, const D: usize>(a: &[F; D]) -> [[F; D]; 2] {
    let mut pair = [*a; 2];
    for axis in 0..D {
        pair[0][axis] = -a[axis];
    }
    pair
}
