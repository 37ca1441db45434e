//! A Maxwell branch over a step: a spring in series with a dashpot.
//!
//! A branch of stiffness k and relaxation time τ₁ bears s = k (ε − β), where ε is the strain of the spring that it stands beside
//! and β that of its dashpot, which flows: β̇ = (ε − β)/τ₁. While ε stands still ε − β fades as e^{−t/τ₁}, so in a step Δt
//!
//! ```text
//! β⁺ = β + f (ε − β),   f = 1 − e^{−Δt/τ₁},   and k m (ε − β) is the mean of s,   m = f τ₁/Δt
//! ```
//!
//! Each integrator says at what time ε stands for the step, and thereby what of a branch counts in the force of a spring,
//! see [`super::Coefficients::branch`]. Long steps are safe: f and m lie between 0 and 1.

/// The fading of a branch in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maxwell {
    /// f: the part of ε − β that flows into the dashpot.
    pub flow: f64,
    /// m: the mean of ε − β, as a part of what it begins with.
    pub mean: f64,
}

impl Maxwell {
    /// Over a step of this part of its relaxation time, Δt/τ₁ > 0.
    pub fn over(steps: f64) -> Self {
        let flow = flow(steps);
        Self { flow, mean: flow / steps }
    }
}

/// 1 − e^{−z}, with equal bits everywhere: its series, at half of z and of that again where z is large,
/// 1 − e^{−2y} = f (2 − f).
fn flow(z: f64) -> f64 {
    if z > 0.5 {
        let half = flow(0.5 * z);
        return half * (2.0 - half);
    }
    // z (1 − z/2 (1 − z/3 (…))): the last term is below 2⁻⁵⁸ of the sum.
    (2..=15).rev().fold(1.0, |sum, term| 1.0 - z / f64::from(term) * sum) * z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flow_is_that_of_an_exponential() {
        for k in -80..=40 {
            let steps = 1.37 * 2f64.powi(k) * 0.25;
            let Maxwell { flow, mean } = Maxwell::over(steps);
            let exact = -(-steps).exp_m1();
            assert!((flow / exact - 1.0).abs() < 1e-14, "{steps}: {flow}, {exact}");
            assert!((mean * steps / exact - 1.0).abs() < 1e-14, "{steps}: {mean}");
        }
    }
}
