//! Elasticity of the rod: kinematics of nodes and elements, and springs with Kelvin–Voigt damping.
//!
//! A spring has an energy ½ k s² in a measure of strain s with gradient g = ∂s/∂q. Kelvin–Voigt
//! damping replaces s by s + τ ṡ in its force, so rigid motion is undamped. Its generalised force is
//! −k (s + τ g·v) g.
//!
//! In all schemes the impulse of a step is −Δt k (s + a g·v + b g·v⁺) g: a number on the right, and where b is not 0 a
//! rank-one matrix on the left. Each integrator has its a and b, see [`crate::integrate`].
//!
//! Kernels are generic over the dimension D: 2 in the plane, 3 in space. In the plane a node bends in one
//! way; in space in two, and it twists.

mod bend;
mod frames;
mod kinematics;
mod relax;
mod rod;
mod stretch;
mod twist;

pub use kinematics::{place, update as kinematics};
pub use rod::Rod;
pub use stretch::assemble as stretch;

use crate::integrate::Coefficients;
use crate::lanes::{Components, Dim, Isa, Real, Vec3};
use crate::model::{MAX_STENCIL, Relaxation, Spin, Stencil};

/// How the impulse of a spring enters the equations of a step.
#[derive(Clone, Copy, Debug)]
pub struct Scheme<F> {
    /// Stiffness factor of each lane.
    pub stiffness: F,
    /// Time step [s].
    pub dt: f64,
    /// a: what the strain rate at the start of the step counts for [s].
    pub before_s: F,
    /// b: what the one at its end counts for [s].
    pub after_s: F,
    /// a and b of the geometric stiffness, which has no retardation [s]; both 0 in the explicit scheme.
    pub geometric_s: [f64; 2],
}

impl<F: Real> Scheme<F> {
    /// The scheme of an integrator, of branches that relax, of a retardation time τ and a step Δt.
    #[inline(always)]
    pub fn new(
        integrator: &Coefficients,
        relaxation: &Relaxation,
        stiffness: F,
        damping_s: F,
        dt: f64,
    ) -> Self {
        let seconds = |[retardation, steps]: [f64; 2], relaxing: f64| {
            damping_s * retardation + (steps + relaxing) * dt
        };
        let [before, after] = relaxation.steps;
        Self {
            stiffness,
            dt,
            before_s: seconds(integrator.before, before),
            after_s: seconds(integrator.after, after),
            geometric_s: (integrator.geometric_s)(dt),
        }
    }

    /// Whether strain rates at the end of the step count.
    pub fn implicit(&self) -> bool {
        self.geometric_s[1] > 0.0
    }
}

/// Node positions and unknowns, for gradients over rigid nodes.
#[derive(Clone, Copy, Debug)]
pub struct Positions<'a, R> {
    /// Node positions [m], shape [nodes × D].
    pub node: &'a [R],
    /// Unknowns [m, rad], shape [unknowns].
    pub q: &'a [R],
}

/// Left-hand and right-hand side of a step's equations.
#[derive(Debug)]
pub struct Equations<'a, R> {
    /// Banded matrix.
    pub matrix: &'a mut [R],
    /// Right-hand side, shape [unknowns].
    pub rhs: &'a mut [R],
    /// Velocities at the start of the step, as springs take them, shape [unknowns].
    pub v: &'a [R],
}

/// Gradient over a stencil's unknowns from gradients over its nodes, into `out`: an array that is
/// returned would be copied.
///
/// A rigid node at arm a from its magnet moves with δx = δX + δω × a, hence g_ω = a × g.
#[inline(always)]
pub fn generalised_gradient<D: Dim, I: Isa, const N: usize>(
    isa: I,
    positions: Positions<'_, I::Row>,
    stencil: &Stencil,
    gradient: &[D::Vector<I::F>; N],
    out: &mut [I::F; MAX_STENCIL],
) {
    for slot in 0..stencil.count {
        out[slot] = isa.splat(0.0);
    }
    for k in 0..N {
        if !stencil.moves[k] {
            continue;
        }
        let (g, slot) = (gradient[k], stencil.slots[k]);
        for axis in 0..D::AXES {
            out[slot + axis] = out[slot + axis] + g[axis];
        }
        if stencil.body[k].is_some() {
            let (dof, node) = (stencil.body_dofs[k], stencil.nodes[k]);
            let centre = D::Vector::load(isa, &positions.q[dof..]);
            let arm = D::Vector::load(isa, &positions.node[D::AXES * node..]) - centre;
            let torque = D::torque(arm, g);
            for k in 0..D::ROTATIONS {
                out[slot + D::AXES + k] = out[slot + D::AXES + k] + torque[k];
            }
        }
    }
}

/// Adds the gradient over the twist of an element with tangent t. A rigid element twists by t·δω.
#[inline(always)]
pub fn add_twist_gradient<F: Real>(
    spin: Spin,
    t: Vec3<F>,
    gradient: F,
    out: &mut [F; MAX_STENCIL],
) {
    match spin {
        Spin::Fixed => {}
        Spin::Free(slot) => out[slot] = out[slot] + gradient,
        Spin::Rigid(slot) => {
            for axis in 0..3 {
                out[slot + axis] = out[slot + axis] + t[axis] * gradient;
            }
        }
    }
}

/// Adds `weight` · g gᵀ to a banded matrix.
#[inline(always)]
pub fn add_rank_one<I: Isa>(
    isa: I,
    matrix: &mut [I::Row],
    stencil: &Stencil,
    gradient: &[I::F],
    weight: I::F,
) {
    add_rank::<I, 1>(isa, matrix, stencil, [gradient], [weight]);
}

/// Adds Σ `weights` · g gᵀ over K gradients to a banded matrix; each entry is loaded and stored once.
#[inline(always)]
pub fn add_rank<I: Isa, const K: usize>(
    isa: I,
    matrix: &mut [I::Row],
    stencil: &Stencil,
    gradients: [&[I::F]; K],
    weights: [I::F; K],
) {
    // The usual sizes unrolled: a magnet, free nodes, and nodes next to a magnet.
    match stencil.count {
        3 => rank::<I, K, 3>(isa, matrix, stencil, gradients, weights),
        4 => rank::<I, K, 4>(isa, matrix, stencil, gradients, weights),
        5 => rank::<I, K, 5>(isa, matrix, stencil, gradients, weights),
        6 => rank::<I, K, 6>(isa, matrix, stencil, gradients, weights),
        7 => rank::<I, K, 7>(isa, matrix, stencil, gradients, weights),
        _ => {
            for row in 0..stencil.count {
                rank_row(isa, matrix, stencil, gradients, weights, row);
            }
        }
    }
}

#[inline(always)]
fn rank<I: Isa, const K: usize, const N: usize>(
    isa: I,
    matrix: &mut [I::Row],
    stencil: &Stencil,
    gradients: [&[I::F]; K],
    weights: [I::F; K],
) {
    for row in 0..N {
        rank_row(isa, matrix, stencil, gradients, weights, row);
    }
}

#[inline(always)]
fn rank_row<I: Isa, const K: usize>(
    isa: I,
    matrix: &mut [I::Row],
    stencil: &Stencil,
    gradients: [&[I::F]; K],
    weights: [I::F; K],
    row: usize,
) {
    let mut scaled = weights;
    let mut along = gradients;
    for k in 0..K {
        scaled[k] = gradients[k][row] * weights[k];
        along[k] = &gradients[k][..=row];
    }
    let entries = &stencil.entries[row * (row + 1) / 2..][..=row];
    for column in 0..=row {
        let entry = &mut matrix[entries[column]];
        let mut sum = isa.load(entry);
        for k in 0..K {
            sum = sum + scaled[k] * along[k][column];
        }
        isa.store(sum, entry);
    }
}

/// Adds `weight` · g to a vector.
#[inline(always)]
pub fn add_force<I: Isa>(
    isa: I,
    vector: &mut [I::Row],
    stencil: &Stencil,
    gradient: &[I::F],
    weight: I::F,
) {
    let dofs = &stencil.dofs[..stencil.count];
    let gradient = &gradient[..dofs.len()];
    for slot in 0..dofs.len() {
        let entry = &mut vector[dofs[slot]];
        isa.store(isa.load(entry) + gradient[slot] * weight, entry);
    }
}

/// g·v over a stencil.
#[inline(always)]
pub fn strain_rate<I: Isa>(
    isa: I,
    vector: &[I::Row],
    stencil: &Stencil,
    gradient: &[I::F],
) -> I::F {
    let dofs = &stencil.dofs[..stencil.count];
    let gradient = &gradient[..dofs.len()];
    let mut sum = isa.splat(0.0);
    for slot in 0..dofs.len() {
        sum = sum + gradient[slot] * isa.load(&vector[dofs[slot]]);
    }
    sum
}

/// K springs over the same unknowns, at the start of the step.
struct Springs<'a, F, const K: usize> {
    stencil: &'a Stencil,
    gradients: [&'a [F; MAX_STENCIL]; K],
    strains: [F; K],
    stiffness: [F; K],
}

impl<F, const K: usize> Springs<'_, F, K> {
    /// Adds their impulses to the equations of a step.
    #[inline(always)]
    fn add<I: Isa<F = F>>(&self, isa: I, equations: &mut Equations<'_, I::Row>, scheme: Scheme<F>)
    where
        F: Real<Mask = I::M>,
    {
        let dt = scheme.dt;
        if scheme.implicit() {
            let mut weights = self.stiffness;
            let mut gradients = [&self.gradients[0][..]; K];
            for k in 0..K {
                weights[k] = scheme.after_s * self.stiffness[k] * dt;
                gradients[k] = &self.gradients[k][..];
            }
            add_rank(isa, equations.matrix, self.stencil, gradients, weights);
        }
        for k in 0..K {
            let gradient = self.gradients[k];
            let rate = strain_rate(isa, equations.v, self.stencil, gradient);
            let force = (self.strains[k] + rate * scheme.before_s) * self.stiffness[k];
            add_force(isa, equations.rhs, self.stencil, gradient, -(force * dt));
        }
    }
}
