//! Robots of a scene that act at random.

use magworm::Model;
use magworm::internals::lanes::Row;
use magworm::internals::{Block, Draws, command, reset, scene_start};

/// Control steps before anything is counted: the robots land and begin to crawl.
pub const BEFORE: u64 = 15;
/// Control steps that are counted.
pub const CONTROL_STEPS: u64 = 25;

/// The action of a robot in a control step; each is held for four.
pub fn action(robot: usize, control_step: u64) -> [f64; 5] {
    let mut draws = Draws::new(robot as u64, 1000 + control_step / 4);
    std::array::from_fn(|_| draws.uniform(-1.0, 1.0))
}

/// Robots at the start pose of their scene, from robot `first` on; so many are different, and more lanes repeat them.
pub fn start<R: Row>(model: &Model, first: usize, different: usize) -> Block<R> {
    let mut block = Block::new(model);
    let present = model.present();
    let factors = [1.0; Model::PARAMETERS.len()];
    for lane in 0..R::LANES {
        let draws = Draws::new(((first + lane) % different) as u64, 0);
        reset(model, &mut block, lane, scene_start(model), &factors, &present, draws);
    }
    block
}

/// Gives each of these robots its action of a control step.
pub fn act<R: Row>(
    model: &Model,
    block: &mut Block<R>,
    first: usize,
    different: usize,
    control_step: u64,
) {
    for lane in 0..R::LANES {
        command(model, block, lane, &action((first + lane) % different, control_step));
    }
}
