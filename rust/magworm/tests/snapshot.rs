//! Snapshots: going on from one equals never having stopped, and a bad one changes nothing.

mod bits_world;
mod damage;
mod scenes;

use bits_world::{MISHAP, Record, World, run};
use damage::Damage;
use magworm::LaneChoice::{Scalar, Wide};
use magworm::internals::{Allowed, ROWS, Role};
use magworm::{LaneChoice, Model, SnapshotError};
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

fn another_scene_than(name: &str, environment: usize) -> SnapshotError {
    SnapshotError::Scene { environment, name: name.into() }
}

#[test]
fn a_snapshot_of_another_scene_is_refused() {
    let own = model("three magnets");
    let snapshot = aged(&own, Wide).batch.snapshot();
    for (scene, ..) in SCENES.iter().filter(|(scene, ..)| *scene != "three magnets") {
        refuses(&mut aged(&model(scene), Wide), &snapshot, &another_scene_than(scene, 0));
    }
    // The same shapes, one value apart.
    let edit = [("gravity_m_s2".to_string(), Some(9.82.into()))];
    let scene = own.scene.with_values(&edit);
    let other = Arc::new(Model::compile(&scene.expect("a scene")).expect("a model"));
    refuses(&mut aged(&other, Wide), &snapshot, &another_scene_than("three magnets", 0));
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
    let other_magic = [b"MAGSNAIL", &snapshot[8..]].concat();
    refuses(&mut world, &other_magic, &SnapshotError::Malformed(snapshot.len()));
}

#[test]
fn a_snapshot_of_another_layout_is_refused_by_name() {
    let mut world = aged(&model("three magnets"), Wide);
    let snapshot = world.batch.snapshot();
    let older = [b"MAGWORM1", &snapshot[8..]].concat();
    let error = world.batch.restore(&older).expect_err("an older layout").to_string();
    assert!(error.starts_with("state has the layout MAGWORM1, which an older version"), "{error}");
    let mut other_rows = snapshot.clone();
    other_rows[8] ^= 1;
    let error = world.batch.restore(&other_rows).expect_err("other rows").to_string();
    assert!(error.starts_with("state has the layout MAGWORM2-"), "{error}");
    assert_eq!(world.batch.snapshot(), snapshot);
}

#[test]
fn a_snapshot_is_of_its_scene_whatever_its_name() {
    let own = model("three magnets");
    let named = [
        ("name".to_string(), Some("another".into())),
        ("start.x_m".to_string(), Some((-0.0).into())),
    ];
    let scene = own.scene.with_values(&named).expect("a scene");
    let renamed = Arc::new(Model::compile(&scene).expect("a model"));
    let snapshot = aged(&own, Wide).batch.snapshot();
    assert_eq!(aged(&renamed, Wide).batch.restore(&snapshot), Ok(()));
}

/// The first word of a column, ahead of its rows.
const FINGERPRINT: usize = 1;

/// Writes a word into the state of the second environment.
fn with_word(snapshot: &[u8], model: &Model, place: usize, word: u64) -> Vec<u8> {
    let mut changed = snapshot.to_vec();
    let words = (snapshot.len() / 8 - damage::HEADER) / ROBOTS.len();
    assert!(place < words && model.coordinates.count < words);
    let byte = 8 * (damage::HEADER + words + place);
    changed[byte..byte + 8].copy_from_slice(&word.to_le_bytes());
    damage::renew_checksum(&mut changed);
    changed
}

#[test]
fn a_number_that_no_robot_has_is_refused_by_name() {
    for scene in ["three magnets", "three magnets in space"] {
        let model = model(scene);
        let mut world = aged(&model, Wide);
        let snapshot = world.batch.snapshot();
        let bad = |allowed: Allowed| match allowed {
            Allowed::Range(..) | Allowed::Frames | Allowed::Factors => f64::NAN,
            Allowed::Whole(_) => 0.5,
        };
        let mut place = FINGERPRINT;
        for group in ROWS.iter().filter(|group| group.role == Role::State) {
            let rows = (group.rows)(&model);
            for value in [bad(group.allowed), -1e300].into_iter().filter(|_| rows > 0) {
                let changed = with_word(&snapshot, &model, place, value.to_bits());
                let error = world.batch.restore(&changed).expect_err(group.name).to_string();
                let named = format!("{}[0] of environment 1 in the state is ", group.name);
                assert!(error.starts_with(&named), "{error}");
            }
            place += rows;
        }
        for (name, ahead, word) in [("step_count", 0, u64::MAX), ("status", 1, 77)] {
            let changed = with_word(&snapshot, &model, place + ahead, word);
            let error = world.batch.restore(&changed).expect_err(name).to_string();
            assert!(error.starts_with(&format!("{name} of environment 1")), "{error}");
        }
        refuses(&mut world, &with_word(&snapshot, &model, 0, 0), &another_scene_than(scene, 1));
        assert_eq!(world.batch.snapshot(), snapshot);
    }
}

#[test]
fn damaged_bytes_are_noticed() {
    let mut world = aged(&model("three magnets"), Wide);
    let mut snapshot = world.batch.snapshot();
    let last = snapshot.len() - 8;
    snapshot[last] ^= 1;
    let error = SnapshotError::Checksum(snapshot.len());
    refuses(&mut world, &snapshot, &error);
}

#[test]
fn an_empty_batch_can_be_saved_and_restored() {
    let model = model("three magnets");
    let snapshot = World::new(&model, &[], Wide, 1).batch.snapshot();
    assert_eq!(World::new(&model, &[], Scalar, 1).batch.restore(&snapshot), Ok(()));
}

/// Restores what was damaged: it is refused in one sentence and changes nothing, or it runs on finite. Returns whether it
/// was refused.
fn survives(world: &mut World, bytes: &[u8], before: &[u8]) -> bool {
    if let Err(error) = world.batch.restore(bytes) {
        assert_eq!(world.batch.snapshot(), before, "a refused snapshot changed the state");
        let sentence = error.to_string();
        assert!(!sentence.is_empty() && !sentence.contains('\n'), "{sentence}");
        return true;
    }
    for (name, bits) in run(world, 1).into_iter().flatten().flat_map(|record| record.0) {
        let value = f64::from_bits(bits);
        assert!(value.is_finite(), "{name} is {value}");
    }
    false
}

/// Flips, cuts and splices, every other with a renewed checksum.
fn damage(scene: &str, lanes: LaneChoice, count: u64) {
    let model = model(scene);
    let mut world = World::new(&model, &[4, 5, 6], lanes, 1);
    run(&mut world, 3);
    let snapshot = world.batch.snapshot();
    let other = another_state(&model, lanes).batch.snapshot();
    let (mut refused, mut renewed) = (0, 0);
    for number in 0..count {
        let mut bytes = Damage::new(number).applied(&snapshot, &other);
        if number % 2 == 1 {
            damage::renew_checksum(&mut bytes);
        }
        if bytes == snapshot {
            continue;
        }
        let is_refused = survives(&mut world, &bytes, &snapshot);
        assert!(
            is_refused || number % 2 == 1,
            "{scene}, damage {number}: the checksum did not see it"
        );
        refused += u64::from(is_refused);
        renewed += u64::from(!is_refused);
        world.batch.restore(&snapshot).expect("the original");
    }
    println!("{scene}: {refused} refused, {renewed} ran on");
    assert!(refused > count / 2 && renewed > count / 20);
}

#[test]
fn damaged_states_are_refused_or_run_on_finite() {
    damage("three magnets", Wide, 35_000);
    damage("dipoles in single precision in space", Wide, 5_000);
}

#[test]
fn damaged_states_in_space_are_refused_or_run_on_finite() {
    damage("three magnets in space", Wide, 20_000);
}

#[test]
fn damaged_states_with_held_wrenches_are_refused_or_run_on_finite() {
    damage("held wrenches", Scalar, 30_000);
    damage("single precision", Wide, 10_000);
}
