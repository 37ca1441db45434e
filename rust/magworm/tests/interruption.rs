//! A call that was stopped leaves its environments as they were, bit for bit.

mod bits_world;
mod scenes;

use bits_world::{MISHAP, World, run};
use magworm::LaneChoice::{Scalar, Wide};
use magworm::internals::{Pool, Watch, record};
use magworm::{
    Batch, Interrupted, Interruption, LaneChoice, Model, Plan, RolloutOutput, Start, StepOutput,
    observe,
};
use scenes::model;
use std::sync::Arc;
use std::time::{Duration, Instant};

const ROBOTS: [u64; 13] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
const SCENES: [&str; 4] =
    ["three magnets", "cantilever", "held wrenches", "three magnets in space"];

/// More than anyone waits for.
const FOREVER: u32 = u32::MAX;

/// Robots some of which are broken.
fn aged(model: &Arc<Model>, lanes: LaneChoice, threads: usize) -> World {
    let mut world = World::new(model, &ROBOTS, lanes, threads);
    run(&mut world, MISHAP + 4);
    world
}

/// A step, and a rollout of many.
fn step(batch: &mut Batch, interruption: &Interruption<'_>) -> Result<(), Interrupted> {
    let (count, model) = (batch.count(), Arc::clone(batch.model()));
    let actions = vec![0.3; count * observe::action_size(&model)];
    let output = StepOutput {
        observation: &mut vec![0.0; count * observe::size(&model)],
        progress_m: &mut vec![0.0; count],
        status: &mut vec![0; count],
    };
    batch.step_unless(interruption, &actions, output)
}

fn rollout(batch: &mut Batch, interruption: &Interruption<'_>) -> Result<(), Interrupted> {
    let (count, control_steps) = (batch.count(), 20_000);
    let actions = vec![0.3; control_steps * count * observe::action_size(batch.model())];
    let output = RolloutOutput {
        progress_m: &mut vec![0.0; control_steps * count],
        status: &mut vec![0; control_steps * count],
        robot_pose: &mut vec![0.0; 3 * control_steps * count],
        magnet_pose: &mut [],
        observation: &mut [],
    };
    batch.rollout(Plan { control_steps, actions: &actions }, output, interruption)
}

fn advance(batch: &mut Batch, interruption: &Interruption<'_>) -> Result<(), Interrupted> {
    batch.advance_unless(interruption, FOREVER)
}

fn reset(batch: &mut Batch, interruption: &Interruption<'_>) -> Result<(), Interrupted> {
    let start =
        |k: usize| (!k.is_multiple_of(3)).then_some(Start { seed: 9, episode: 1, pose: None });
    let starts: Vec<Option<Start>> = (0..batch.count()).map(start).collect();
    batch.reset_unless(interruption, &starts)
}

fn restore(batch: &mut Batch, interruption: &Interruption<'_>) -> Result<(), Interrupted> {
    let mut other = aged(batch.model(), Wide, 1).batch;
    other.advance(3);
    let state = other.snapshot();
    batch.restore_unless(interruption, &state).map(|restored| restored.expect("it fits"))
}

#[test]
fn a_call_that_was_stopped_changed_nothing() {
    for (scene, lanes, threads) in SCENES
        .into_iter()
        .flat_map(|scene| [(scene, Wide, 1), (scene, Wide, 3), (scene, Scalar, 2)])
    {
        let mut world = aged(&model(scene), lanes, threads);
        let batch = &mut world.batch;
        let (before, counters) = (batch.snapshot(), batch.counters());
        for call in [step, rollout, advance, reset, restore] {
            let began = Instant::now();
            let outcome = call(batch, &Interruption::new(&mut || true));
            assert_eq!(outcome, Err(Interrupted), "{scene}");
            assert!(began.elapsed() < Duration::from_secs(5), "{scene}: {:?}", began.elapsed());
            assert!(batch.snapshot() == before && batch.counters() == counters, "{scene}");
        }
        // What is derived from the state is as before too: all goes on as where nothing was stopped.
        let mut untouched = aged(&model(scene), lanes, 1);
        for world in [&mut world, &mut untouched] {
            step(&mut world.batch, &Interruption::new(&mut || false)).expect("nobody stops it");
        }
        for place in 0..ROBOTS.len() {
            world.record(place).assert_equals(&untouched.record(place), scene);
        }
    }
}

#[test]
fn a_call_that_might_have_been_stopped_gives_the_same_bits() {
    for scene in SCENES {
        let (mut asked, mut alone) =
            (aged(&model(scene), Wide, 2).batch, aged(&model(scene), Wide, 1).batch);
        asked.advance_unless(&Interruption::new(&mut || false), 1000).expect("nobody stops it");
        alone.advance(1000);
        assert!(asked.snapshot() == alone.snapshot(), "{scene}");
    }
}

#[test]
fn the_caller_alone_is_asked_and_in_time() {
    let (here, model) = (std::thread::current().id(), model("belt"));
    for threads in [1, 3] {
        let began = Instant::now();
        let mut asked = || {
            assert_eq!(std::thread::current().id(), here);
            began.elapsed() > Duration::from_millis(300)
        };
        let watch = Watch { intervals: 1000, steps: 1_000_000, nodes: true };
        let scenes = [(Arc::clone(&model), watch), (Arc::clone(&model), watch)];
        let recorded = record(&scenes, Some(threads), &Interruption::new(&mut asked));
        assert_eq!(recorded.err(), Some(Interrupted));
        assert!(
            began.elapsed() < Duration::from_secs(5),
            "{threads} threads: {:?}",
            began.elapsed()
        );
    }
}

#[test]
fn copies_and_batches_that_were_stopped_are_none() {
    let model = model("three magnets");
    let mut yes = || true;
    let stopped = &Interruption::new(&mut yes);
    assert!(Batch::new_unless(stopped, Arc::clone(&model), 100, Wide, Pool::new(Some(2))).is_err());
    assert!(aged(&model, Wide, 2).batch.copies_unless(stopped, &[1, 1, 1]).is_err());
    let (batch, mut poses) = (aged(&model, Wide, 2).batch, vec![0.0; 3 * ROBOTS.len()]);
    assert!(
        batch
            .look_unless(stopped, &mut poses, |view, row| row.copy_from_slice(&view.robot_pose()))
            .is_err()
    );
}
