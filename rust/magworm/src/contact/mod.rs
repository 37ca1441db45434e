//! Contact points that press on surfaces: compliant and dissipative along the normal, with Coulomb friction that sticks
//! exactly.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | v | velocities at the end of the step | m/s, rad/s |
//! | u = J v + û | velocity of a contact point with its bias û: u_n along the normal, u_t along the tangents | m/s |
//! | φ | gap between point and surface at the start of the step | m |
//! | λ | impulse of the surface on the point in the step | N·s |
//! | λ⁰ | part of it that the tangential spring holds at the start of the step | N·s |
//! | k, τ | stiffness and dissipation time of the contact spring, τ ≥ Δt | N/m, s |
//! | w = k Δt τ | effective mass of the spring and its damper | kg |
//! | μ_s, μ_d, v_d | static and dynamic friction, speed at which one gives way to the other | 1, 1, m/s |
//! | F | friction bound: the largest tangential impulse | N·s |
//!
//! The equations of a step are those of a compliant contact with linear dissipation (Kelvin–Voigt), as in Drake's SAP
//! (Castro, Permenter & Han 2022), and of Coulomb's cone read from an augmented impulse ξ (Alart & Curnier 1991):
//!
//! ```text
//! A v = b + Jᵀ λ(u)
//! λ_n = max(0, −w u_n),  û_n = φ/τ        (φ/Δt above the surface: the damper does not act there)
//! ξ_t = λ⁰ − w u_t,      λ_t = ξ_t min(1, F/|ξ_t|)
//! F   = μ λ_n + D_f Δt
//! ```
//!
//! The spring is so stiff that the body's weight presses it in by a thousandth of the body's thickness, and damped beyond
//! rebound. A point that sticks stays where it is, since its tangential spring remembers the place (the bristle of
//! Cundall & Strack 1979). μ is the paper's: μ_s where the point is no faster than v_d at the start of the step, μ_d
//! beyond; a point that passes v_d within a step has the mean of both ([`stick_slip`]).
//!
//! A point that arrives may rebound ([`rebound`]): then û_n is e u_n⁻, and w along the normal that of a rigid point.
//!
//! u is the mean velocity of the point over the step, which moves on an arc: û holds ½ Δt ω × (ω × r).
//!
//! With rigid contact and friction as high as here a step may have several solutions or none (Painlevé's paradox), and
//! results do not converge with the step. With compliant contact they do, and a solution is found far more often.
//!
//! A step is one piecewise smooth equation in the velocities of the bodies, S v − s = Jᵀ λ(J v), where S and s follow from
//! A and b by eliminating the soft unknowns ([`crate::lanes::chain`]). [`solve`] solves it by semismooth Newton's iteration.

mod contact_free;
mod contact_vector;
mod detect;
mod hessian;
mod initial;
mod jacobian;
mod law;
mod line_search;
mod newton;
mod newton_system;
mod rebound;
mod solve;
mod stick_slip;
mod surface;
mod touch;
mod tresca;

use contact_vector::ContactVector;
pub use detect::detect;
pub use solve::solve;

use crate::lanes::{Isa, Real};
use crate::state::Workspace;

/// State of a contact point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactMode {
    /// Off the surface.
    Open = 0,
    /// On the surface, at rest along it.
    Stick = 1,
    /// On the surface, sliding.
    Slide = 2,
}

impl ContactMode {
    /// The number that stands for it in rows of lanes.
    pub const fn code(self) -> f64 {
        self as u8 as f64
    }
}

/// Writes the lanes of a mask.
#[inline(always)]
fn store_where<I: Isa>(isa: I, mask: I::M, new: I::F, row: &mut I::Row) {
    isa.store(I::F::select(mask, new, isa.load(row)), row);
}
