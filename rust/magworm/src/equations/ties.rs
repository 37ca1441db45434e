//! Rigid magnets held by Lagrange multipliers, as in the paper.
//!
//! M v⁺ = M v + Δt (F(q, v)) + Gᵀμ with the constraint G v⁺ = −c(q)/Δt of every magnet end,
//! c = x_node − X − R(θ) r: the node follows the magnet, and what it strayed in the last step
//! (the centripetal ½ ω² r Δt²) is taken back. The saddle-point matrix [M Gᵀ; G 0] stays banded.

use crate::lanes::{Components, Dim, Isa};
use crate::model::{Anchor, Model, Tie};
use crate::state::Block;

/// Adds the constraints of a step.
#[inline(always)]
pub fn constrain<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    for tie in &model.coordinates.ties {
        follow::<D, I>(isa, model, block, tie);
    }
}

/// The node of a tie follows its magnet.
#[inline(always)]
fn follow<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, tie: &Tie) {
    let Anchor::Free { dof: node } = model.coordinates.anchors[tie.node] else { return };
    let body = model.coordinates.bodies[tie.body];
    let reach = f64::from(tie.side) * model.bodies[tie.body].half_length_m;
    let axes = D::Frame::<I::F>::COUNT;
    let arm = D::Vector::load(isa, &block.frame[axes * tie.body..]) * isa.splat(reach);
    for k in 0..D::AXES {
        let row = tie.dof + k;
        let strayed = isa.load(&block.q[node + k]) - isa.load(&block.q[body + k]) - arm[k];
        isa.store(-(strayed / model.step_s), &mut block.rhs[row]);
        set(isa, model, block, row, node + k, isa.splat(1.0));
        set(isa, model, block, row, body + k, isa.splat(-1.0));
        // −∂(ω × arm)_k/∂ω = e_k × arm.
        let turn = D::axis_cross(k, arm);
        for rotation in 0..D::ROTATIONS {
            set(isa, model, block, row, body + D::AXES + rotation, turn[rotation]);
        }
    }
}

#[inline(always)]
fn set<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, a: usize, b: usize, value: I::F) {
    isa.store(value, &mut block.matrix[model.system.at(a.max(b), a.min(b))]);
}
