//! Snapshots: going on from one equals never having stopped, and a bad one changes nothing.

mod bits_world;
mod scenes;

use bits_world::{MISHAP, Record, World, run};
use magworm::LaneChoice::{Scalar, Wide};
use magworm::{LaneChoice, Model, SnapshotError};
use proptest::prelude::*;
use proptest::sample::Index;
use scenes::{SCENES, model};
use std::sync::Arc;

const ROBOTS: [u64; 11] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10];

/// A world that has run for a while: robots have broken, factors await the next reset.
fn aged(model: &Arc<Model>, lanes: LaneChoice) -> World {
    let mut world = World::new(model, &ROBOTS, lanes, 1);
    run(&mut world, MISHAP + 4);
    // Settings of the next reset are part of what a snapshot keeps.
    world.batch.factors_mut()[3] = 1.25;
    if let Some(is_in) = world.batch.present_mut().last_mut() {
        *is_in = !*is_in;
    }
    world
}

/// A world in the same control step as [`aged`], in a state of its own.
fn another_state(model: &Arc<Model>, lanes: LaneChoice) -> World {
    let mut world = World::new(model, &ROBOTS, lanes, 2);
    run(&mut world, MISHAP + 4);
    (0..ROBOTS.len()).for_each(|place| world.batch.reset(place, 99, 9, None));
    world.batch.advance(7);
    world
}

#[track_caller]
fn assert_equal(here: &[Vec<Record>], there: &[Vec<Record>], what: &str) {
    assert_eq!(here.len(), there.len());
    for (step, (here, there)) in here.iter().zip(there).enumerate() {
        for (place, (here, there)) in here.iter().zip(there).enumerate() {
            here.assert_equals(there, &format!("{what}, control step {step}, robot {place}"));
        }
    }
}

/// Goes on, resetting all robots midway.
fn go_on(world: &mut World) -> Vec<Vec<Record>> {
    let mut records = run(world, 20);
    (0..ROBOTS.len()).for_each(|place| world.batch.reset(place, 77, 5, None));
    records.extend(run(world, 10));
    records
}

#[test]
fn going_on_from_a_snapshot_equals_never_having_stopped() {
    for (scene, ..) in SCENES {
        let model = model(scene);
        for (saved_in, restored_in) in [(Wide, Wide), (Wide, Scalar), (Scalar, Wide)] {
            let mut original = aged(&model, saved_in);
            let snapshot = original.batch.snapshot();
            let mut copy = another_state(&model, restored_in);
            assert_eq!(copy.batch.restore(&snapshot), Ok(()));
            assert_eq!(copy.batch.snapshot(), snapshot, "{scene}: restored state differs");
            let what = format!("{scene}, saved {saved_in:?}, restored {restored_in:?}");
            assert_equal(&go_on(&mut original), &go_on(&mut copy), &what);
        }
    }
}

#[test]
fn saving_disturbs_nothing_and_the_same_state_saves_to_the_same_bytes() {
    for scene in ["three magnets", "three magnets in space"] {
        let model = model(scene);
        let (mut saving, mut plain) = (aged(&model, Wide), aged(&model, Wide));
        assert_eq!(saving.batch.snapshot(), saving.batch.snapshot());
        assert_equal(&go_on(&mut saving), &go_on(&mut plain), "after saving");
        assert_eq!(saving.batch.snapshot(), plain.batch.snapshot());
        assert_eq!(aged(&model, Scalar).batch.snapshot(), aged(&model, Wide).batch.snapshot());
    }
}

/// Asserts that a restore fails with this error and leaves the state as it was.
#[track_caller]
fn refuses(world: &mut World, bytes: &[u8], error: &SnapshotError) {
    let before = world.batch.snapshot();
    assert_eq!(world.batch.restore(bytes).as_ref(), Err(error));
    assert_eq!(world.batch.snapshot(), before, "a refused snapshot changed the state");
    assert!(!error.to_string().is_empty() && !error.to_string().contains('\n'));
}

#[test]
fn a_snapshot_of_another_scene_is_refused() {
    let own = model("three magnets");
    let snapshot = aged(&own, Wide).batch.snapshot();
    for (scene, ..) in SCENES.iter().filter(|(scene, ..)| *scene != "three magnets") {
        refuses(&mut aged(&model(scene), Wide), &snapshot, &SnapshotError::Scene);
    }
    // The same shapes, one value apart.
    let edit = [("gravity_m_s2".to_string(), Some(9.82.into()))];
    let scene = own.scene.with_values(&edit);
    let other = Arc::new(Model::compile(&scene.expect("a scene")).expect("a model"));
    refuses(&mut aged(&other, Wide), &snapshot, &SnapshotError::Scene);
}

#[test]
fn a_snapshot_of_another_number_of_environments_is_refused() {
    let model = model("three magnets");
    let snapshot = aged(&model, Wide).batch.snapshot();
    for expected in [0, 1, 10, 12, 16] {
        let robots: Vec<u64> = (0..expected).collect();
        let mut world = World::new(&model, &robots, Wide, 1);
        let found = ROBOTS.len() as u64;
        refuses(&mut world, &snapshot, &SnapshotError::Count { found, expected });
    }
}

#[test]
fn a_snapshot_cut_short_or_drawn_out_is_refused() {
    let mut world = aged(&model("three magnets"), Wide);
    let snapshot = world.batch.snapshot();
    for length in (0..40).chain((40..snapshot.len()).step_by(997)).chain([snapshot.len() - 1]) {
        refuses(&mut world, &snapshot[..length], &SnapshotError::Malformed(length));
    }
    let longer = [&snapshot[..], &[0]].concat();
    refuses(&mut world, &longer, &SnapshotError::Malformed(longer.len()));
    let other_magic = [b"MAGWORM9", &snapshot[8..]].concat();
    refuses(&mut world, &other_magic, &SnapshotError::Malformed(snapshot.len()));
}

#[test]
fn a_snapshot_with_an_unknown_status_is_refused_whole() {
    let mut world = aged(&model("three magnets"), Wide);
    let fresh = World::new(&model("three magnets"), &ROBOTS, Wide, 1);
    let mut snapshot = fresh.batch.snapshot();
    // The last environment's status lies ahead of its factors and magnets.
    let settings = 8 * Model::PARAMETERS.len() + fresh.batch.model().magnets();
    let status = snapshot.len() - settings - 1;
    snapshot[status] = 77;
    refuses(&mut world, &snapshot, &SnapshotError::StatusCode(77));
}

#[test]
fn an_empty_batch_can_be_saved_and_restored() {
    let model = model("three magnets");
    let snapshot = World::new(&model, &[], Wide, 1).batch.snapshot();
    assert_eq!(World::new(&model, &[], Scalar, 1).batch.restore(&snapshot), Ok(()));
}

/// Restores bytes of unknown origin: a refusal changes nothing, and what is taken over can be stepped.
fn survives(scene: &str, bytes: &[u8]) -> Result<(), TestCaseError> {
    let mut world = World::new(&model(scene), &[1, 2, 3], Wide, 1);
    let before = world.batch.snapshot();
    if world.batch.restore(bytes).is_err() {
        prop_assert_eq!(world.batch.snapshot(), before);
    }
    run(&mut world, 2);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn garbage_does_not_panic(bytes: Vec<u8>) {
        survives("three magnets", &bytes)?;
        survives("three magnets", &[b"MAGWORM1", &bytes[..]].concat())?;
    }

    #[test]
    fn damaged_snapshots_do_not_panic(
        edits in prop::collection::vec((any::<Index>(), 0..12_usize, any::<[u8; 8]>()), 1..6),
        keep_length: bool,
        in_space: bool,
    ) {
        let scene = if in_space { "three magnets in space" } else { "three magnets" };
        let world = World::new(&model(scene), &[4, 5, 6], Scalar, 1);
        let mut bytes = world.batch.snapshot();
        for (index, removed, added) in edits {
            let start = index.index(bytes.len());
            let removed = if keep_length { 8 } else { removed };
            let end = (start + removed).min(bytes.len());
            bytes.splice(start..end, added.into_iter().take(end - start));
        }
        survives(scene, &bytes)?;
    }
}
