//! No control step is rewarded that a robot ended sunk, overstretched, not finite or too fast.

use magworm::LaneChoice::{Scalar, Wide};
use magworm::scene::Scene;
use magworm::{Batch, Model, Status, StepOutput, observe};
use std::path::Path;
use std::sync::Arc;

fn model(text: &str, edits: &[(&str, &str)]) -> Arc<Model> {
    let edits: Vec<_> = edits
        .iter()
        .map(|(path, value)| (path.to_string(), Some(value.parse().expect("TOML"))))
        .collect();
    let scene = Scene::from_toml(text).and_then(|scene| scene.with_values(&edits));
    Arc::new(Model::compile(&scene.expect("a valid scene")).expect("a model"))
}

fn scene(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/guards").join(name);
    std::fs::read_to_string(path).expect("a scene")
}

/// What a robot showed in each control step of an episode: progress [m], status, lowest node and greatest speed.
struct Shown {
    progress_m: f64,
    status: Status,
    lowest_m: f64,
    fastest_m_s: f64,
}

fn episode(model: &Arc<Model>, lanes: magworm::LaneChoice) -> Vec<Shown> {
    let mut batch = Batch::new(model.clone(), 1, lanes, Some(1));
    batch.reset(0, 0, 0, None);
    let steps = (model.scene.control.episode_s / model.scene.control.step_s).round() as usize;
    let actions = vec![0.0; observe::action_size(model)];
    let mut observation = vec![0.0; observe::size(model)];
    let (mut progress_m, mut status) = ([0.0], [0]);
    let mut step = || {
        batch.step(
            &actions,
            StepOutput {
                observation: &mut observation,
                progress_m: &mut progress_m,
                status: &mut status,
            },
        );
        batch.view(0, |view| Shown {
            progress_m: progress_m[0],
            status: view.status(),
            lowest_m: (0..model.nodes()).map(|node| view.node_m(node)[1]).fold(0.0, f64::min),
            fastest_m_s: (0..model.magnets())
                .map(|magnet| view.magnet_velocity(magnet)[..model.dimensions()].to_vec())
                .map(|v| v.iter().map(|x| x * x).sum::<f64>().sqrt())
                .fold(0.0, f64::max),
        })
    };
    (0..steps).map(|_| step()).collect()
}

/// Asserts that an episode breaks so, and is rewarded for sound steps alone.
fn breaks(model: &Arc<Model>, expected: Status) {
    for lanes in [Wide, Scalar] {
        let shown = episode(model, lanes);
        let sound = shown.iter().take_while(|one| one.status == Status::Running).count();
        assert!(shown[sound..].iter().all(|one| one.status == expected && one.progress_m == 0.0));
        assert!(sound < shown.len(), "it does not break");
        for one in &shown[..sound] {
            assert!(model.scene.ground.is_none() || one.lowest_m >= -model.thickness_m);
            assert!(one.fastest_m_s <= model.scene.solver.fastest_m_s);
        }
    }
}

#[test]
fn a_robot_that_ends_a_control_step_deep_in_the_ground_has_sunk() {
    breaks(&model(&scene("deep.toml"), &[]), Status::Sunk);
}

#[test]
fn a_robot_that_a_dipole_threw_away_is_too_fast() {
    breaks(&model(&scene("thrown.toml"), &[]), Status::TooFast);
}

/// A rod that nothing holds.
const ROD: &str = "
body = { kind = 'rod', length_m = 0.1, thickness_m = 0.005, width_m = 0.01, elements = 4 }
material = { youngs_modulus_pa = 1e6, density_kg_m3 = 1000.0 }
";

#[test]
fn the_greatest_speed_is_the_scenes() {
    let fall = |limit| {
        let edits = [("control.episode_s", "0.4"), ("solver.fastest_m_s", limit)];
        let shown = episode(&model(ROD, &edits), Wide);
        shown.iter().position(|one| one.status == Status::TooFast)
    };
    // Ten control steps of 0.02 s at 9.81 m/s² end at 1.962 m/s.
    assert_eq!(fall("1.97"), Some(10));
    assert_eq!(fall("1.95"), Some(9));
    assert_eq!(fall("100.0"), None);
}
