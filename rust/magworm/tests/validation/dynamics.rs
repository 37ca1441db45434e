//! Vibrations of a clamped rod.

use crate::beam::mode_shape;
use crate::world::{ROD, World, number};
use magworm::model::Anchor;

const LENGTH_M: f64 = 0.1;
const THICKNESS_M: f64 = 4e-3;
/// Amplitude over length: nonlinear terms are of the order of its square, 1e-6.
const AMPLITUDE: f64 = 1e-3;

/// ω = (βL)² √(EI/ρAL⁴) of a slender cantilever.
fn exact_rad_s(beta: f64) -> f64 {
    beta * beta * (100e3 * THICKNESS_M.powi(2) / 12.0 / 1000.0).sqrt() / LENGTH_M.powi(2)
}

/// A cantilever that moves in one of its modes: deflection 0, velocity ω a L times the shape.
fn in_mode(beta: f64, edits: &[(&str, &str)]) -> World {
    let mut all = vec![("body.clamp", "'head'"), ("body.elements", "40")];
    all.extend_from_slice(edits);
    let mut world = World::new(ROD, &all);
    let speed = exact_rad_s(beta) * AMPLITUDE * LENGTH_M;
    world.set_velocity(|[x, _]| [0.0, 0.5 * speed * mode_shape(beta, x / LENGTH_M)], 0.0);
    world
}

/// Amplitude of a mode: its projection on the mass.
fn amplitude(world: &World, beta: f64) -> f64 {
    let place = |anchor: &Anchor| match *anchor {
        Anchor::Free { dof } => Some(dof),
        _ => None,
    };
    let dofs = world.model.coordinates.anchors.iter().filter_map(place);
    dofs.map(|dof| {
        let shape = mode_shape(beta, world.block.q[dof][0] / LENGTH_M);
        world.block.mass[dof + 1][0] * shape * world.block.q[dof + 1][0]
    })
    .sum()
}

/// Angular frequency and decay rate from the zero crossings and peaks of a mode over `periods`.
fn vibration(world: &mut World, beta: f64, periods: usize) -> (f64, f64) {
    let dt = world.model.step_s;
    let (mut before, mut crossings, mut peaks, mut peak) = (0.0, Vec::new(), Vec::new(), 0.0f64);
    let mut step = 0.0;
    while crossings.len() <= 2 * periods {
        world.steps(1);
        step += 1.0;
        let now = amplitude(world, beta);
        peak = peak.max(now.abs());
        if before * now < 0.0 {
            crossings.push(dt * (step - now / (now - before)));
            peaks.push(std::mem::take(&mut peak));
        }
        before = now;
    }
    let last = crossings.len() - 1;
    let span = crossings[last] - crossings[0];
    let omega = std::f64::consts::PI * last as f64 / span;
    (omega, (peaks[1] / peaks[last]).ln() / (span * (last as f64 - 1.0) / last as f64))
}

/// First two natural frequencies, βL = 1.8751 and 4.6941, with the explicit scheme (which does not damp):
/// the mesh's error is (βL/n)²/12-like, 1.2e-3 for the second at 40 elements, hence 3e-3.
#[test]
fn validates_cantilever_frequencies() {
    for (beta, periods) in [(1.87510407, 2), (4.69409113, 5)] {
        let edits = [
            ("solver.integrator", "'explicit'"),
            ("solver.step_s", "2e-5"),
            ("control.step_s", "2e-5"),
        ];
        let mut world = in_mode(beta, &edits);
        let (omega, decay) = vibration(&mut world, beta, periods);
        let error = omega / exact_rad_s(beta) - 1.0;
        println!(
            "mode βL {beta:.4}: ω {omega:.4} rad/s error {error:.2e}, decay/ω {:.1e}",
            decay / omega
        );
        assert!(error.abs() < 3e-3);
        assert!((decay / omega).abs() < 1e-6);
    }
}

/// The implicit scheme's first mode with short steps. Backward Euler turns e^{iωt} into (1 − iωΔt)^{−n}: the
/// frequency is atan(ωΔt)/Δt and the decay ln(1 + ω²Δt²)/2Δt, so both are predicted exactly.
#[test]
fn validates_implicit_frequency() {
    let beta = 1.87510407;
    for step in [2e-3, 5e-4] {
        let text = number(step);
        let mut world = in_mode(beta, &[("solver.step_s", &text), ("control.step_s", &text)]);
        let (omega, decay) = vibration(&mut world, beta, 3);
        let phase = exact_rad_s(beta) * step;
        let (tuned, lost) = (phase.atan() / step, (phase * phase).ln_1p() / (2.0 * step));
        let errors = [omega / tuned - 1.0, decay / lost - 1.0];
        println!(
            "implicit, step {step} s: ω error {:.2e}, decay error {:.2e}",
            errors[0], errors[1]
        );
        // The mesh gives 2e-4; the peaks are sampled once a step, (ωΔt)²/8 off at most.
        assert!(errors[0].abs() < 1e-3 && errors[1].abs() < 1e-2);
    }
}

/// Kelvin–Voigt damping: a mode decays with τω²/2 and no more (ω = 4.06 rad/s, τ = 1 ms: 0.8 % a second).
#[test]
fn validates_kelvin_voigt_decay() {
    let beta = 1.87510407;
    let edits = [
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "1e-5"),
        ("control.step_s", "1e-5"),
        ("material.damping_time_s", "0.001"),
    ];
    let mut world = in_mode(beta, &edits);
    let (omega, decay) = vibration(&mut world, beta, 2);
    let error = decay / (0.001 * omega * omega / 2.0) - 1.0;
    println!("Kelvin–Voigt: decay {decay:.5} 1/s, error {error:.2e}");
    // Over 1.5 periods the logarithm is 0.02; a peak sampled every 10 µs is good to (ωΔt)²/8 = 2e-10.
    assert!(error.abs() < 1e-3);
}

/// The undamped heavy cantilever let go from the horizontal: an extensible Kirchhoff rod has its tip at
/// (52.708, −11.759) mm after 1 s. Two methods differ by less than 1e-2 L only where their models agree, so
/// 1e-2 L = 0.54 mm is the bound.
#[test]
fn validates_dynamic_cantilever() {
    let edits = [
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "1e-5"),
        ("material.damping_time_s", "0.0"),
        ("body.elements", "54"),
    ];
    let mut world = World::new("cantilever", &edits);
    world.run(1.0);
    let [x, y] = world.node(world.last());
    let error = (x - 52.708e-3).hypot(y + 11.759e-3);
    println!(
        "heavy cantilever after 1 s: ({:.3}, {:.3}) mm, error {:.1e} L",
        x * 1e3,
        y * 1e3,
        error / 0.054
    );
    assert!(error < 0.54e-3);
}
