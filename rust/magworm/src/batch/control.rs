//! One control step of a block: actions in, solver steps, what was seen out.

use super::StepOutput;
use super::cohort::Cohort;
use crate::actuate::command;
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::Row;
use crate::lanes::math::sin_cos;
use crate::model::{Model, Robot};
use crate::observe;
use crate::state::{Block, Status};
use crate::step::Steps;

/// Steps times unknowns between two looks at an interruption: some milliseconds.
const PIECE: usize = 1 << 12;

/// Solver steps of a block, unless they are stopped on the way.
pub(crate) fn advance_block<R: Row>(
    model: &Model,
    block: &mut Block<R>,
    steps: u32,
    interruption: &Interruption<'_>,
) -> Result<(), Interrupted>
where
    Block<R>: Steps,
{
    let piece = (PIECE / model.coordinates.count.max(1)).max(1) as u32;
    let mut left = steps;
    while left > 0 {
        if interruption.stops() {
            return Err(Interrupted);
        }
        let now = left.min(piece);
        block.advance_on(block.set, model, now);
        left -= now;
    }
    Ok(())
}

/// How far the centre has moved towards where the head was.
fn progress_m([x, z, heading]: [f64; 3], [next_x, next_z, _]: [f64; 3]) -> f64 {
    if heading == 0.0 {
        return x - next_x;
    }
    let (sin, cos) = sin_cos(heading);
    (x - next_x) * cos - (z - next_z) * sin
}

/// One control step of a block, see [`super::Batch::step`]. `actions` are those of all environments, `rows` those of the block
/// alone.
pub(super) fn control_block<R: Row>(
    cohort: &mut Cohort<R>,
    actions: &[f64],
    rows: StepOutput<'_>,
    interruption: &Interruption<'_>,
) -> Result<(), Interrupted>
where
    Block<R>: Steps,
{
    let Cohort { seats, model, block } = cohort;
    let (model, count) = (&**model, seats.count);
    if model.program.is_controlled() {
        let size = observe::action_size(model);
        for lane in 0..count {
            if block.status[lane] == Status::Running {
                let action = &actions[size * (seats.first + lane)..][..size];
                command(model, block, lane, action);
            }
        }
    }
    for lane in 0..count {
        block.robot_before[lane] = block.robot_pose(model, Robot::AGENT, lane);
    }
    advance_block(model, block, model.steps_per_control, interruption)?;
    let width = observe::size(model);
    for lane in 0..count {
        let (before, after) =
            (block.robot_before[lane], block.robot_pose(model, Robot::AGENT, lane));
        // A robot that broke made no progress in this step.
        let runs = block.status[lane] == Status::Running;
        rows.progress_m[lane] = if runs { progress_m(before, after) } else { 0.0 };
        rows.status[lane] = block.status[lane] as u8;
    }
    for (lane, row) in rows.observation.chunks_mut(width).enumerate() {
        observe::write(model, block, lane, row);
    }
    Ok(())
}
