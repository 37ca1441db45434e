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
use crate::model::Stencil;

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

/// Node positions and unknowns, for gradients over rigid nodes.
#[derive(Clone, Copy, Debug)]
pub struct Places<'a, const W: usize> {
    /// Node positions [m], shape [nodes × 2].
    pub node: &'a [[f64; W]],
    /// Unknowns [m, rad], shape [unknowns].
    pub q: &'a [[f64; W]],
}

/// Left-hand and right-hand side of a step's equations.
#[derive(Debug)]
pub struct Equations<'a, const W: usize> {
    /// Banded matrix.
    pub matrix: &'a mut [[f64; W]],
    /// Right-hand side, shape [unknowns].
    pub right: &'a mut [[f64; W]],
    /// Velocities at the start of the step, shape [unknowns].
    pub v: &'a [[f64; W]],
}

/// Gradient over a stencil's unknowns from gradients over its nodes, into `out`: an array that is
/// returned would be copied.
///
/// A rigid node at arm a from its magnet moves with δx = δX + δθ ẑ × a, hence g_θ = a × g.
#[inline(always)]
pub fn gather<const W: usize, I: Isa<W>, const N: usize>(
    isa: I,
    places: Places<'_, W>,
    stencil: &Stencil,
    gradient: &[[I::F; 2]; N],
    out: &mut [I::F; MOST],
) {
    *out = [isa.splat(0.0); MOST];
    for k in 0..N {
        if !stencil.moves[k] {
            continue;
        }
        let [gx, gy] = gradient[k];
        let slot = stencil.slots[k];
        out[slot] = out[slot] + gx;
        out[slot + 1] = out[slot + 1] + gy;
        if stencil.body[k].is_some() {
            let (dof, node) = (stencil.body_dofs[k], stencil.nodes[k]);
            let ax = isa.load(&places.node[2 * node]) - isa.load(&places.q[dof]);
            let ay = isa.load(&places.node[2 * node + 1]) - isa.load(&places.q[dof + 1]);
            out[slot + 2] = out[slot + 2] + (ax * gy - ay * gx);
        }
    }
}

/// Adds `weight` · g gᵀ to a banded matrix.
#[inline(always)]
pub fn add_rank_one<const W: usize, I: Isa<W>>(
    isa: I,
    matrix: &mut [[f64; W]],
    stencil: &Stencil,
    gradient: &[I::F],
    weight: I::F,
) {
    // The usual sizes unrolled: a magnet, free nodes, and nodes next to a magnet.
    match stencil.count {
        3 => rank_one::<W, I, 3>(isa, matrix, stencil, gradient, weight),
        4 => rank_one::<W, I, 4>(isa, matrix, stencil, gradient, weight),
        5 => rank_one::<W, I, 5>(isa, matrix, stencil, gradient, weight),
        6 => rank_one::<W, I, 6>(isa, matrix, stencil, gradient, weight),
        7 => rank_one::<W, I, 7>(isa, matrix, stencil, gradient, weight),
        _ => {
            for row in 0..stencil.count {
                rank_one_row(isa, matrix, stencil, gradient, weight, row);
            }
        }
    }
}

#[inline(always)]
fn rank_one<const W: usize, I: Isa<W>, const N: usize>(
    isa: I,
    matrix: &mut [[f64; W]],
    stencil: &Stencil,
    gradient: &[I::F],
    weight: I::F,
) {
    for row in 0..N {
        rank_one_row(isa, matrix, stencil, gradient, weight, row);
    }
}

#[inline(always)]
fn rank_one_row<const W: usize, I: Isa<W>>(
    isa: I,
    matrix: &mut [[f64; W]],
    stencil: &Stencil,
    gradient: &[I::F],
    weight: I::F,
    row: usize,
) {
    let scaled = gradient[row] * weight;
    let first = row * (row + 1) / 2;
    for column in 0..=row {
        let entry = &mut matrix[stencil.entries[first + column]];
        isa.store(isa.load(entry) + scaled * gradient[column], entry);
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

/// A spring at the start of the step.
struct Spring<'a, F> {
    stencil: &'a Stencil,
    gradient: &'a [F; MOST],
    strain: F,
    stiffness: F,
}

impl<F> Spring<'_, F> {
    /// Adds its impulse to the equations of a step.
    #[inline(always)]
    fn add<const W: usize, I: Isa<W, F = F>>(
        &self,
        isa: I,
        equations: &mut Equations<'_, W>,
        scheme: Scheme<F>,
    ) where
        F: crate::lanes::Real<Mask = I::M>,
    {
        let dt = scheme.dt;
        let force = if scheme.implicit {
            let weight = (scheme.damping_s + dt) * self.stiffness * dt;
            add_rank_one(isa, equations.matrix, self.stencil, self.gradient, weight);
            self.strain * self.stiffness
        } else {
            let rate = rate(isa, equations.v, self.stencil, self.gradient);
            (self.strain + rate * scheme.damping_s) * self.stiffness
        };
        add_scaled(isa, equations.right, self.stencil, self.gradient, -(force * dt));
    }
}
