//! A drive that gives way, against the damped oscillator in closed form.

use crate::report::{Axes, Case, Figure, farthest_from, orders};
use crate::world::{ROD, World, number};
use magworm::internals::magnetic::{Cuboid, PlanarPair};

const MASS_KG: f64 = 0.05;
const STIFFNESS_N_M: f64 = 200.0;
const SOURCE: &str = "any textbook of vibrations";

/// A magnet that a stiff, short lever holds still, and a drive magnet beneath it.
const HELD: [(&str, &str); 7] = [
    ("material.youngs_modulus_pa", "1e11"),
    ("body.length_m", "0.03"),
    ("body.thickness_m", "0.03"),
    ("body.elements", "3"),
    ("body.clamp", "'head'"),
    ("magnet", "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}"),
    ("body.magnets", "[{position_m=0.022,polarity=1}]"),
];

/// Drive magnets beneath it on a suspension.
fn drive(height_m: f64, remanence_t: f64, damping_n_s_m: f64) -> String {
    format!(
        "{{length_m=0.015,width_m=0.026,height_m=0.004,remanence_t={remanence_t:e},\
         motion={{kind='constant',x_m=0.022,y_m={height_m:e},speed_m_s=0.0}},\
         suspension={{mass_kg={MASS_KG:e},stiffness_n_m={STIFFNESS_N_M:e},damping_n_s_m={damping_n_s_m:e}}}}}"
    )
}

fn world(drive: &str, step_s: f64) -> World {
    let step = number(step_s);
    let time = ["solver.step_s", "control.step_s", "control.episode_s"];
    let time = time.map(|field| (field, step.as_str()));
    World::new(ROD, &[&HELD[..], &time, &[("drive", drive)]].concat())
}

/// What the magnets gave way by [m], and the velocity that is kept of it [m/s].
fn deflection(world: &World) -> [f64; 2] {
    let rows = &world.block.stage;
    [rows[rows.len() - 2][0], rows[rows.len() - 1][0]]
}

fn deflect(world: &mut World, deflection_m: f64) {
    let row = world.block.stage.len() - 2;
    world.block.stage[row][0] = deflection_m;
}

/// Let go from 1 mm where no magnet pulls.
#[test]
fn validates_free_suspension() {
    let mut case = Case::new("free_suspension", "A drive that gives way, let go")
        .equation("y = y₀ e^{−δt} (cos ω′t + δ/ω′ sin ω′t), δ = c/2m, ω′ = √(k/m − δ²)")
        .source(SOURCE)
        .scene(ROD, &[&HELD[..], &[("drive", "…")]].concat())
        .note("m = 50 g, k = 200 N/m, c = 0 and 0.6 N·s/m; steps of 2 ms, and of 20 ms, a fifth of a period.");
    for (damping, step_s) in [(0.0, 2e-3), (0.6, 2e-3), (0.6, 0.02)] {
        let mut world = world(&drive(-0.05, 0.0, damping), step_s);
        deflect(&mut world, 1e-3);
        world.run(0.5);
        let decay = 0.5 * damping / MASS_KG;
        let omega = (STIFFNESS_N_M / MASS_KG - decay * decay).sqrt();
        let (sin, cos) = (omega * 0.5).sin_cos();
        let exact = 1e-3 * (-decay * 0.5).exp() * (cos + decay / omega * sin);
        let what = format!("after 0.5 s, c = {damping} N·s/m, Δt = {step_s} s");
        case.relative(what, "m", [deflection(&world)[0], exact], 1e-10);
    }
    case.finish();
}

/// The force on a drive magnet over its height, y less that of the body's magnet: that of a held magnet on it.
fn force(model: &magworm::Model, height_m: f64) -> f64 {
    let cuboid = |[length_m, height_m, width_m]: [f64; 3]| Cuboid { length_m, height_m, width_m };
    let (source, body) = (cuboid([0.015, 0.004, 0.026]), cuboid([8e-3, 2e-3, 8e-3]));
    let pair = PlanarPair::new(source, body, model.scene.solver.quadrature_order);
    -pair.wrench(0.0, -height_m, 1.0, 0.0, 1.22 * 1.22)[1]
}

/// Pulled by a magnet above it the drive rests where its spring bears the force.
#[test]
fn validates_suspension_at_rest() {
    let mut case = Case::new("suspension_at_rest", "A drive that gives way, at rest")
        .equation("k y = F(y)")
        .source(SOURCE)
        .scene(ROD, &[&HELD[..], &[("drive", "…")]].concat())
        .note("F is the force of the pair of magnets where they end up; steps of 2 and 20 ms.");
    for step_s in [2e-3, 0.02] {
        let mut world = world(&drive(-0.022, 1.22, 3.0), step_s);
        world.run(2.0);
        let [y, _] = deflection(&world);
        assert!(y > 1e-4, "it is pulled up: {y}");
        let bears = STIFFNESS_N_M * y;
        let what = format!("k y, Δt = {step_s} s");
        case.relative(what, "N", [bears, force(&world.model, y - 0.022)], 1e-6);
    }
    case.finish();
}

/// Energies of an undamped drive that swings beneath a magnet for some periods, over its greatest elastic energy: its own, and that
/// of the magnets as the work of their force.
fn energies(step_s: f64, periods: f64) -> Vec<f64> {
    let mut world = world(&drive(-0.022, 1.22, 0.0), step_s);
    let period_s = std::f64::consts::TAU * (MASS_KG / STIFFNESS_N_M).sqrt();
    let (mut all, mut greatest) = (Vec::new(), 0.0f64);
    for _ in 0..(periods * period_s / step_s) as usize {
        world.steps(1);
        let [y, kept] = deflection(&world);
        let pull = force(&world.model, y - 0.022);
        let speed = kept + 0.5 * step_s / MASS_KG * pull;
        let (kinetic, elastic) = (0.5 * MASS_KG * speed * speed, 0.5 * STIFFNESS_N_M * y * y);
        greatest = greatest.max(elastic);
        all.push(kinetic + elastic - work(&world.model, y));
    }
    all.iter().map(|energy| energy / greatest).collect()
}

/// What goes in and out within a period is of second order in the step, what is lost or won for good of third.
#[test]
fn validates_energy_of_a_suspension() {
    let mut case = Case::new("energy_of_a_suspension", "Energy of a drive that gives way")
        .equation("½ m ẏ² + ½ k y² − ∫F dy = const.")
        .source("Conservation of energy")
        .scene(ROD, &[&HELD[..], &[("drive", "…")]].concat())
        .note(
            "The drive is let go 22 mm beneath a magnet that is held still, without damping. The work is summed by Simpson's rule in \
            the test, parts are of the greatest elastic energy. The drift compares means over the first and the last tenth of \
            100 periods.",
        );
    let steps_s = [4e-3, 2e-3, 1e-3];
    let greatest = |all: Vec<f64>| all.iter().map(|energy| energy.abs()).fold(0.0, f64::max);
    let errors = steps_s.map(|step_s| greatest(energies(step_s, 3.0)));
    let drift = |all: &[f64]| {
        let tenth = all.len() / 10;
        let mean = |some: &[f64]| some.iter().sum::<f64>() / some.len() as f64;
        mean(&all[9 * tenth..]) - mean(&all[..tenth])
    };
    let long = steps_s.map(|step_s| energies(step_s, 100.0));
    let drifts: Vec<f64> = long.iter().map(|all| drift(all)).collect();
    case.at_most("greatest error in three periods, Δt = 2 ms", "", errors[1], 1e-3);
    case.inside("its order in Δt", "", farthest_from(2.0, &orders(&errors)), 1.9..=2.1);
    case.inside("drift, Δt = 2 ms", "", drifts[1], -3e-3..=3e-3);
    case.inside("its order in Δt", "", farthest_from(3.0, &orders(&drifts)), 2.8..=3.2);
    let mut figure = Figure::new(
        "Energy over 100 periods, Δt = 2 ms",
        "s",
        "energy over the greatest elastic energy",
        Axes::Linear,
    );
    let points = long[1].iter().enumerate().step_by(29);
    figure.points("drive", points.map(|(k, energy)| [(k + 1) as f64 * 2e-3, *energy]));
    case.figure(figure);
    case.finish();
}

/// ∫F dy from 0 by Simpson's rule.
fn work(model: &magworm::Model, y: f64) -> f64 {
    const PARTS: usize = 16;
    let at = |part: usize| force(model, y * part as f64 / PARTS as f64 - 0.022);
    let sum: f64 = (0..PARTS / 2).map(|k| at(2 * k) + 4.0 * at(2 * k + 1) + at(2 * k + 2)).sum();
    sum * y / (3 * PARTS) as f64
}

/// It says so, and a scene without a suspension says nothing of it.
#[test]
fn a_drive_that_gives_way_is_explained() {
    let told = world(&drive(-0.022, 1.22, 0.6), 2e-3).model.explain();
    assert!(told.contains("the stage gives way at 10.066 Hz, damping ratio 0.095"), "{told}");
    assert!(!World::new("robot", &[]).model.explain().contains("gives way"));
}
