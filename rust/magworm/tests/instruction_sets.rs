//! Equal bits on every instruction set of this processor, from SSE2 to AVX-512, and in plain `f64` or `f32`.

#[path = "pins/pin/mod.rs"]
mod pin;
mod scenes;

use magworm::internals::lanes::{InstructionSet, Number, Row, WIDE, WIDE_SINGLE};
use magworm::internals::{Block, Draws, Steps, command, reset, scene_start};
use magworm::scene::Precision;
use magworm::{LaneChoice, Model};

const CONTROL_STEPS: u64 = 60;

/// Starts the robots `first..` in the lanes of a block, each with parameters of its own.
fn start<R: Row>(model: &Model, first: usize) -> Block<R> {
    let mut block = Block::new(model);
    for lane in 0..R::LANES {
        let robot = (first + lane) as u64;
        let mut draws = Draws::new(robot, 7);
        let factors = Model::PARAMETERS.map(|_| draws.uniform(0.4, 2.5));
        let present: Vec<bool> = (0..model.magnets()).map(|m| m as u64 % 4 != robot % 5).collect();
        let mut pose = scene_start(model);
        pose.angle_rad += 0.01 * robot as f64;
        if model.dimensions() == 3 {
            pose.yaw_rad += 0.7 * robot as f64;
        }
        reset(model, &mut block, lane, pose, &factors, &present, Draws::new(robot, 0));
    }
    block
}

/// New targets for the robots `first..`, where the scene takes any.
fn act<R: Row>(model: &Model, block: &mut Block<R>, first: usize, control_step: u64) {
    for lane in 0..R::LANES {
        let mut draws = Draws::new((first + lane) as u64, 1000 + control_step / 4);
        let action: [f64; 5] = std::array::from_fn(|_| draws.uniform(-1.0, 1.0));
        command(model, block, lane, &action);
    }
}

/// The bits of one lane's state.
fn bits<R: Row>(block: &Block<R>, lane: usize) -> Vec<u64> {
    let rows = block.state_rows();
    let state = rows.iter().flat_map(|rows| rows.iter().map(|row| row[lane].f64().to_bits()));
    state.chain([u64::from(block.status[lane] as u8)]).collect()
}

/// State of the robots `first..` of a block after every control step, `[control step][lane]`.
fn on<R: Row>(set: InstructionSet, model: &Model, first: usize) -> Vec<Vec<Vec<u64>>>
where
    Block<R>: Steps,
{
    let mut block = start::<R>(model, first);
    let steps = (0..CONTROL_STEPS).map(|control_step| {
        act(model, &mut block, first, control_step);
        block.advance_on(set, model, model.steps_per_control);
        (0..R::LANES).map(|lane| bits(&block, lane)).collect()
    });
    steps.collect()
}

/// Blocks on every instruction set, and their robots one by one.
fn agree<R: Row>(name: &str, model: &Model)
where
    Block<R>: Steps,
    Block<[R::Number; 1]>: Steps,
{
    let sets = InstructionSet::available();
    let widest = on::<R>(sets[0], model, 0);
    for set in &sets[1..] {
        assert!(on::<R>(*set, model, 0) == widest, "{name}: {} differs", set.name());
    }
    for robot in 0..R::LANES {
        let alone = on::<[R::Number; 1]>(sets[0], model, robot);
        let lanes = widest.iter().map(|step| &step[robot]);
        assert!(alone.iter().map(|step| &step[0]).eq(lanes), "{name}: robot {robot} alone differs");
    }
}

#[test]
fn every_instruction_set_gives_equal_bits() {
    let sets = InstructionSet::available();
    println!("instruction sets: {:?}", sets.iter().map(|set| set.name()).collect::<Vec<_>>());
    for (name, ..) in scenes::SCENES {
        let model = scenes::model(name);
        match model.scene.solver.precision {
            Precision::Double => agree::<[f64; WIDE]>(name, &model),
            Precision::Single => agree::<[f32; WIDE_SINGLE]>(name, &model),
        }
    }
}

/// Pins in the plane and in space, with and without ground, in both precisions; `tests/pins` runs all on the widest set.
#[test]
fn narrower_instruction_sets_keep_pinned_trajectories() {
    for set in &InstructionSet::available()[1..] {
        for name in ["three_magnets", "cantilever_in_space", "turn", "single_precision_in_space"] {
            let mut robots = pin::Robots::new(&pin::model(name), pin::ALL, LaneChoice::Wide);
            robots.batch.use_instruction_set(*set);
            println!("{name} on {}", set.name());
            pin::check(name, robots.run(pin::CONTROL_STEPS));
        }
    }
}

#[test]
fn the_widest_instruction_set_comes_first_and_none_twice() {
    let names: Vec<_> = InstructionSet::available().iter().map(|set| set.name()).collect();
    assert_eq!(names[0], InstructionSet::widest().name());
    assert!((1..names.len()).all(|k| !names[..k].contains(&names[k])), "{names:?}");
    #[cfg(target_arch = "x86_64")]
    assert!(names.contains(&"SSE2"), "every x86-64 has SSE2: {names:?}");
}
