//! Ground contact: fully inelastic, with static and dynamic friction that sticks exactly.
//!
//! Each contact point has a gap φ, a normal velocity u_n and a tangential velocity u_t, both linear in
//! the velocities at the end of the step. Signorini's law at the level of velocities,
//! 0 ≤ λ_n ⟂ u_n + φ/Δt ≥ 0, lets a point come to rest on the ground without rebound. Friction
//! follows the paper: a point that moves no faster than v_d holds up to μ_s λ_n + D_f Δt; beyond that it
//! slides against μ_d λ_n + D_f Δt.
//!
//! A closed (or sticking) direction J is held by a multiplier and a penalty, λ = λ⁰ − w J v⁺, with λ⁰
//! the impulse of the last step (an augmented Lagrangian). The residual velocity (λ⁰ − λ)/w
//! vanishes in a steady state and is below 1e-9 m/s at the presets' step. It adds w JᵀJ to the matrix, which
//! stays banded and positive definite even where heel and toe of a rigid foot over-determine it.

mod points;
mod solve;

pub use points::detect;
pub use solve::{Ground, solve};

/// Most unknowns that a contact point moves with: x, y and θ of a magnet.
pub const SLOTS: usize = 3;

/// State of a contact point, kept as a number per lane.
pub struct Mode;

impl Mode {
    /// Off the ground.
    pub const OPEN: f64 = 0.0;
    /// On the ground, at rest along it.
    pub const STICK: f64 = 1.0;
    /// On the ground, sliding towards +x.
    pub const SLIDE_FORWARD: f64 = 2.0;
    /// On the ground, sliding towards −x.
    pub const SLIDE_BACK: f64 = -2.0;
}
