//! Node positions, tangents and lengths from the unknowns.

use super::Rod;
use crate::lanes::{Components, Dim, Isa, Real};
use crate::model::{Anchor, Model};
use crate::state::Block;

/// Brings `node`, `frame`, `tangent`, `length` and `inverse_length` up to date with `q`; in space also the
/// frames of the elements.
#[inline(always)]
pub fn update<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    place::<D, I>(isa, model, block);
    D::update_frames(isa, model, block);
}

/// Brings `node`, `frame`, `tangent`, `length` and `inverse_length` up to date; leaves the state as it is.
#[inline(always)]
pub fn place<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    D::place_axes(isa, model, block);
    nodes::<D, I>(isa, model, block);
    elements::<D, I>(isa, model, block);
}

#[inline(always)]
fn nodes<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let (q, frame, held) = (&*block.q, &*block.frame, &*block.fixed_position);
    let places = &mut *block.node;
    let axes = D::Frame::<I::F>::COUNT;
    for (node, anchor) in model.coordinates.anchors.iter().enumerate() {
        match *anchor {
            Anchor::Free { dof } => {
                for k in 0..D::AXES {
                    places[D::AXES * node + k] = q[dof + k];
                }
            }
            Anchor::Rigid { body, side } => {
                let dof = model.coordinates.bodies[body];
                let arm = isa.splat(f64::from(side) * model.bodies[body].half_length_m);
                let axis = D::Vector::load(isa, &frame[axes * body..]);
                let place = D::Vector::load(isa, &q[dof..]) + axis * arm;
                place.store(isa, &mut places[D::AXES * node..]);
            }
            Anchor::Fixed => {
                for k in 0..D::AXES {
                    places[D::AXES * node + k] = held[D::AXES * node + k];
                }
            }
        }
    }
}

#[inline(always)]
fn elements<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let node = &*block.node;
    let (tangent, lengths, inverses) =
        (&mut *block.tangent, &mut *block.length, &mut *block.inverse_length);
    let one = isa.splat(1.0);
    for element in 0..model.mesh.elements.len() {
        let (head, tail) = (D::AXES * element, D::AXES * element + D::AXES);
        let edge = D::Vector::load(isa, &node[tail..]) - D::Vector::load(isa, &node[head..]);
        let length = edge.norm_squared().sqrt();
        let inverse = one / length;
        (edge * inverse).store(isa, &mut tangent[D::AXES * element..]);
        isa.store(length, &mut lengths[element]);
        isa.store(inverse, &mut inverses[element]);
    }
}
