//! Ground contact: fully inelastic, with static and dynamic friction that sticks exactly.
//!
//! Each contact point has a gap φ, a normal velocity u_n and a tangential velocity u_t (a number in the plane,
//! a vector along the ground in space), all linear in the velocities at the end of the step. Signorini's law
//! at the level of velocities, 0 ≤ λ_n ⟂ u_n + φ/Δt ≥ 0, lets a point come to rest on the ground without
//! rebound. Friction follows the paper: a point that moves no faster than v_d holds up to |λ_t| ≤ μ_s λ_n + D_f Δt;
//! beyond that it slides against F = μ_d λ_n + D_f Δt, λ_t = −F d with d = u_t/|u_t| (Coulomb's cone).
//!
//! A closed (or sticking) direction J is held by a multiplier and a penalty, λ = λ⁰ − w J v⁺, with λ⁰
//! the impulse of the last step (an augmented Lagrangian). The residual velocity (λ⁰ − λ)/w
//! vanishes in a steady state and is below 1e-9 m/s at the presets' step. It adds w JᵀJ to the matrix, which
//! stays banded and positive definite even where heel and toe of a rigid foot over-determine it.
//!
//! In space the direction in which a point slides is unknown too. Friction is linearised about the velocity
//! u of the pass before, λ_t = −F d − (F/|u|)(I − d dᵀ)(u⁺ − u): beside the force along d a viscous one across
//! it, which is Newton's iteration for Coulomb's law and enters the matrix as one more rank-one term.

mod cone;
mod divide;
mod guess;
mod law;
mod points;
mod settle;
mod solve;

pub use divide::{divide, join};
pub use law::Ground;
pub use points::detect;
pub use settle::MEMORY;
pub use solve::{PATIENCE, hold, solve};

use crate::lanes::{Isa, Real};
use crate::model::body_size;

/// Most unknowns that a contact point moves with: position and rotation of a magnet.
const SLOTS: usize = 6;
/// Directions of a contact point: its normal, and the one or two along the ground.
const MOST_DIRECTIONS: usize = 3;

/// Rows of the Jacobian of a contact point with D directions.
pub const fn jacobian_rows(dimensions: usize) -> usize {
    dimensions * body_size(dimensions)
}

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

/// Writes the lanes that are not done.
#[inline(always)]
fn store_unless<const W: usize, I: Isa<W>>(isa: I, done: I::M, new: I::F, row: &mut [f64; W]) {
    isa.store(I::F::select(done, isa.load(row), new), row);
}
