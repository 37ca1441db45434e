//! Batches of several scenes: each environment is what it is in a batch of its scene alone.

mod bits_world;
mod scenes;

use bits_world::{MISHAP, Record, World, run};
use magworm::LaneChoice::{Scalar, Wide};
use magworm::{
    Batch, Ensemble, Interruption, LaneChoice, Model, Plan, RolloutOutput, SnapshotError,
    StepOutput, observe,
};
use scenes::model;
use std::sync::Arc;

type Edits<'a> = &'a [(&'a str, &'a str)];

/// The numbers of the robots: seven of each of three scenes.
const ROBOTS: [u64; 21] =
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20];

fn edited(scene: &str, edits: Edits<'_>) -> Arc<Model> {
    let value = |text: &str| Some(text.parse().expect("a TOML value"));
    let edits: Vec<_> = edits.iter().map(|(path, text)| (path.to_string(), value(text))).collect();
    let scene = model(scene).scene.with_values(&edits).expect("a valid scene");
    Arc::new(Model::compile(&scene).expect("a model"))
}

/// A scene; a soft one that relaxes and whose wrenches are held, so that its state has more rows; a stiff one that lacks a
/// magnet and varies.
fn three(scene: &str) -> Vec<Arc<Model>> {
    let soft: Edits<'_> = &[
        ("name", "'soft'"),
        ("material.youngs_modulus_pa", "30000"),
        ("ground.static_friction", "1.1"),
        ("solver.wrench_interval", "2"),
        ("material.relaxation", "[{ ratio = 0.3, time_s = 0.05 }]"),
    ];
    let stiff: Edits<'_> = &[
        ("name", "'stiff'"),
        ("material.youngs_modulus_pa", "200000"),
        ("body.removed", "[1]"),
        ("drive.remanence_t", "1.4"),
        ("reset.vary", "[{ parameter = 'mass', low = 0.5, high = 2.0 }]"),
    ];
    vec![model(scene), edited(scene, soft), edited(scene, stiff)]
}

fn ensemble(models: &[Arc<Model>]) -> Ensemble {
    Ensemble::new(models.to_vec()).expect("scenes of one shape")
}

fn aged(models: &[Arc<Model>], lanes: LaneChoice, threads: usize) -> World {
    let mut world = World::of(ensemble(models), &ROBOTS, lanes, threads);
    run(&mut world, MISHAP + 3);
    world
}

#[track_caller]
fn assert_equal(here: &[Record], there: &[Record], what: &str) {
    assert_eq!(here.len(), there.len(), "{what}");
    for (place, (here, there)) in here.iter().zip(there).enumerate() {
        here.assert_equals(there, &format!("{what}, place {place}"));
    }
}

#[test]
fn an_environment_is_what_it_is_in_a_batch_of_its_scene_alone() {
    for scene in ["three magnets", "three magnets in space", "single precision"] {
        let models = three(scene);
        for (lanes, threads, alone) in [(Wide, 1, Scalar), (Wide, 3, Wide), (Scalar, 2, Wide)] {
            let together = ensemble(&models);
            let mut world = World::of(together.clone(), &ROBOTS, lanes, threads);
            let seen = run(&mut world, 40);
            for (number, model) in models.iter().enumerate() {
                let range = together.environments(number, ROBOTS.len());
                assert!(range.clone().all(|place| world.batch.scene_of(place) == number));
                // One robot more moves all of them to other lanes.
                let robots = [&[99], &ROBOTS[range.clone()]].concat();
                let single = run(&mut World::new(model, &robots, alone, 1), 40);
                for (step, (seen, single)) in seen.iter().zip(&single).enumerate() {
                    let what = format!("{scene} {number}, {lanes:?}, control step {step}");
                    assert_equal(&seen[range.clone()], &single[1..], &what);
                }
            }
            let last = seen.last().expect("a control step");
            assert!(last[0] != last[7] && last[7] != last[14], "{scene}: the scenes are one");
        }
    }
}

#[test]
fn scenes_are_dealt_out_in_their_order_and_evenly() {
    let models = three("three magnets");
    let together = ensemble(&models);
    for count in [3, 4, 20, 21, 1000] {
        let shares: Vec<usize> =
            (0..3).map(|scene| together.environments(scene, count).len()).collect();
        assert_eq!(shares.iter().sum::<usize>(), count);
        assert!(shares.iter().all(|share| (count / 3..=count.div_ceil(3)).contains(share)));
        for lanes in [Wide, Scalar] {
            let batch = Batch::new(together.clone(), count, lanes, Some(1));
            assert!((0..count).all(|k| batch.scene_of(k) == k * 3 / count), "{count}, {lanes:?}");
            assert!((0..count).all(|k| Arc::ptr_eq(batch.model_of(k), &models[k * 3 / count])));
            let lacks = |k: usize| batch.present()[3 * k..][..3] == [true, false, true];
            assert!((0..count).all(|k| lacks(k) == (batch.scene_of(k) == 2)));
        }
    }
}

#[test]
fn blocks_of_an_ensemble_are_counted_whole() {
    let models = three("three magnets");
    let bytes = |models: &[Arc<Model>], count| Batch::bytes(&ensemble(models), count, Wide);
    let apart: usize = models.iter().map(|model| bytes(std::slice::from_ref(model), 9)).sum();
    assert_eq!(bytes(&models, 27), apart);
    // Nine environments of a scene take two blocks, and so do sixteen.
    assert!(bytes(&models[..1], 16) - bytes(&models[..1], 9) < 1000);
    let batch = Batch::new(ensemble(&models), 27, Wide, Some(1));
    assert_eq!(batch.copies_bytes(&(0..27).collect::<Vec<_>>()), apart);
}

#[test]
fn a_scene_of_another_shape_is_refused_by_what_differs() {
    let first = model("three magnets");
    for (scene, edits, sentence) in [
        (
            "three magnets",
            &[("solver.step_s", "0.001")][..],
            "solver.step_s = 0.001 s; allowed: solver.step_s = 0.002 s",
        ),
        (
            "three magnets",
            &[("control.step_s", "0.04")],
            "control.step_s = 0.04 s; allowed: control.step_s = 0.02 s",
        ),
        ("three magnets", &[("body.elements_per_bridge", "5")], "nodes = 20; allowed: nodes = 18"),
        ("three magnets", &[("body.pitch_m", "0.021")], ""),
        (
            "three magnets",
            &[("solver.precision", "'single'")],
            "solver.precision = single; allowed: solver.precision = double",
        ),
        ("four magnets", &[], "body magnets = 4; allowed: body magnets = 3"),
        ("three magnets in space", &[], "dimensions = 3; allowed: dimensions = 2"),
        (
            "waypoints",
            &[],
            "drives that follow actions = 0; allowed: drives that follow actions = 1",
        ),
    ] {
        let error = Ensemble::new(vec![first.clone(), first.clone(), edited(scene, edits)]);
        let error = error.expect_err("another shape").to_string();
        let whole = format!("scenes[2] is a scene with {sentence}");
        assert!(error.starts_with(whole.trim_end()), "{error}");
        assert!(error.ends_with(", as in scenes[0]: a batch has scenes of one shape"), "{error}");
    }
    assert_eq!(
        Ensemble::new(Vec::new()).expect_err("no scene").to_string(),
        "scenes is an empty list; allowed: one scene or more"
    );
}

#[test]
fn going_on_from_a_snapshot_of_several_scenes_equals_never_having_stopped() {
    for scene in ["three magnets", "three magnets in space"] {
        let models = three(scene);
        let mut original = aged(&models, Wide, 2);
        let snapshot = original.batch.snapshot();
        let mut copy = World::of(ensemble(&models), &ROBOTS, Scalar, 1);
        run(&mut copy, MISHAP + 3);
        (0..ROBOTS.len()).for_each(|place| copy.batch.reset(place, 7, 7, None));
        assert_eq!(copy.batch.restore(&snapshot), Ok(()));
        assert!(copy.batch.snapshot() == snapshot);
        for (here, there) in run(&mut original, 20).iter().zip(&run(&mut copy, 20)) {
            assert_equal(here, there, scene);
        }
    }
}

#[test]
fn a_snapshot_of_other_scenes_is_refused_by_environment_and_name() {
    let models = three("three magnets");
    let snapshot = aged(&models, Wide, 1).batch.snapshot();
    let swapped = [&models[0], &models[2], &models[1]].map(Arc::clone);
    let alone = [&models[0]].map(Arc::clone);
    for (others, environment, name) in
        [(&swapped[..], 7, "stiff"), (&alone[..], 7, "three magnets"), (&models[1..], 0, "soft")]
    {
        let mut world = aged(others, Wide, 1);
        let before = world.batch.snapshot();
        let error = world.batch.restore(&snapshot).expect_err("other scenes");
        assert_eq!(error, SnapshotError::Scene { environment, name: name.into() });
        assert!(world.batch.snapshot() == before);
        let begin = format!("state of environment {environment} was saved from another scene");
        assert!(error.to_string().starts_with(&begin) && error.to_string().contains(name));
    }
}

/// The state of copies of one scene is one of a batch of that scene, though the ensemble's columns are longer.
#[test]
fn states_fit_wherever_each_environment_has_its_scene() {
    let models = three("three magnets");
    let world = aged(&models, Wide, 1);
    let chosen: Vec<usize> = (0..7).collect();
    let snapshot = world.batch.copies(&chosen).snapshot();
    let mut single = Batch::new(Arc::clone(&models[0]), 7, Scalar, Some(1));
    assert_eq!(single.restore(&snapshot), Ok(()));
    assert!(snapshot.len() > single.snapshot().len());
    assert_eq!(single.copies(&chosen).restore(&single.snapshot()), Ok(()));
}

/// What is seen of each environment.
fn looked(batch: &Batch) -> Vec<Record> {
    let look = |environment| {
        let mut record = Record::default();
        let model = batch.model_of(environment);
        batch.view(environment, |view| record.look(&view, model, model.contacts.len()));
        record
    };
    (0..batch.count()).map(look).collect()
}

#[test]
fn copies_in_any_order_roll_out_as_their_originals_step() {
    const STEPS: usize = 6;
    for scene in ["three magnets", "three magnets in space"] {
        let models = three(scene);
        for (lanes, threads) in [(Wide, 1), (Wide, 3), (Scalar, 2)] {
            let mut world = aged(&models, lanes, threads);
            let batch = &mut world.batch;
            let chosen: Vec<usize> = vec![20, 3, 3, 9, 0, 8, 10, 11, 20, 19, 1, 7];
            let mut copies = batch.copies(&chosen);
            assert_equal(&looked(&copies), &chosen_of(&looked(batch), &chosen), scene);
            let (model, size) = (Arc::clone(batch.model()), observe::action_size(batch.model()));
            let act = |step: usize, environment: usize, k: usize| {
                (1.3 * step as f64 + 0.7 * environment as f64 + 2.1 * k as f64).sin()
            };
            let row =
                |step: usize, environment: usize| (0..size).map(move |k| act(step, environment, k));
            let planned: Vec<f64> = (0..STEPS)
                .flat_map(|step| chosen.iter().flat_map(move |&e| row(step, e)))
                .collect();
            let rows = STEPS * chosen.len();
            let (mut progress_m, mut status) = (vec![0.0; rows], vec![0; rows]);
            let (mut robot_pose, mut observation) =
                (vec![0.0; 3 * rows], vec![0.0; rows * observe::size(&model)]);
            let output = RolloutOutput {
                progress_m: &mut progress_m,
                status: &mut status,
                robot_pose: &mut robot_pose,
                magnet_pose: &mut [],
                observation: &mut observation,
            };
            let plan = Plan { control_steps: STEPS, actions: &planned };
            copies.rollout(plan, output, &Interruption::never()).expect("nothing stops it");
            let count = batch.count();
            for step in 0..STEPS {
                let actions: Vec<f64> = (0..count).flat_map(|e| row(step, e)).collect();
                let mut seen = vec![0.0; count * observe::size(&model)];
                let (mut way_m, mut codes) = (vec![0.0; count], vec![0; count]);
                let output = StepOutput {
                    observation: &mut seen,
                    progress_m: &mut way_m,
                    status: &mut codes,
                };
                batch.step(&actions, output);
                for (copy, &environment) in chosen.iter().enumerate() {
                    let place = step * chosen.len() + copy;
                    let width = observe::size(&model);
                    assert_eq!(progress_m[place].to_bits(), way_m[environment].to_bits());
                    assert_eq!(status[place], codes[environment]);
                    assert_eq!(
                        observation[place * width..][..width],
                        seen[environment * width..][..width],
                        "{scene}, {lanes:?}, step {step}, copy {copy}"
                    );
                }
            }
            assert_equal(&looked(&copies), &chosen_of(&looked(batch), &chosen), scene);
        }
    }
}

fn chosen_of(records: &[Record], chosen: &[usize]) -> Vec<Record> {
    chosen.iter().map(|&environment| records[environment].clone()).collect()
}

#[test]
fn a_call_that_was_stopped_changed_nothing_in_any_scene() {
    let models = three("three magnets");
    let mut world = aged(&models, Wide, 2);
    let before = world.batch.snapshot();
    let stopped = world.batch.advance_unless(&Interruption::new(&mut || true), 1000);
    assert!(stopped.is_err() && world.batch.snapshot() == before);
    let mut untouched = aged(&models, Wide, 1);
    for (here, there) in run(&mut world, 3).iter().zip(&run(&mut untouched, 3)) {
        assert_equal(here, there, "after a stop");
    }
}
