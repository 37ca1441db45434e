//! Energy of undamped rods over long times, explicit scheme.

use crate::beam::mode_shape;
use crate::derivatives::energy_of_world;
use crate::report::{Axes, Case, Figure, orders};
use crate::world::{ROD, World};

const BETA: f64 = 1.87510407;
const LENGTH_M: f64 = 0.1;
/// First period of the rod of `ROD`, clamped: 2π/(βL)² √(ρAL⁴/EI) with EI/ρA = E h²/12ρ.
fn period_s() -> f64 {
    let speed = (100e3 * 4e-3f64.powi(2) / 12.0 / 1000.0).sqrt();
    std::f64::consts::TAU * LENGTH_M.powi(2) / (BETA * BETA * speed)
}

const SWINGING: [(&str, &str); 2] = [("body.clamp", "'head'"), ("solver.integrator", "'explicit'")];
const MAGNET: [(&str, &str); 2] = [
    ("magnet", "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}"),
    ("body.magnets", "[{position_m=0.05,polarity=1}]"),
];

/// Energies of the rod at the ends of `samples` equal times within each of some periods, over that at the start. The
/// rod swings in its first mode, the tip's speed that of an amplitude of a fifth of its length.
fn energies(step: &str, periods: u32, more: &[(&str, &str)]) -> Vec<f64> {
    const SAMPLES: u32 = 50;
    let fit = [("solver.step_s", step), ("control.step_s", step)];
    let mut world = World::new(ROD, &[&SWINGING[..], &fit, more].concat());
    let speed = 0.2 * LENGTH_M * std::f64::consts::TAU / period_s();
    world.set_velocity(|[x, _]| [0.0, 0.5 * speed * mode_shape(BETA, x / LENGTH_M)], 0.0);
    let start = world.kinetic();
    let steps = (period_s() / f64::from(SAMPLES) / world.model.step_s).round() as u32;
    (0..periods * SAMPLES)
        .map(|_| {
            world.steps(steps);
            (world.kinetic() + energy_of_world(&world)) / start
        })
        .collect()
}

fn largest_error(energies: &[f64]) -> f64 {
    energies.iter().map(|energy| (energy - 1.0).abs()).fold(0.0, f64::max)
}

fn mean(energies: &[f64]) -> f64 {
    energies.iter().sum::<f64>() / energies.len() as f64
}

/// An undamped rod that swings by a fifth of its length keeps its energy over 100 periods: symplectic Euler's error
/// oscillates in proportion to the step and does not drift.
#[test]
fn validates_energy_over_hundred_periods() {
    let mut case = Case::new("energy_over_hundred_periods", "Energy over 100 periods")
        .equation("Σ ½ m v² + Σ ½ (EA/l) Δl² + Σ ½ (EI/l) κ² = const.")
        .source(
            "Symplectic Euler conserves a nearby energy: E. Hairer, C. Lubich, G. Wanner, \
            Geometric Numerical Integration, ch. IX",
        )
        .scene(ROD, &[&SWINGING[..], &[("solver.step_s", "1e-4")]].concat())
        .note(
            "The undamped rod starts straight with the velocity of its first mode, such that \
            the tip swings by 0.2 L; without gravity. The elastic energy is computed in the test \
            from the places of the nodes by its own formula. The drift compares means over the \
            first and the last ten periods; `explicit_energy` repeats it under gravity.",
        );
    let mut figure = Figure::new(
        "Energy over 100 periods, Δt = 0.1 ms",
        "periods",
        "energy / energy at the start − 1",
        Axes::Linear,
    );
    for (name, more) in [("rod", &[][..]), ("rod with a magnet", &MAGNET[..])] {
        let all = energies("1e-4", 100, more);
        let tenth = all.len() / 10;
        case.at_most(format!("largest error of the energy, {name}"), "", largest_error(&all), 2e-3);
        let drift = mean(&all[9 * tenth..]) - mean(&all[..tenth]);
        case.inside(format!("drift over 100 periods, {name}"), "", drift, -1e-4..=1e-4);
        let points =
            all.iter().enumerate().step_by(7).map(|(k, e)| [(k + 1) as f64 / 50.0, e - 1.0]);
        figure.points(name, points);
    }
    let errors = ["2e-4", "1e-4", "5e-5"].map(|step| largest_error(&energies(step, 3, &[])));
    let found = orders(&errors);
    case.inside("order in Δt, 0.2 to 0.1 ms", "", found[0], 0.8..=1.2);
    case.inside("order in Δt, 0.1 to 0.05 ms", "", found[1], 0.8..=1.2);
    case.figure(figure);
    case.finish();
}
