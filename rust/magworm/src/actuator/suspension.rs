//! Magnets that give way up and down: the stage carries them on a spring and a damper.
//!
//! Over the height of the stage, m ÿ + c ẏ + k y = F with F the vertical force of the body's magnets, equal and opposite to that
//! on them. Between two steps the oscillation is exact, (y, ẏ)⁺ = e^{AΔt} (y, ẏ), and F acts as on the velocities of the robot: half of it
//! before, half after. What is kept of ẏ lacks the half that the next step brings,
//!
//! ```text
//! (y − F/k, v + FΔt/2m)⁺ = e^{AΔt} (y − F/k, v + FΔt/2m),   A = (0, 1; −k/m, −c/m)
//! ```
//!
//! so a force that stands holds the magnets at F/k whatever the step, and one that varies is met in second order; what energy it wins or
//! loses for good is of third. No step is too long for the oscillator.

use crate::lanes::Real;
use crate::scene;

/// A suspension in a step. Its state is the deflection y [m] and v [m/s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Suspension {
    /// e^{AΔt}.
    step: [[f64; 2]; 2],
    /// 1/k [m/N] and Δt/2m [s/kg].
    per_newton: [f64; 2],
}

impl Suspension {
    /// Rows of its state.
    pub const ROWS: usize = 2;

    /// That of a scene in steps Δt.
    pub fn new(scene: &scene::Suspension, step_s: f64) -> Self {
        let scene::Suspension { mass_kg, stiffness_n_m, damping_n_s_m } = *scene;
        let rate = [[0.0, 1.0], [-stiffness_n_m / mass_kg, -damping_n_s_m / mass_kg]];
        Self {
            step: exponential(rate.map(|row| row.map(|entry| entry * step_s))),
            per_newton: [1.0 / stiffness_n_m, 0.5 * step_s / mass_kg],
        }
    }

    /// Deflection and velocity after a step under a force.
    #[inline(always)]
    pub fn advance<F: Real>(&self, [y, v]: [F; 2], force: F) -> [F; 2] {
        let [[yy, yv], [vy, vv]] = self.step;
        let [rest, kick] = self.per_newton.map(|part| force * part);
        let (y, v) = (y - rest, v + kick);
        [y * yy + v * yv + rest, y * vy + v * vv - kick]
    }
}

/// e^A, with equal bits everywhere: its series for a part A/2ⁿ that is small, squared n times.
fn exponential(a: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let size = a.iter().flatten().fold(0.0, |sum, entry| sum + entry.abs());
    if size > 0.5 {
        let half = exponential(a.map(|row| row.map(|entry| 0.5 * entry)));
        return product(half, half);
    }
    let one = [[1.0, 0.0], [0.0, 1.0]];
    // 1 + A (1 + A/2 (1 + A/3 (…))): the last term is below 2⁻⁵⁸.
    (1..=15).rev().fold(one, |sum, term| {
        let mut next = product(a, sum).map(|row| row.map(|entry| entry / f64::from(term)));
        (0..2).for_each(|k| next[k][k] += 1.0);
        next
    })
}

fn product(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let entry = |row: usize, column: usize| a[row][0] * b[0][column] + a[row][1] * b[1][column];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Place and velocity of the free oscillation from (1, 0), in closed form.
    fn free(mass: f64, stiffness: f64, damping: f64, t: f64) -> [f64; 2] {
        let (decay, square) = (0.5 * damping / mass, stiffness / mass);
        let beat = square - decay * decay;
        let (c, s) = if beat > 0.0 {
            let omega = beat.sqrt();
            ((omega * t).cos(), (omega * t).sin() / omega)
        } else {
            let omega = (-beat).sqrt();
            ((omega * t).cosh(), (omega * t).sinh() / omega)
        };
        let fading = (-decay * t).exp();
        [fading * (c + decay * s), -fading * square * s]
    }

    #[test]
    fn a_step_is_the_oscillation_in_closed_form() {
        for damping_n_s_m in [0.0, 0.3, 4.0, 40.0] {
            for step_s in [1e-5, 2e-3, 0.05] {
                let scene =
                    scene::Suspension { mass_kg: 0.05, stiffness_n_m: 200.0, damping_n_s_m };
                let suspension = Suspension::new(&scene, step_s);
                let [y, v] = suspension.advance([1.0, 0.0], 0.0);
                let [exact_y, exact_v] = free(0.05, 200.0, damping_n_s_m, step_s);
                assert!((y - exact_y).abs() < 1e-13, "{damping_n_s_m}, {step_s}: {y}, {exact_y}");
                assert!((v - exact_v).abs() < 1e-11, "{damping_n_s_m}, {step_s}: {v}, {exact_v}");
            }
        }
    }

    #[test]
    fn a_force_that_stands_deflects_it_by_force_over_stiffness() {
        let scene = scene::Suspension { mass_kg: 0.05, stiffness_n_m: 200.0, damping_n_s_m: 3.0 };
        for step_s in [1e-3, 0.05] {
            let suspension = Suspension::new(&scene, step_s);
            let still = (0..2000).fold([0.0; 2], |state, _| suspension.advance(state, -0.1));
            assert!((still[0] / -0.1 * 200.0 - 1.0).abs() < 1e-12, "{still:?}");
        }
    }
}
