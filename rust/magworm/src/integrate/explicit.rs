//! The paper's scheme: explicit forces, rigid magnets held by Lagrange multipliers.
//!
//! M v⁺ = M v + Δt (F(q, v)) + Gᵀμ with the constraint G v⁺ = −c(q)/Δt of every magnet end,
//! c = x_node − X − R(θ) r: the node follows the magnet, and what it strayed in the last step
//! (the centripetal ½ ω² r Δt²) is taken back. The saddle-point matrix [M Gᵀ; G 0] stays banded.

use super::springs;
use crate::elastic::Scheme;
use crate::lanes::Isa;
use crate::model::{Anchor, Model, Tie};
use crate::state::Block;

/// Adds the elastic terms and the constraints of a step.
#[inline(always)]
pub fn assemble<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    scheme: Scheme<I::F>,
) {
    springs(isa, model, block, scheme);
    for tie in &model.coordinates.ties {
        constrain(isa, model, block, tie, scheme.dt);
    }
}

#[inline(always)]
fn constrain<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    tie: &Tie,
    dt: f64,
) {
    let Anchor::Free { dof: node } = model.coordinates.anchors[tie.node] else { return };
    let body = model.coordinates.bodies[tie.body];
    let reach = f64::from(tie.side) * model.half_magnet_m;
    let arm = [
        isa.load(&block.frame[2 * tie.body]) * reach,
        isa.load(&block.frame[2 * tie.body + 1]) * reach,
    ];
    // ∂(X + R r)/∂θ = ẑ × arm.
    let turn = [-arm[1], arm[0]];
    for k in 0..2 {
        let row = tie.dof + k;
        let strayed = isa.load(&block.q[node + k]) - isa.load(&block.q[body + k]) - arm[k];
        isa.store(-(strayed / dt), &mut block.right[row]);
        set(isa, model, block, row, node + k, isa.splat(1.0));
        set(isa, model, block, row, body + k, isa.splat(-1.0));
        set(isa, model, block, row, body + 2, -turn[k]);
    }
}

#[inline(always)]
fn set<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    a: usize,
    b: usize,
    value: I::F,
) {
    isa.store(value, &mut block.matrix[model.band.at(a.max(b), a.min(b))]);
}
