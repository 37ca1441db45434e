//! Blocks in the air: contact solves one system a step, and a robot has the same bits whoever lies beside it.

mod scenes;

use magworm::internals::lanes::{Row, Scalar, WIDE};
use magworm::internals::{Block, Draws, Steps, advance, reset, scene_start};
use magworm::{Model, Status};

const SCENES: [&str; 4] = ["three magnets", "three magnets in space", "multipliers", "incline"];

/// Puts a robot at rest so high into a lane, turned a little, so that it lands on an edge.
fn drop_from<R: Row<Number = f64>>(
    model: &Model,
    block: &mut Block<R>,
    lane: usize,
    height_m: f64,
) {
    let mut pose = scene_start(model);
    pose.height_m = height_m;
    pose.angle_rad = 0.05;
    let present = vec![true; model.magnets()];
    let factors = [1.0; Model::PARAMETERS.len()];
    reset(model, block, lane, pose, &factors, &present, Draws::new(1, 0));
}

fn bits<R: Row<Number = f64>>(block: &Block<R>, lane: usize) -> Vec<u64> {
    let rows = block.state_rows();
    rows.iter().flat_map(|rows| rows.iter().map(|row| row[lane].to_bits())).collect()
}

/// Heights from the ground up: when the first robots lie, the last ones still fall.
fn height_m(lane: usize) -> f64 {
    0.002 * (lane * lane) as f64
}

#[test]
fn a_falling_robot_has_equal_bits_alone_and_beside_robots_that_lie() {
    for name in SCENES {
        let model = scenes::model(name);
        let steps = (0.2 / model.step_s) as u32;
        let mut together = Block::<[f64; WIDE]>::new(&model);
        (0..WIDE).for_each(|lane| drop_from(&model, &mut together, lane, height_m(lane)));
        let mut alone: Vec<Block<[f64; 1]>> = (0..WIDE).map(|_| Block::new(&model)).collect();
        (0..WIDE).for_each(|lane| drop_from(&model, &mut alone[lane], 0, height_m(lane)));
        let set = magworm::internals::lanes::InstructionSet::widest();
        let mut flew_beside_one_that_lay = 0;
        for step in 0..steps {
            together.advance_on(set, &model, 1);
            let tried: Vec<bool> = alone
                .iter_mut()
                .map(|block| {
                    let before = block.counters.trials;
                    advance(Scalar, &model, block, 1);
                    block.counters.trials > before
                })
                .collect();
            flew_beside_one_that_lay += u32::from(tried[0] && !tried[WIDE - 1]);
            for lane in 0..WIDE {
                let place = format!("{name}, step {step}, lane {lane}");
                assert!(bits(&together, lane) == bits(&alone[lane], 0), "{place}");
            }
        }
        assert!(together.status.iter().all(|status| *status == Status::Running), "{name}");
        assert!(flew_beside_one_that_lay > steps / 4, "{name}: {flew_beside_one_that_lay}");
    }
}

#[test]
fn a_block_in_the_air_solves_one_system_a_step() {
    for name in SCENES {
        let model = scenes::model(name);
        let mut block = Block::<[f64; WIDE]>::new(&model);
        (0..WIDE).for_each(|lane| drop_from(&model, &mut block, lane, 1.0));
        block.advance_on(magworm::internals::lanes::InstructionSet::widest(), &model, 50);
        let work = block.counters;
        assert_eq!((work.steps, work.factorisations, work.trials), (50, 50, 0), "{name}");
    }
}
