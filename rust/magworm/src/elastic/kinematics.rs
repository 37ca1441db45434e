//! Node positions, tangents and lengths from the unknowns.

use super::frames::{self, load3, store3};
use super::vector::cross;
use crate::lanes::math::sin_cos;
use crate::lanes::{Isa, Real};
use crate::model::{Anchor, Model};
use crate::state::Block;

/// Brings `node`, `frame`, `tangent`, `length` and `inverse_length` up to date with `q`; in space also the
/// frames of the elements.
#[inline(always)]
pub fn update<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    place::<D, I>(isa, model, block);
    if D == 3 {
        frames::transport(isa, model, block);
    }
}

/// Brings `node`, `frame`, `tangent`, `length` and `inverse_length` up to date; leaves the state as it is.
#[inline(always)]
pub fn place<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    if D == 2 {
        angles(isa, model, block);
    } else {
        directors(isa, model, block);
    }
    nodes::<D, I>(isa, model, block);
    elements::<D, I>(isa, model, block);
}

/// Axis of each magnet in the plane, from its angle.
#[inline(always)]
fn angles<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (q, frame) = (&*block.q, &mut *block.frame);
    for (body, dof) in model.coordinates.bodies.iter().enumerate() {
        let (sin, cos) = sin_cos(isa.load(&q[dof + 2]));
        isa.store(cos, &mut frame[2 * body]);
        isa.store(sin, &mut frame[2 * body + 1]);
    }
}

/// Axes of each magnet in space, from the frame of its element.
#[inline(always)]
fn directors<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (director, frame) = (&*block.director, &mut *block.frame);
    for (body, magnet) in model.mesh.magnets.iter().enumerate() {
        let up = load3(isa, director, 6 * magnet.element);
        let t = load3(isa, director, 6 * magnet.element + 3);
        store3(isa, &t, frame, 9 * body);
        store3(isa, &up, frame, 9 * body + 3);
        store3(isa, &cross(&t, &up), frame, 9 * body + 6);
    }
}

#[inline(always)]
fn nodes<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (q, frame, held) = (&*block.q, &*block.frame, &*block.held);
    let places = &mut *block.node;
    let axes = if D == 2 { 2 } else { 9 };
    for (node, anchor) in model.coordinates.anchors.iter().enumerate() {
        match *anchor {
            Anchor::Free { dof } => {
                for k in 0..D {
                    places[D * node + k] = q[dof + k];
                }
            }
            Anchor::Rigid { body, side } => {
                let dof = model.coordinates.bodies[body];
                let arm = f64::from(side) * model.mesh.magnets[body].half_length_m;
                for k in 0..D {
                    let place = isa.load(&q[dof + k]) + isa.load(&frame[axes * body + k]) * arm;
                    isa.store(place, &mut places[D * node + k]);
                }
            }
            Anchor::Fixed => {
                for k in 0..D {
                    places[D * node + k] = held[D * node + k];
                }
            }
        }
    }
}

#[inline(always)]
fn elements<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let node = &*block.node;
    let (tangent, lengths, inverses) =
        (&mut *block.tangent, &mut *block.length, &mut *block.inverse_length);
    let one = isa.splat(1.0);
    for element in 0..model.mesh.elements.len() {
        let (head, tail) = (D * element, D * element + D);
        let mut edge = [one; D];
        for k in 0..D {
            edge[k] = isa.load(&node[tail + k]) - isa.load(&node[head + k]);
        }
        let mut square = edge[0] * edge[0];
        for k in 1..D {
            square = square + edge[k] * edge[k];
        }
        let length = square.sqrt();
        let inverse = one / length;
        for k in 0..D {
            isa.store(edge[k] * inverse, &mut tangent[D * element + k]);
        }
        isa.store(length, &mut lengths[element]);
        isa.store(inverse, &mut inverses[element]);
    }
}
