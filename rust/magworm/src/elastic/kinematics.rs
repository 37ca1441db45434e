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
    let (q, frame) = (&*block.q, &mut *block.frame);
    for (body, dof) in model.coordinates.bodies.iter().enumerate() {
        let (sin, cos) = sin_cos(isa.load(&q[dof + 2]));
        isa.store(cos, &mut frame[2 * body]);
        isa.store(sin, &mut frame[2 * body + 1]);
    }
}

#[inline(always)]
fn nodes<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let (q, frame, held) = (&*block.q, &*block.frame, &*block.held);
    let places = &mut *block.node;
    for (node, anchor) in model.coordinates.anchors.iter().enumerate() {
        match *anchor {
            Anchor::Free { dof } => {
                places[2 * node] = q[dof];
                places[2 * node + 1] = q[dof + 1];
            }
            Anchor::Rigid { body, side } => {
                let dof = model.coordinates.bodies[body];
                let arm = f64::from(side) * model.half_magnet_m;
                for k in 0..2 {
                    let place = isa.load(&q[dof + k]) + isa.load(&frame[2 * body + k]) * arm;
                    isa.store(place, &mut places[2 * node + k]);
                }
            }
            Anchor::Fixed => {
                places[2 * node] = held[2 * node];
                places[2 * node + 1] = held[2 * node + 1];
            }
        }
    }
}

#[inline(always)]
fn elements<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let node = &*block.node;
    let (tangent, lengths, inverses) =
        (&mut *block.tangent, &mut *block.length, &mut *block.inverse_length);
    let one = isa.splat(1.0);
    for element in 0..model.mesh.elements.len() {
        let (head, tail) = (2 * element, 2 * element + 2);
        let x = isa.load(&node[tail]) - isa.load(&node[head]);
        let y = isa.load(&node[tail + 1]) - isa.load(&node[head + 1]);
        let length = (x * x + y * y).sqrt();
        let inverse = one / length;
        isa.store(x * inverse, &mut tangent[2 * element]);
        isa.store(y * inverse, &mut tangent[2 * element + 1]);
        isa.store(length, &mut lengths[element]);
        isa.store(inverse, &mut inverses[element]);
    }
}
