//! Energy of undamped motions in space.

use crate::report::Case;
use crate::space_derivatives::elastic_energy;
use crate::space_flight::flying;
use crate::space_frames::{WRITHING, whirl};
use crate::world::{ROD, World, number};

/// Greatest deviation of the energy from its mean, and the difference of its means over the last and the first
/// quarter, as parts of the mean.
fn wander(world: &mut World, seconds: f64) -> [f64; 2] {
    let samples = 2000;
    let stride = (seconds / world.model.step_s / f64::from(samples)).round() as u32;
    let energies: Vec<f64> = (0..samples)
        .map(|_| {
            world.steps(stride);
            world.refresh();
            world.kinetic_in_space() + elastic_energy(world)
        })
        .collect();
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (all, quarter) = (mean(&energies), energies.len() / 4);
    let most = energies.iter().map(|energy| (energy / all - 1.0).abs()).fold(0.0, f64::max);
    let drift = (mean(&energies[3 * quarter..]) - mean(&energies[..quarter])) / all;
    [most, drift]
}

/// The explicit scheme keeps the energy of an undamped rod, bending, twisting and writhing without gravity: it wavers in
/// proportion to the step and does not drift. The stiff bending and stretching of the flying rod waver most.
#[test]
fn validates_space_energy() {
    let mut case = Case::new("space_energy", "Energy of undamped motions in space")
        .equation("Σ ½ m v² + Σ ½ ω·Iω + Σ ½ I_t θ̇² + Σ ½ k s² = const.")
        .source("Conservation of energy; the elastic energy is the one written down in the test of forces")
        .scene(ROD, &[&WRITHING[..], &[("gravity_m_s2", "0.0")]].concat())
        .note(
            "Explicit scheme. *Writhing*: the clamped rod of the frames above, over 2 s. *Flying*: the free rod \
            with two magnets of the free flight, over 0.2 s. Means over the first and the last quarter of 2000 \
            samples give the drift.",
        );
    let writhing = [5e-5, 2.5e-5].map(|step| {
        let step = number(step);
        let edits = [("gravity_m_s2", "0.0"), ("solver.step_s", &step), ("control.step_s", &step)];
        let mut world = World::new(ROD, &[&WRITHING[..], &edits].concat());
        whirl(&mut world);
        wander(&mut world, 2.0)
    });
    let flying = ["2e-5", "1e-5"].map(|step| wander(&mut flying("'explicit'", step, "0.0"), 0.2));
    for (name, [coarse, fine], steps, band) in
        [("writhing", writhing, [50, 25], 1e-3), ("flying", flying, [20, 10], 3e-2)]
    {
        for ([most, drift], step) in [coarse, fine].into_iter().zip(steps) {
            case.at_most(format!("deviation, {name}, Δt = {step} µs"), "of the energy", most, band);
            let what = format!("drift, {name}, Δt = {step} µs");
            case.inside(what, "of the energy", drift, -1e-3..=1e-3);
        }
        let order = (coarse[0] / fine[0]).log2();
        case.inside(format!("order of the deviation in Δt, {name}"), "", order, 0.8..=2.2);
    }
    case.finish();
}
