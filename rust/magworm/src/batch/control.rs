//! One control step of a block: actions in, solver steps, what was seen out.

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

/// Where a control step of one block writes what it saw, one row per environment.
pub(super) struct ControlRows<'a> {
    /// Empty where observations are not wanted.
    pub observation: &'a mut [f32],
    pub progress_m: &'a mut [f64],
    pub status: &'a mut [u8],
}

impl<'a> ControlRows<'a> {
    pub(super) fn new(
        ((observation, progress_m), status): ((&'a mut [f32], &'a mut [f64]), &'a mut [u8]),
    ) -> Self {
        Self { observation, progress_m, status }
    }
}

/// One control step of a block whose first environment is `first`, see [`super::Batch::step`].
pub(super) fn control_block<R: Row>(
    model: &Model,
    block: &mut Block<R>,
    first: usize,
    actions: &[f64],
    rows: ControlRows<'_>,
    interruption: &Interruption<'_>,
) -> Result<(), Interrupted>
where
    Block<R>: Steps,
{
    let count = rows.status.len();
    if model.program.is_controlled() {
        let size = observe::action_size(model);
        for lane in 0..count {
            if block.status[lane] == Status::Running {
                let action = &actions[size * (first + lane)..][..size];
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
