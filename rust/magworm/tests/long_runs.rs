//! Runs of days: single precision counts its steps in whole numbers and keeps time beyond 2²⁴ of them.

mod base;

use base::base;
use magworm::internals::lanes::{InstructionSet, Row};
use magworm::internals::{Block, Draws, Steps, reset, scene_start};
use magworm::{Model, Status};

/// The last number up to which `f32` counts.
const COUNTED_IN_F32: u64 = 1 << 24;
const SPEED_M_S: f64 = 0.1;
const START_M: f64 = -0.05;

/// `robot` in single precision above a drive with edits, at its start.
fn robot<R: Row>(motion: &str) -> (Model, Block<R>) {
    let edits = [("solver.precision", "'single'"), ("drive.motion", motion)]
        .map(|(path, value)| (path.to_string(), Some(value.parse().expect("TOML"))));
    let scene = base("robot").with_values(&edits);
    let model = Model::compile(&scene.expect("a valid scene")).expect("a model");
    let (mut block, start) = (Block::new(&model), scene_start(&model));
    let present = vec![true; model.magnets()];
    let factors = [1.0; Model::PARAMETERS.len()];
    reset(&model, &mut block, 0, start, &factors, &present, Draws::new(0, 0));
    (model, block)
}

/// A drive that has passed a hundred steps before 2²⁴ goes on at its speed beyond it.
#[test]
fn time_goes_on_beyond_the_whole_numbers_of_single_precision() {
    const STEPS: u64 = 1000;
    let motion = format!("{{kind='constant',x_m={START_M},y_m=-0.052,speed_m_s={SPEED_M_S}}}");
    let (model, mut block) = robot::<[f32; 1]>(&motion);
    block.step_count[0] = COUNTED_IN_F32 - 100;
    for step in 1..=STEPS {
        block.advance_on(InstructionSet::widest(), &model, 1);
        let count = COUNTED_IN_F32 - 100 + step;
        assert_eq!((block.step_count[0], block.status[0]), (count, Status::Running));
        let exact_m = START_M + SPEED_M_S * model.step_s * count as f64;
        let rounding_m = exact_m * f64::from(f32::EPSILON);
        let off_m = f64::from(block.stage[0][0]) - exact_m;
        assert!(off_m.abs() <= rounding_m, "step {count}: the drive is off by {off_m} m");
    }
}

/// Ten million steps, five and a half hours: a robot at rest stays where it is, and time is what it should be.
#[test]
#[ignore = "minutes: make test-nightly"]
fn a_robot_stands_still_for_ten_million_steps_in_single_precision() {
    const STEPS: u32 = 10_000_000;
    let (model, mut block) =
        robot::<[f32; 1]>("{kind='constant',x_m=0.027,y_m=-0.052,speed_m_s=0}");
    let set = InstructionSet::widest();
    block.advance_on(set, &model, 1000);
    let start = block.robot_pose(&model, 0, 0);
    block.advance_on(set, &model, STEPS);
    assert_eq!((block.step_count[0], block.status[0]), (u64::from(STEPS) + 1000, Status::Running));
    let end = block.robot_pose(&model, 0, 0);
    assert!((end[0] - start[0]).abs() < 1e-6, "from {start:?} to {end:?}");
}
