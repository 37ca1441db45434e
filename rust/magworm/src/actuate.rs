//! The actuators of a block: where they start, what an action tells them, how they move in a step.

use crate::actuator::{ActuatorRows, Clock, each};
use crate::draws::Draws;
use crate::lanes::{Dim, Isa, Real, Row};
use crate::model::Model;
use crate::scene::Parameter;
use crate::state::Block;

/// Puts the actuators of one lane where they start, each around its robot.
pub fn place<R: Row>(model: &Model, block: &mut Block<R>, lane: usize, draws: &mut Draws) {
    for (place, actuator) in model.program.actuators.iter().enumerate() {
        let robot = block.robot_pose(model, actuator.robot(), lane);
        let draws = model.scene.reset.random_drive.then_some(&mut *draws);
        actuator.place(block.actuator_rows(model, place), lane, robot, draws);
    }
}

/// Sets the targets of one lane from an action, to each actuator its own part. What is missing counts as 0.
pub fn command<R: Row>(model: &Model, block: &mut Block<R>, lane: usize, mut action: &[f64]) {
    for (place, actuator) in model.program.actuators.iter().enumerate() {
        let robot = block.robot_pose(model, actuator.robot(), lane);
        let rows = block.actuator_rows(model, place);
        let (own, rest) = action.split_at(rows.action.len().min(action.len()));
        actuator.command(rows, lane, robot, own);
        action = rest;
    }
}

/// Moves the actuators to where they are at the end of a step.
#[inline(always)]
pub fn advance<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Block { stage, target, action, step_count, factors, running, drive_load, .. } = block;
    let clock = Clock {
        steps: step_count,
        step_s: model.step_s,
        speed_factor: &factors[Parameter::DriveSpeed as usize],
        load_n: drive_load.first().map_or(isa.splat(0.0), |row| isa.load(row)),
        running: isa.load(&running[0]).eq(isa.splat(1.0)),
    };
    let rows = ActuatorRows { state: stage, target, action };
    for (actuator, rows) in each(&model.program.actuators, rows) {
        actuator.advance::<D, I>(isa, rows, clock);
    }
}
