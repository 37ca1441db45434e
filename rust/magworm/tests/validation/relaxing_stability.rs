//! Rubber that relaxes in random ways: no step makes a motion grow. `PROPTEST_CASES` sets the number of scenes.

use crate::world::{ROD, World, number};
use magworm::internals::Draws;
use nalgebra::DMatrix;
use proptest::prelude::*;

/// As many cases as the environment asks for, else these.
fn cases(usual: u32) -> ProptestConfig {
    let asked = std::env::var_os("PROPTEST_CASES").map(|_| ProptestConfig::default().cases);
    ProptestConfig { cases: asked.unwrap_or(usual), ..ProptestConfig::default() }
}

fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..=high.ln()).prop_map(move |x| x.exp().clamp(low, high))
}

/// One to five branches as TOML.
fn branches() -> impl Strategy<Value = String> {
    let branch = (decades(1e-3, 100.0), decades(1e-6, 1e4))
        .prop_map(|(ratio, time_s)| format!("{{ ratio = {ratio:e}, time_s = {time_s:e} }}"));
    prop::collection::vec(branch, 1..=5).prop_map(|all| format!("[{}]", all.join(", ")))
}

/// Modulus, density, retardation time: rubber as soft, stiff, light and heavy as a scene may have it.
fn rubber() -> impl Strategy<Value = [(&'static str, String); 4]> {
    let damping_s = prop_oneof![Just(0.0), decades(1e-6, 1.0)];
    (decades(1e2, 1e11), decades(1.0, 1e5), damping_s, branches()).prop_map(
        |(modulus_pa, density_kg_m3, damping_s, branches)| {
            [
                ("material.youngs_modulus_pa", number(modulus_pa)),
                ("material.density_kg_m3", number(density_kg_m3)),
                ("material.damping_time_s", number(damping_s)),
                ("material.relaxation", branches),
            ]
        },
    )
}

/// A rod of this rubber with other edits.
fn rod(rubber: &[(&'static str, String); 4], step_s: f64, more: &[(&str, &str)]) -> World {
    let step = number(step_s);
    let time = ["solver.step_s", "control.step_s", "control.episode_s"];
    let mut edits = time.map(|field| (field, step.as_str())).to_vec();
    edits.extend(rubber.iter().map(|(path, text)| (*path, text.as_str())));
    edits.extend_from_slice(more);
    World::new(ROD, &edits)
}

/// A mass on a spring whose step is a matrix: what one step makes of place, velocity, lagging velocity and each dashpot.
fn step_matrix(world: &World) -> DMatrix<f64> {
    const SMALL_M: f64 = 1e-7;
    let step_s = world.model.step_s;
    let dashpots = world.block.stretch_dashpot.len();
    let scales = |k: usize| if k == 1 || k == 2 { SMALL_M / step_s } else { SMALL_M };
    let state = |world: &World| -> Vec<f64> {
        let block = &world.block;
        let first = [block.q[0][0], block.v[0][0], block.spring_velocity[0][0]];
        first.into_iter().chain(block.stretch_dashpot.iter().map(|row| row[0])).collect()
    };
    let rest = state(world);
    let columns = (0..3 + dashpots).map(|k| {
        let mut moved = World { model: world.model.clone(), block: world.block.clone() };
        let block = &mut moved.block;
        match k {
            0 => block.q[0][0] += SMALL_M,
            1 => block.v[0][0] += scales(k),
            2 => block.spring_velocity[0][0] += scales(k),
            _ => block.stretch_dashpot[k - 3][0] += SMALL_M,
        }
        moved.steps(1);
        let column: Vec<f64> = state(&moved)
            .into_iter()
            .zip(&rest)
            .enumerate()
            .map(|(row, (after, rest))| (after - rest) / scales(row))
            .collect();
        nalgebra::DVector::from_vec(column)
    });
    DMatrix::from_columns(&columns.collect::<Vec<_>>())
}

/// By how much a step makes motions grow in the long run, the spectral radius: ‖Mⁿ‖^{1/n} for n = 2³⁰ (Gelfand).
fn growth(world: &World) -> f64 {
    let (mut power, mut logarithm) = (step_matrix(world), 0.0);
    for doublings in 0..30 {
        let norm = power.norm();
        logarithm += norm.ln() / f64::from(1 << doublings);
        power /= norm;
        power = &power * &power;
    }
    logarithm.exp()
}

const OSCILLATOR: [(&str, &str); 2] = [("body.clamp", "'head'"), ("body.elements", "2")];

proptest! {
    #![proptest_config(cases(2000))]

    /// However stiff, light, damped and quick to relax the rubber is, and however long the step.
    #[test]
    fn no_step_of_an_implicit_scheme_makes_a_vibration_grow(
        rubber in rubber(),
        step_s in decades(1e-5, 0.05),
        euler: bool,
    ) {
        let scheme = ("solver.integrator", if euler { "'euler'" } else { "'newmark'" });
        let growth = growth(&rod(&rubber, step_s, &[&OSCILLATOR[..], &[scheme]].concat()));
        prop_assert!(growth < 1.0 + 1e-6, "{growth}");
    }

    /// The limit of the explicit scheme counts every branch.
    #[test]
    fn no_step_within_the_explicit_limit_makes_a_vibration_grow(rubber in rubber()) {
        let implicit = rod(&rubber, 1e-3, &OSCILLATOR);
        let limit_s = implicit.model.explicit_limit().step_s.min(0.05);
        // No scene has shorter steps.
        if limit_s < 1.01e-7 {
            return Ok(());
        }
        let scheme = [("solver.integrator", "'explicit'")];
        let growth = growth(&rod(&rubber, 0.999 * limit_s, &[&OSCILLATOR[..], &scheme].concat()));
        prop_assert!(growth < 1.0 + 1e-6, "{growth}");
    }

    /// A free rod that is struck: kinetic and elastic energy with that of the branches, by Euler's scheme.
    #[test]
    fn the_energy_of_a_free_rod_never_grows(
        density_kg_m3 in decades(1.0, 1e5),
        phase in decades(1e-3, 100.0),
        damping_s in prop_oneof![Just(0.0), decades(1e-6, 1.0)],
        branches in branches(),
        step_s in decades(1e-5, 0.05),
        elements in 2..6usize,
        seed: u64,
    ) {
        // Waves along an element pass by this phase in a step.
        let element_m = 0.1 / elements as f64;
        let speed_m_s = phase * element_m / step_s;
        let modulus_pa = (density_kg_m3 * speed_m_s * speed_m_s).clamp(1e2, 1e11);
        let rubber = [
            ("material.youngs_modulus_pa", number(modulus_pa)),
            ("material.density_kg_m3", number(density_kg_m3)),
            ("material.damping_time_s", number(damping_s)),
            ("material.relaxation", branches),
        ];
        let elements = elements.to_string();
        let more = [("solver.integrator", "'euler'"), ("body.elements", elements.as_str())];
        let mut world = rod(&rubber, step_s, &more);
        let mut draws = Draws::new(seed, 0);
        // So slow that a turning element is stretched by nothing that would matter: the schemes are linearly implicit.
        let speed_m_s = 1e-5 / (1.0 + 10.0 * phase) * element_m / step_s;
        for row in world.block.v.iter_mut() {
            row[0] = draws.uniform(-speed_m_s, speed_m_s);
        }
        let mut before = energy(&world);
        for step in 0..30 {
            world.steps(1);
            let after = energy(&world);
            prop_assert!(after <= before * (1.0 + 1e-6), "step {step}: {before:e} to {after:e}");
            before = after;
        }
    }
}

/// Kinetic energy, that of the springs, and that of the branches once their dashpots have flowed with the strain as it stands [J].
fn energy(world: &World) -> f64 {
    let model = &world.model;
    let edge = |element: usize| {
        let [a, b] = [element, element + 1].map(|node| world.node(node));
        [b[0] - a[0], b[1] - a[1]]
    };
    let stretches = model.stretch.iter().map(|spring| {
        let [x, y] = edge(spring.element);
        (x.hypot(y) - spring.rest_m, spring.stiffness_n_m)
    });
    let bends = model.bend.iter().map(|spring| {
        let (e, f) = (edge(spring.node - 1), edge(spring.node));
        let turn = (e[0] * f[1] - e[1] * f[0]).atan2(e[0] * f[0] + e[1] * f[1]);
        (turn, spring.stiffness_n_m)
    });
    let branches = &model.scene.material.relaxation;
    let dashpots = world.block.stretch_dashpot.iter().chain(world.block.bend_dashpot.iter());
    let dashpots: Vec<f64> = dashpots.map(|row| row[0]).collect();
    let of_springs = stretches.chain(bends).zip(dashpots.chunks(branches.len()));
    let elastic = of_springs.map(|((strain, stiffness), dashpots)| {
        let relaxing = branches.iter().zip(dashpots).map(|(branch, dashpot)| {
            let left = (strain - dashpot) * (-model.step_s / branch.time_s).exp();
            branch.ratio * left * left
        });
        0.5 * stiffness * (strain * strain + relaxing.sum::<f64>())
    });
    world.kinetic() + elastic.sum::<f64>()
}
