//! Node positions, tangents and lengths from the unknowns.

use crate::lanes::math::sin_cos;
use crate::lanes::{Isa, Real};
use crate::model::{Anchor, Model};
use crate::state::Block;

/// Brings `node`, `frame`, `tangent`, `length` and `inverse_length` up to date with `q`.
#[inline(always)]
pub fn update<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    frames(isa, model, block);
    nodes(isa, model, block);
    elements(isa, model, block);
}

#[inline(always)]
fn frames<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    for (body, dof) in model.coordinates.bodies.iter().enumerate() {
        let (sin, cos) = sin_cos(isa.load(&block.q[dof + 2]));
        isa.store(cos, &mut block.frame[2 * body]);
        isa.store(sin, &mut block.frame[2 * body + 1]);
    }
}

#[inline(always)]
fn nodes<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    for (node, anchor) in model.coordinates.anchors.iter().enumerate() {
        match *anchor {
            Anchor::Free { dof } => {
                block.node[2 * node] = block.q[dof];
                block.node[2 * node + 1] = block.q[dof + 1];
            }
            Anchor::Rigid { body, side } => {
                let dof = model.coordinates.bodies[body];
                let arm = f64::from(side) * model.half_magnet_m;
                for k in 0..2 {
                    let place =
                        isa.load(&block.q[dof + k]) + isa.load(&block.frame[2 * body + k]) * arm;
                    isa.store(place, &mut block.node[2 * node + k]);
                }
            }
            Anchor::Fixed => {
                block.node[2 * node] = block.held[2 * node];
                block.node[2 * node + 1] = block.held[2 * node + 1];
            }
        }
    }
}

#[inline(always)]
fn elements<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let one = isa.splat(1.0);
    for element in 0..model.mesh.elements.len() {
        let edge = [0, 1].map(|k| {
            isa.load(&block.node[2 * element + 2 + k]) - isa.load(&block.node[2 * element + k])
        });
        let length = (edge[0] * edge[0] + edge[1] * edge[1]).sqrt();
        let inverse = one / length;
        isa.store(edge[0] * inverse, &mut block.tangent[2 * element]);
        isa.store(edge[1] * inverse, &mut block.tangent[2 * element + 1]);
        isa.store(length, &mut block.length[element]);
        isa.store(inverse, &mut block.inverse_length[element]);
    }
}
