//! Ground contact: fully inelastic, with static and dynamic friction that sticks exactly.
//!
//! Each contact point has a gap φ, a normal velocity u_n and a velocity u_t along the ground (a number in the
//! plane, a vector in space), all linear in the velocities at the end of the step. Signorini's law at the level
//! of velocities, 0 ≤ λ_n ⟂ u_n + φ/Δt ≥ 0, lets a point come to rest on the ground without rebound. Friction
//! follows the paper: a point that moves no faster than v_d holds up to |λ_t| ≤ μ_s λ_n + D_f Δt; beyond that it
//! slides against F = μ_d λ_n + D_f Δt, λ_t = −F u_t/|u_t| (Coulomb's cone).
//!
//! Both laws are read from the augmented impulse ξ = λ⁰ − w u, with λ⁰ the impulse of the step before and a
//! penalty w (Alart & Curnier 1991): λ_n = max(ξ_n, 0), and λ_t is ξ_t, cut to the length F(λ_n). The residual
//! velocity of a point that is held, (λ⁰ − λ)/w, vanishes in a steady state: there is no creep. So the step is one
//! piecewise smooth equation in the velocities of the bodies, S v − s = Jᵀ λ(J v), which Newton's
//! iteration solves with a line search ([`solve`]); friction that grows with the normal impulse makes
//! its matrix unsymmetric. Soft unknowns are eliminated beforehand ([`crate::lanes::chain`]).

mod guess;
mod law;
mod points;
mod search;
mod solve;
mod system;
mod workspace;

pub use law::Ground;
pub use points::detect;
pub use solve::solve;
pub use workspace::Workspace;

use crate::lanes::{Isa, Real};

/// State of a contact point, kept as a number per lane.
pub struct Mode;

impl Mode {
    /// Off the ground.
    pub const OPEN: f64 = 0.0;
    /// On the ground, at rest along it.
    pub const STICK: f64 = 1.0;
    /// On the ground, sliding.
    pub const SLIDE: f64 = 2.0;
}

/// A vector at a contact point: upwards, then along x and in space along z.
type Vector<F> = [F; 3];

/// Writes the lanes of a mask.
#[inline(always)]
fn store_where<const W: usize, I: Isa<W>>(isa: I, mask: I::M, new: I::F, row: &mut [f64; W]) {
    isa.store(I::F::select(mask, new, isa.load(row)), row);
}

/// D rows as a vector.
#[inline(always)]
fn load_vector<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    rows: &[[f64; W]],
    c: usize,
) -> Vector<I::F> {
    let mut vector = [isa.splat(0.0); 3];
    for k in 0..D {
        vector[k] = isa.load(&rows[D * c + k]);
    }
    vector
}

/// Writes the lanes of a mask of D rows.
#[inline(always)]
fn store_vector<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    mask: I::M,
    vector: &Vector<I::F>,
    rows: &mut [[f64; W]],
    c: usize,
) {
    for k in 0..D {
        store_where(isa, mask, vector[k], &mut rows[D * c + k]);
    }
}
