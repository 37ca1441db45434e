//! The largest stable step of the explicit scheme.
//!
//! For an oscillation of angular frequency ω and a retardation time τ the scheme reads
//!
//! ```text
//! v⁺ = v − Δt ω² (q + τ v),   q⁺ = q + Δt v⁺
//! ```
//!
//! The roots z of z² − (2 − Δt τ ω² − Δt² ω²) z + 1 − Δt τ ω² stay within the unit circle while
//! Δt² ω² + 2 Δt τ ω² ≤ 4 (Jury's criterion), hence
//!
//! Δt ≤ (4/ω²) / (τ + √(τ² + 4/ω²)),
//!
//! which is 2/ω without damping and 2/(τω²) where damping dominates, τω ≫ 1. Branches of rubber that relaxes are taken for springs:
//! ω² counts (1 + Σ r) times and τ as much less. With a dashpot that takes the greatest part of a branch
//! within a step somewhat longer ones were stable too. It falls with ω, so the fastest oscillation
//! of the rod at rest decides, see [`super::waves`]. Multipliers hold the magnets rigid and bring no frequency of their
//! own; contact is implicit. The limit is that of small motions about the straight rod: an element squeezed to a share s
//! of its length bends faster by 1/s. Factors that an environment is given for itself do not count, those that a
//! reset draws do.

use super::Model;
use super::waves::{self, Fastest, Wave};
use crate::scene::{Parameter, Problem, quantity};

/// The largest stable step, and what limits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExplicitLimit {
    /// The largest stable step [s]; infinite where nothing can move.
    pub step_s: f64,
    /// The oscillation that limits it.
    pub wave: Wave,
    /// The element that stretches most in it, or the node that bends or twists most.
    pub place: usize,
    /// τω: beyond 1 its Kelvin–Voigt damping limits the step, not its frequency.
    pub damping: f64,
}

impl Model {
    /// The largest stable step of the explicit scheme for this body, whatever scheme the scene asks for; as if its centres of
    /// mass lay in the middle of their elements, see [`super::OffCentre`].
    pub fn explicit_limit(&self) -> ExplicitLimit {
        let most = waves::draw(self, Parameter::Damping, |vary| vary.high);
        let material = &self.scene.material;
        let stiffer = 1.0 + material.relaxing_ratio();
        let damping_s = most * material.damping_time_s / stiffer;
        let limits = waves::fastest(self).into_iter().map(|one| limit(one, stiffer, damping_s));
        let shortest = limits.min_by(|a, b| a.step_s.total_cmp(&b.step_s));
        shortest.expect("every rod can stretch")
    }
}

fn limit(fastest: Fastest, stiffer: f64, damping_s: f64) -> ExplicitLimit {
    let Fastest { wave, place, rate_s2 } = fastest;
    let rate_s2 = stiffer * rate_s2;
    let square_s2 = 4.0 / rate_s2;
    let step_s = square_s2 / (damping_s + (damping_s * damping_s + square_s2).sqrt());
    let step_s = if rate_s2 > 0.0 { step_s } else { f64::INFINITY };
    ExplicitLimit { step_s, wave, place, damping: damping_s * rate_s2.sqrt() }
}

impl ExplicitLimit {
    /// What limits the step, in words: "the axial wave in element 3".
    pub fn reason(&self) -> String {
        let (before, place) = (self.place.saturating_sub(1), self.place);
        let wave = match self.wave {
            Wave::Stretching => format!("the axial wave in element {place}"),
            Wave::Bending => format!("bending between elements {before} and {place}"),
            Wave::BendingAcross => {
                format!("bending to the side between elements {before} and {place}")
            }
            Wave::Twisting => format!("twisting between elements {before} and {place}"),
        };
        if self.damping > 1.0 { format!("Kelvin–Voigt damping of {wave}") } else { wave }
    }

    /// # Errors
    /// A step beyond the limit.
    pub(super) fn check(&self, step_s: f64) -> Result<(), Problem> {
        if step_s <= self.step_s {
            return Ok(());
        }
        Err(Problem::Value {
            field: "solver.step_s".into(),
            value: quantity(step_s, "s"),
            allowed: format!(
                "at most {} where solver.integrator is \"explicit\": a longer step would make {} grow \
                 (elements count from 0 at the head)",
                quantity(rounded_down(self.step_s), "s"),
                self.reason()
            ),
        })
    }
}

/// Cut to three digits, so that what a message says is itself allowed.
fn rounded_down(step_s: f64) -> f64 {
    let text = format!("{step_s:e}");
    let (digits, exponent) = text.split_once('e').expect("a number in scientific notation");
    let digits = &digits[..digits.len().min(4)];
    format!("{digits}e{exponent}").parse().expect("digits and an exponent")
}
