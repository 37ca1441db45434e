//! Wrenches that act for several steps: they equal those that a step of their own computes and a hand holds, lane by lane.

mod base;

use base::base;
use magworm::internals::lanes::{InstructionSet, WIDE};
use magworm::internals::{Block, Draws, Phase, Steps, command, reset, scene_start};
use magworm::{Batch, LaneChoice, Model, Status};
use std::sync::Arc;

/// A preset with edits in TOML; an empty one takes a table out.
fn model(preset: &str, edits: &[(&str, &str)]) -> Arc<Model> {
    let value = |text: &str| (!text.is_empty()).then(|| text.parse().expect("TOML"));
    let edits: Vec<_> = edits.iter().map(|(path, text)| (path.to_string(), value(text))).collect();
    let scene = base(preset).with_values(&edits);
    Arc::new(Model::compile(&scene.expect("a valid scene")).expect("a model"))
}

/// The same where wrenches act for some steps.
fn holding(preset: &str, edits: &[(&str, &str)], interval: u64) -> Arc<Model> {
    let interval = interval.to_string();
    model(preset, &[edits, &[("solver.wrench_interval", interval.as_str())]].concat())
}

const IN_SPACE: &[(&str, &str)] = &[
    ("dimensions", "3"),
    ("drive.motion.lateral_reach_m", "0.04"),
    ("drive.motion.yaw_reach_deg", "120"),
];
const PAIR: &[(&str, &str)] =
    &[("drive.arrangement", "{ kind = 'pair', spacing_m = 0.06, second_polarity = -1 }")];
const EXPLICIT: &[(&str, &str)] = &[
    ("solver.integrator", "'explicit'"),
    ("solver.step_s", "1e-5"),
    ("control.step_s", "5e-4"),
    ("material.damping_time_s", "1e-4"),
];

fn start(model: &Model, block: &mut Block<[f64; WIDE]>, lane: usize) {
    let present = vec![true; model.magnets()];
    let mut pose = scene_start(model);
    pose.angle_rad += 0.01 * lane as f64;
    let factors = [1.0; Model::PARAMETERS.len()];
    reset(model, block, lane, pose, &factors, &present, Draws::new(lane as u64, 0));
}

fn act(model: &Model, block: &mut Block<[f64; WIDE]>, step: u32) {
    if !step.is_multiple_of(model.steps_per_control) {
        return;
    }
    for lane in 0..WIDE {
        let mut draws = Draws::new(lane as u64, 1000 + u64::from(step / 40));
        let action: [f64; 5] = std::array::from_fn(|_| draws.uniform(-1.0, 1.0));
        command(model, block, lane, &action);
    }
}

fn bits(block: &Block<[f64; WIDE]>, lane: usize) -> Vec<u64> {
    let rows = block.state_rows();
    // A model that holds nothing has no rows for it.
    let rows = rows.iter().take(rows.len() - 1);
    rows.flat_map(|rows| rows.iter().map(|row| row[lane].to_bits())).collect()
}

/// Steps by phases, where a hand keeps what the wrenches of one step add to the right-hand side.
struct Hand {
    interval: u64,
    /// Δt times the wrench that each lane holds [N·s, N·m·s], shape [unknowns].
    push: Vec<[f64; WIDE]>,
}

impl Hand {
    fn step(&mut self, model: &Model, block: &mut Block<[f64; WIDE]>) {
        for &phase in &model.phases {
            if phase == Phase::Magnets {
                self.magnets(model, block);
            } else {
                block.run_phase_on(InstructionSet::widest(), model, phase);
            }
        }
    }

    fn magnets(&mut self, model: &Model, block: &mut Block<[f64; WIDE]>) {
        let before = block.rhs.to_vec();
        block.rhs.fill([0.0; WIDE]);
        block.run_phase_on(InstructionSet::widest(), model, Phase::Magnets);
        for lane in 0..WIDE {
            let due = block.step_count[lane].is_multiple_of(self.interval);
            for (push, new) in self.push.iter_mut().zip(block.rhs.iter()).filter(|_| due) {
                push[lane] = new[lane];
            }
        }
        for (dof, row) in block.rhs.iter_mut().enumerate() {
            for lane in 0..WIDE {
                row[lane] = before[dof][lane] + self.push[dof][lane];
            }
        }
    }
}

/// Asserts that wrenches act as long as a hand lets those of a model act that computes them in every step. Robots start
/// afresh at different times, so lanes are due in different steps.
#[track_caller]
fn equals_a_hand(preset: &str, edits: &[(&str, &str)], interval: u64) {
    let (every, held) = (model(preset, edits), holding(preset, edits, interval));
    let (mut by_hand, mut block) = (Block::new(&every), Block::new(&held));
    let push = vec![[0.0; WIDE]; every.coordinates.count];
    let mut hand = Hand { interval, push };
    for step in 0..400 {
        for lane in (0..WIDE).filter(|&lane| step == 0 || (lane < 6 && step == 60 + 17 * lane)) {
            start(&every, &mut by_hand, lane);
            start(&held, &mut block, lane);
        }
        act(&every, &mut by_hand, step as u32);
        act(&held, &mut block, step as u32);
        hand.step(&every, &mut by_hand);
        block.advance_on(InstructionSet::widest(), &held, 1);
        for lane in 0..WIDE {
            let place = format!("interval {interval}, step {step}, lane {lane}");
            assert!(bits(&by_hand, lane) == bits(&block, lane), "{place}");
        }
    }
    assert!(block.status.iter().all(|status| *status == Status::Running));
    assert!(block.counters.wrenches < by_hand.counters.wrenches);
}

#[test]
fn a_held_wrench_is_the_one_computed_last() {
    for interval in [2, 5, 10] {
        equals_a_hand("robot", &[], interval);
        equals_a_hand("robot", IN_SPACE, interval);
    }
    equals_a_hand("robot", PAIR, 5);
    equals_a_hand("robot", EXPLICIT, 10);
}

#[test]
fn a_wrench_that_acts_for_one_step_has_no_rows_and_needs_none() {
    let block = Block::<[f64; WIDE]>::new(&model("robot", &[]));
    assert!(block.wrench.is_empty());
    let rows = |edits| Block::<[f64; WIDE]>::new(&holding("robot", edits, 2)).wrench.len();
    assert_eq!((rows(&[]), rows(IN_SPACE)), (3 * 3, 3 * 6));
    // A field without a drive has no wrench to hold.
    assert!(Block::<[f64; WIDE]>::new(&holding("cantilever", &[], 2)).wrench.is_empty());
}

#[test]
fn a_fresh_start_forgets_the_wrench() {
    let model = holding("robot", IN_SPACE, 10);
    let mut block = Block::new(&model);
    (0..WIDE).for_each(|lane| start(&model, &mut block, lane));
    block.advance_on(InstructionSet::widest(), &model, 3);
    let held =
        |block: &Block<[f64; WIDE]>, lane: usize| block.wrench.iter().any(|row| row[lane] != 0.0);
    assert!((0..WIDE).all(|lane| held(&block, lane)));
    start(&model, &mut block, 4);
    assert!((0..WIDE).all(|lane| held(&block, lane) == (lane != 4)));
}

#[test]
fn a_model_says_that_it_holds_wrenches() {
    let said = |interval| holding("robot", &[], interval).explain();
    assert!(said(1).contains("3 wrenches a step, cuboids"));
    assert!(said(5).contains("3 wrenches every 5 steps, held between, cuboids"));
}

#[test]
fn the_torque_of_a_uniform_field_is_not_held() {
    let edits = [("drive.remanence_t", "0.0"), ("field", "{ x_t = 0.02, y_t = -0.01 }")];
    for edits in [edits.to_vec(), [IN_SPACE, &edits].concat()] {
        let (every, held) = (model("robot", &edits), holding("robot", &edits, 10));
        let (mut one, mut other) = (Block::new(&every), Block::new(&held));
        for (model, block) in [(&every, &mut one), (&held, &mut other)] {
            (0..WIDE).for_each(|lane| start(model, block, lane));
            block.advance_on(InstructionSet::widest(), model, 105);
        }
        (0..WIDE).for_each(|lane| assert!(bits(&one, lane) == bits(&other, lane), "lane {lane}"));
    }
}

#[test]
fn what_is_not_computed_is_not_counted() {
    let wrenches = |interval, steps| {
        let model = holding("robot", PAIR, interval);
        let mut block = Block::new(&model);
        (0..WIDE).for_each(|lane| start(&model, &mut block, lane));
        block.advance_on(InstructionSet::widest(), &model, steps);
        block.counters.wrenches
    };
    // Three body magnets, two drive magnets.
    assert_eq!([1, 2, 5, 10].map(|interval| wrenches(interval, 20)), [120, 60, 24, 12]);
    assert_eq!(wrenches(10, 21), 18);
}

#[test]
fn lanes_that_are_due_in_different_steps_make_the_block_compute() {
    let model = holding("robot", &[], 10);
    let mut block = Block::new(&model);
    (0..WIDE).for_each(|lane| start(&model, &mut block, lane));
    block.advance_on(InstructionSet::widest(), &model, 3);
    start(&model, &mut block, 4);
    let before = block.counters.wrenches;
    block.advance_on(InstructionSet::widest(), &model, 20);
    // Lane 4 in steps 0 and 10, the others in steps 7 and 17, three magnets each.
    assert_eq!(block.counters.wrenches - before, 4 * 3);
}

#[test]
fn a_robot_that_stands_still_is_never_due() {
    let model = holding("robot", &[], 5);
    let mut block = Block::new(&model);
    (0..WIDE).for_each(|lane| start(&model, &mut block, lane));
    block.status.fill(Status::Sunk);
    block.advance_on(InstructionSet::widest(), &model, 20);
    assert_eq!(block.counters.wrenches, 0);
}

#[test]
fn a_snapshot_between_two_wrenches_holds_the_wrench() {
    for edits in [&[], IN_SPACE] {
        let model = holding("robot", edits, 10);
        let batch = || Batch::new(model.clone(), 3, LaneChoice::Wide, Some(1));
        let (mut original, mut copy) = (batch(), batch());
        (0..3).for_each(|robot| original.reset(robot, robot as u64, 0, None));
        original.advance(34);
        copy.restore(&original.snapshot()).expect("of the same scene");
        for batch in [&mut original, &mut copy] {
            batch.advance(3);
        }
        assert_eq!(original.snapshot(), copy.snapshot());
        assert_eq!(copy.counters().wrenches, 0, "the wrench was held, not computed");
    }
}

/// A robot in free flight that a drive passes.
const FLIGHT: &[(&str, &str)] = &[
    ("gravity_m_s2", "0.0"),
    ("ground", ""),
    ("start.height_m", "0.03"),
    ("solver.step_s", "2e-4"),
    ("control.step_s", "0.045"),
    ("control.episode_s", "0.45"),
    ("drive.motion", "{ kind = 'constant', x_m = -0.03, y_m = -0.022, speed_m_s = 1.0 }"),
];
const FLIGHT_IN_SPACE: &[(&str, &str)] =
    &[("dimensions", "3"), ("drive.motion.z_m", "0.004"), ("drive.motion.yaw_deg", "20")];

/// Places of the magnets after a control step where wrenches act for some steps [m].
fn places_m(edits: &[(&str, &str)], interval: u64) -> Vec<f64> {
    let model = holding("robot", edits, interval);
    let mut batch = Batch::new(model.clone(), 1, LaneChoice::Scalar, Some(1));
    batch.reset(0, 0, 0, None);
    batch.advance(model.steps_per_control);
    assert_eq!(batch.status(0), Status::Running);
    let place = |magnet| batch.view(0, |view| view.pose(magnet).position_m);
    (0..model.magnets())
        .flat_map(|magnet| place(magnet).iter().copied().collect::<Vec<_>>())
        .collect()
}

/// What acts is (n − 1)/2 steps old on the average.
#[test]
fn the_error_is_in_proportion_to_the_age_of_the_wrench() {
    for edits in [FLIGHT.to_vec(), [FLIGHT, FLIGHT_IN_SPACE].concat()] {
        let fresh = places_m(&edits, 1);
        let errors_m = [3, 5, 9].map(|interval| {
            let held = places_m(&edits, interval);
            held.iter().zip(&fresh).map(|(here, there)| (here - there).powi(2)).sum::<f64>().sqrt()
        });
        let ratios = [errors_m[1] / errors_m[0], errors_m[2] / errors_m[1]];
        println!("errors {errors_m:?} m, ratios {ratios:?}");
        assert!(errors_m[0] > 1e-6 && ratios.iter().all(|ratio| (ratio - 2.0).abs() < 0.1));
    }
}
