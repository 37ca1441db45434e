//! Elasticity of the rod: kinematics of nodes and elements, and springs with Kelvin–Voigt damping.
//!
//! A spring has an energy ½ k s² in a measure of strain s with gradient g = ∂s/∂q. Kelvin–Voigt
//! damping replaces s by s + τ ṡ in its force, so rigid motion is undamped. Its generalised force is
//! −k (s + τ g·v) g.
//!
//! *Implicit*: with s at the end of the step, s + Δt g·v⁺, the impulse is
//! −Δt k s g − Δt (Δt + τ) k g gᵀ v⁺: one number on the right, a rank-one matrix on the left.
//! *Explicit*: −Δt k (s + τ g·v) g, all on the right.

mod bend;
mod kinematics;
mod stretch;

pub use bend::assemble as bend;
pub use kinematics::update as kinematics;
pub use stretch::assemble as stretch;

use crate::lanes::Isa;
use crate::lanes::banded::Band;
use crate::model::{Model, Stencil};
use crate::state::Block;

/// Most unknowns in one stencil: three nodes, each on a magnet of its own.
const MOST: usize = 9;

/// How the impulse of a spring enters the equations of a step.
#[derive(Clone, Copy, Debug)]
pub struct Scheme<F> {
    /// Stiffness factor of each lane.
    pub stiffness: F,
    /// Retardation time τ of each lane [s].
    pub damping_s: F,
    /// Time step [s].
    pub dt: f64,
    /// Whether strain is taken at the end of the step.
    pub implicit: bool,
}

/// Gradient over a stencil's unknowns from gradients over its nodes.
///
/// A rigid node at arm a from its magnet moves with δx = δX + δθ ẑ × a, hence g_θ = a × g.
#[inline(always)]
pub fn gather<const W: usize, I: Isa<W>, const N: usize>(
    isa: I,
    model: &Model,
    block: &Block<W>,
    stencil: &Stencil,
    gradient: [[I::F; 2]; N],
) -> [I::F; MOST] {
    let mut out = [isa.splat(0.0); MOST];
    for (k, [gx, gy]) in gradient.into_iter().enumerate() {
        if !stencil.moves[k] {
            continue;
        }
        let slot = stencil.slots[k];
        out[slot] = out[slot] + gx;
        out[slot + 1] = out[slot + 1] + gy;
        if let Some(body) = stencil.body[k] {
            let dof = model.coordinates.bodies[body];
            let node = stencil.nodes[k];
            let ax = isa.load(&block.node[2 * node]) - isa.load(&block.q[dof]);
            let ay = isa.load(&block.node[2 * node + 1]) - isa.load(&block.q[dof + 1]);
            out[slot + 2] = out[slot + 2] + (ax * gy - ay * gx);
        }
    }
    out
}

/// Adds `weight` · g gᵀ to a banded matrix.
#[inline(always)]
pub fn add_rank_one<const W: usize, I: Isa<W>>(
    isa: I,
    band: &Band,
    matrix: &mut [[f64; W]],
    stencil: &Stencil,
    gradient: &[I::F],
    weight: I::F,
) {
    for row in 0..stencil.count {
        let scaled = gradient[row] * weight;
        for column in 0..=row {
            let entry = &mut matrix[band.at(stencil.dofs[row], stencil.dofs[column])];
            isa.store(isa.load(entry) + scaled * gradient[column], entry);
        }
    }
}

/// Adds `weight` · g to a vector.
#[inline(always)]
pub fn add_scaled<const W: usize, I: Isa<W>>(
    isa: I,
    vector: &mut [[f64; W]],
    stencil: &Stencil,
    gradient: &[I::F],
    weight: I::F,
) {
    for slot in 0..stencil.count {
        let entry = &mut vector[stencil.dofs[slot]];
        isa.store(isa.load(entry) + gradient[slot] * weight, entry);
    }
}

/// g·v over a stencil.
#[inline(always)]
pub fn rate<const W: usize, I: Isa<W>>(
    isa: I,
    vector: &[[f64; W]],
    stencil: &Stencil,
    gradient: &[I::F],
) -> I::F {
    let mut sum = isa.splat(0.0);
    for slot in 0..stencil.count {
        sum = sum + gradient[slot] * isa.load(&vector[stencil.dofs[slot]]);
    }
    sum
}

/// Adds the impulse of one spring to the equations of a step.
#[inline(always)]
fn add_spring<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &mut Block<W>,
    stencil: &Stencil,
    gradient: &[I::F],
    strain: I::F,
    stiffness: I::F,
    scheme: Scheme<I::F>,
) {
    let dt = scheme.dt;
    let force = if scheme.implicit {
        let weight = (scheme.damping_s + dt) * stiffness * dt;
        add_rank_one(isa, &model.band, &mut block.matrix, stencil, gradient, weight);
        strain * stiffness
    } else {
        let rate = rate(isa, &block.v, stencil, gradient);
        (strain + rate * scheme.damping_s) * stiffness
    };
    add_scaled(isa, &mut block.right, stencil, gradient, -(force * dt));
}
