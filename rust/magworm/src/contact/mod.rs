//! Ground contact: fully inelastic, with static and dynamic friction that sticks exactly.
//!
//! Each contact point has a gap φ, a normal velocity u_n and a velocity u_t along the ground (a number in the
//! plane, a vector in space), all linear in the velocities at the end of the step. Under it lies a *pad*, a spring k
//! with a damper k τ, so stiff that the whole body's weight presses it in by a thousandth of the body's
//! thickness, and damped beyond rebound (τ at least Δt: so much a step damps of itself):
//!
//! ```text
//! λ_n = max(0, −w (u_n + φ/τ)),  w = k Δt τ       (above the ground φ/Δt: no damper yet)
//! ξ_t = λ⁰ − w u_t,  λ_t = ξ_t cut to the length F(λ_n)
//! ```
//!
//! with λ⁰ the impulse of the pad's spring along the ground at the start. A point that sticks stays where it is, as
//! the spring remembers. Friction follows the paper: a point that moves no faster than v_d holds up to
//! F = μ_s λ_n + D_f Δt; beyond that it slides against F = μ_d λ_n + D_f Δt (Coulomb's cone, read from the
//! augmented impulse ξ as Alart & Curnier 1991 do). One that passes v_d within a step has the mean coefficient.
//!
//! u is the mean velocity of the point over the step, which moves on an arc: to V + ω × r comes ½ Δt ω × (ω × r).
//!
//! Rigid feet on rigid ground have no limit of short steps: with friction as here several motions may follow from
//! one state, or none (Painlevé). On pads they have, and a solution is found much more often.
//!
//! A step is one piecewise smooth equation in the velocities of the bodies, S v − s = Jᵀ λ(J v). [`solve`] solves it by
//! Newton's iteration; friction that grows with the normal impulse makes its matrix unsymmetric. Soft
//! unknowns are eliminated beforehand ([`crate::lanes::chain`]). A block of which no lane touches takes the first iterate.

mod bounded;
mod flight;
mod guess;
mod law;
mod newton;
mod onset;
mod points;
mod search;
mod solve;
mod system;

use law::Ground;
pub use points::detect;
pub use solve::solve;

use crate::lanes::{Isa, Real};
use crate::state::Workspace;

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

/// Components of a point: upwards, then along x and in space along z; of an arm along x, y, z.
type Vector<F> = [F; 3];

/// Writes the lanes of a mask.
#[inline(always)]
fn store_where<I: Isa>(isa: I, mask: I::M, new: I::F, row: &mut I::Row) {
    isa.store(I::F::select(mask, new, isa.load(row)), row);
}

/// D rows as a vector.
#[inline(always)]
fn load_vector<const D: usize, I: Isa>(isa: I, rows: &[I::Row], c: usize) -> Vector<I::F> {
    let rows = &rows[D * c..][..D];
    let mut vector = [isa.splat(0.0); 3];
    for k in 0..D {
        vector[k] = isa.load(&rows[k]);
    }
    vector
}

/// Writes the lanes of a mask of D rows.
#[inline(always)]
fn store_vector<const D: usize, I: Isa>(
    isa: I,
    mask: I::M,
    vector: &Vector<I::F>,
    rows: &mut [I::Row],
    c: usize,
) {
    let rows = &mut rows[D * c..][..D];
    for k in 0..D {
        store_where(isa, mask, vector[k], &mut rows[k]);
    }
}
