//! Twist of many turns.

use crate::report::{Axes, Case, Figure};
use crate::world::{ROD, World};

/// A soft length of 0.1 m in three elements, of which half of the first is in the wall, then the magnet.
const PENDULUM: [(&str, &str); 12] = [
    ("dimensions", "3"),
    ("body.clamp", "'head'"),
    ("body.length_m", "0.14"),
    ("body.elements", "4"),
    ("body.magnets", "[{position_m=0.12,polarity=1}]"),
    ("magnet", "{length_m=0.04,width_m=0.009,height_m=0.003,remanence_t=0.0,density_kg_m3=1e5}"),
    ("material.density_kg_m3", "1.0"),
    ("material.poisson_ratio", "0.5"),
    ("material.damping_time_s", "0.0"),
    ("solver.integrator", "'explicit'"),
    ("solver.step_s", "4e-5"),
    ("control.step_s", "4e-5"),
];

/// A magnet on a rod that hardly weighs twists it by two turns either way, more than π at each node:
/// ψ = ψ₀ sin ωt, ω² = GJ/(L I), whatever the amplitude. The angle at a node is known but for whole turns; the
/// simulator must keep them.
#[test]
fn validates_space_twist_of_many_turns() {
    let mut case = Case::new("space_twist_of_many_turns", "Torsional pendulum of two turns")
        .equation("ψ = ψ₀ sin ωt, ω² = GJ/(L I)")
        .source("C.-A. de Coulomb (1784); Saint-Venant's linear law of twist")
        .scene(ROD, &PENDULUM)
        .note(
            "A heavy magnet at the tip of a rod without weight to speak of is spun so that it turns by 13 rad \
            either way. Few elements, so that a node twists by more than π. ψ is the sum of the nodes' \
            twists; beside it stands the roll of the magnet itself, both over three periods.",
        );
    let mut world = World::new(ROD, &PENDULUM);
    let dof = world.model.coordinates.bodies[0];
    let inertia = world.block.mass[dof + 3][0];
    let compliance: f64 = world.model.bend.iter().map(|b| 1.0 / b.twist_n_m).sum();
    let (b, h) = (0.01f64, 4e-3f64);
    let torsion = b * h.powi(3) * (1.0 / 3.0 - 0.21 * (h / b) * (1.0 - (h / b).powi(4) / 12.0));
    let rigidity = 100e3 / 3.0 * torsion;
    case.relative("L/GJ of the nodes in series", "rad/(N·m)", [compliance, 0.1 / rigidity], 1e-9);
    let omega = (rigidity / (0.1 * inertia)).sqrt();
    let amplitude = 13.0;
    world.block.v[dof + 3][0] = amplitude * omega;
    let (dt, period) = (world.model.step_s, std::f64::consts::TAU / omega);
    let parts = 100;
    let stride = (3.0 * period / dt / f64::from(parts)).round() as u32;
    let (mut sums, mut rolls, mut most) = (Vec::new(), Vec::new(), 0.0f64);
    let mut figure = Figure::new("Torsional pendulum", "t [s]", "ψ [rad]", Axes::Linear);
    let mut found = Vec::new();
    for part in 1..=parts {
        world.steps(stride);
        world.refresh();
        // The twist is looked at by the next step, so it is recomputed by one of a copy.
        let mut next = World { model: world.model.clone(), block: world.block.clone() };
        next.steps(1);
        let time = f64::from(part * stride) * dt;
        let exact = amplitude * (omega * time).sin();
        let sum: f64 = next.block.twist.iter().map(|row| row[0]).sum();
        most = next.block.twist.iter().map(|row| row[0].abs()).fold(most, f64::max);
        sums.push((sum - exact) / amplitude);
        let up = world.up(world.last() - 1);
        let off = up.z.atan2(up.y) - exact;
        rolls.push(off - (off / std::f64::consts::TAU).round() * std::f64::consts::TAU);
        found.push([time, sum]);
    }
    case.spread("ψ, sum of the nodes' twists", "of ψ₀", &sums, 5e-4);
    case.spread("ψ, roll of the magnet but for turns", "rad", &rolls, 0.01);
    case.inside("greatest twist of a node", "rad", most, std::f64::consts::PI..=f64::INFINITY);
    let aside = world.places().iter().map(|p| p.y.hypot(p.z)).fold(0.0, f64::max);
    case.at_most("distance from the axis", "m", aside, 1e-9);
    let end = 3.0 * period;
    figure.exact(
        "closed form",
        (0..=400).map(|k| {
            let time = end * f64::from(k) / 400.0;
            [time, amplitude * (omega * time).sin()]
        }),
    );
    figure.points("simulator", found);
    case.figure(figure);
    case.finish();
}
