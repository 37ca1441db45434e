//! Rollouts: whole trajectories in one call equal stepping, bit for bit, and copies go on as their originals.

mod bits_world;
mod scenes;

use bits_world::{MISHAP, Record, World, run};
use magworm::LaneChoice::{Scalar, Wide};
use magworm::internals::Draws;
use magworm::{
    Batch, Interruption, LaneChoice, Model, Plan, RolloutOutput, Status, StepOutput, observe,
};
use scenes::model;
use std::sync::Arc;

const ROBOTS: [u64; 13] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
const CONTROL_STEPS: usize = 12;

/// Buffers of T control steps of a batch.
#[derive(Debug, PartialEq)]
struct Seen {
    progress_m: Vec<f64>,
    status: Vec<u8>,
    robot_pose: Vec<f64>,
    magnet_pose: Vec<f64>,
    observation: Vec<f32>,
}

impl Seen {
    fn new(batch: &Batch, control_steps: usize) -> Self {
        let model = batch.model();
        let rows = control_steps * batch.count();
        let pose = if model.dimensions() == 2 { 3 } else { 7 };
        Self {
            progress_m: vec![f64::NAN; rows],
            status: vec![77; rows],
            robot_pose: vec![f64::NAN; 3 * rows],
            magnet_pose: vec![f64::NAN; pose * model.magnets() * rows],
            observation: vec![f32::NAN; observe::size(model) * rows],
        }
    }

    fn rollout(batch: &mut Batch, plan: Plan<'_>) -> Self {
        let mut seen = Self::new(batch, plan.control_steps);
        let output = RolloutOutput {
            progress_m: &mut seen.progress_m,
            status: &mut seen.status,
            robot_pose: &mut seen.robot_pose,
            magnet_pose: &mut seen.magnet_pose,
            observation: &mut seen.observation,
        };
        batch.rollout(plan, output, &Interruption::never()).expect("nothing stops it");
        seen
    }

    fn stepping(batch: &mut Batch, plan: Plan<'_>) -> Self {
        let mut seen = Self::new(batch, plan.control_steps);
        let (count, per_step) = (batch.count(), plan.actions.len() / plan.control_steps);
        let width = observe::size(batch.model());
        (seen.robot_pose, seen.magnet_pose) = (vec![], vec![]);
        for step in 0..plan.control_steps {
            let output = StepOutput {
                observation: &mut seen.observation[count * width * step..][..count * width],
                progress_m: &mut seen.progress_m[count * step..][..count],
                status: &mut seen.status[count * step..][..count],
            };
            batch.step(&plan.actions[per_step * step..][..per_step], output);
            for environment in 0..count {
                batch.view(environment, |view| {
                    seen.robot_pose.extend(view.robot_pose());
                    let magnets = 0..batch.model().magnets();
                    seen.magnet_pose.extend(magnets.flat_map(|k| view.magnet_pose(k)));
                });
            }
        }
        seen
    }
}

/// A little beyond [−1, 1], so that clipping is part of the test.
fn actions(model: &Model, count: usize, control_steps: usize) -> Vec<f64> {
    let mut draws = Draws::new(5, 0);
    let numbers = control_steps * count * observe::action_size(model);
    (0..numbers).map(|_| draws.uniform(-1.1, 1.1)).collect()
}

fn records(batch: &Batch) -> Vec<Record> {
    let contacts = batch.model().contacts.len();
    let mut records = vec![Record::default(); batch.count()];
    for (environment, record) in records.iter_mut().enumerate() {
        batch.view(environment, |view| record.look(&view, batch.model(), contacts));
    }
    records
}

/// Robots some of which break a little later.
fn about_to_break(model: &Arc<Model>, lanes: LaneChoice, threads: usize) -> Batch {
    let mut world = World::new(model, &ROBOTS, lanes, threads);
    run(&mut world, MISHAP + 1);
    world.batch
}

#[test]
fn a_rollout_equals_stepping_bit_for_bit() {
    for scene in [
        "three magnets",
        "belt",
        "cantilever",
        "held wrenches",
        "three magnets in space",
        "belt in space",
    ] {
        let model = model(scene);
        let actions = actions(&model, ROBOTS.len(), CONTROL_STEPS);
        let plan = Plan { control_steps: CONTROL_STEPS, actions: &actions };
        let mut stepped = about_to_break(&model, Scalar, 1);
        let expected = Seen::stepping(&mut stepped, plan);
        for (lanes, threads) in [(Wide, 1), (Wide, 2), (Wide, 3), (Scalar, 1), (Scalar, 3)] {
            let mut batch = about_to_break(&model, lanes, threads);
            let seen = Seen::rollout(&mut batch, plan);
            assert!(seen == expected, "{scene}, {lanes:?}, {threads} threads");
            for (there, here) in records(&stepped).iter().zip(records(&batch)) {
                here.assert_equals(there, &format!("{scene}, {lanes:?}, at the end"));
            }
        }
        let broken = |row: &[u8]| row.iter().filter(|&&code| code != Status::Running as u8).count();
        let (first, last) = expected.status.split_at(ROBOTS.len());
        let last = broken(&last[last.len() - ROBOTS.len()..]);
        assert!(scene.contains("cantilever") || last > 0, "{scene}: nothing broke");
        assert!(broken(first) <= last && last < ROBOTS.len());
    }
}

#[test]
fn what_is_not_wanted_is_not_written_and_changes_nothing() {
    let model = model("three magnets");
    let actions = actions(&model, ROBOTS.len(), 3);
    let plan = Plan { control_steps: 3, actions: &actions };
    let mut batch = about_to_break(&model, Wide, 2);
    let copies = &mut batch.copies(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]);
    let everything = Seen::rollout(copies, plan);
    let mut seen = Seen::new(&batch, 3);
    let output = RolloutOutput {
        progress_m: &mut seen.progress_m,
        status: &mut seen.status,
        robot_pose: &mut seen.robot_pose,
        magnet_pose: &mut [],
        observation: &mut [],
    };
    batch.rollout(plan, output, &Interruption::never()).expect("nothing stops it");
    assert_eq!(seen.progress_m, everything.progress_m);
    assert_eq!(seen.robot_pose, everything.robot_pose);
    assert!(seen.observation.iter().all(|number| number.is_nan()));
}

#[test]
fn copies_go_on_as_their_originals_and_leave_them_alone() {
    for scene in ["dipoles with varied parameters", "held wrenches", "three magnets in space"] {
        for lanes in [Wide, Scalar] {
            let model = model(scene);
            let mut batch = about_to_break(&model, lanes, 2);
            batch.factors_mut()[3] = 1.25;
            let before = batch.snapshot();
            let chosen = [3, 12, 0, 3, 3, 5, 7, 1, 12, 2];
            let mut copies = batch.copies(&chosen);
            assert_eq!(copies.snapshot(), batch.copies(&chosen).snapshot());
            copies.advance(40);
            assert_eq!(batch.snapshot(), before, "{scene}: copies share nothing with the batch");
            batch.advance(40);
            let (originals, copied) = (records(&batch), records(&copies));
            for (copy, &original) in chosen.iter().enumerate() {
                copied[copy].assert_equals(&originals[original], &format!("{scene}, copy {copy}"));
            }
            assert_eq!(copies.factors()[2 * Model::PARAMETERS.len()..][..4][3], 1.25);
        }
    }
}
