//! One control step of a block: actions in, solver steps, what was seen out.

use super::block::{Block, Status};
use crate::lanes::math::sin_cos;
use crate::lanes::{InstructionSet, Isa, Scalar, WIDE, WideTask, run_wide_on};
use crate::model::{Model, Phase};
use crate::observe;
use crate::step::{advance, command, run_phase};

/// A block that knows how to step itself.
pub(super) trait Steps: Send {
    fn run(&mut self, model: &Model, steps: u32);
}

impl Steps for Block<1> {
    fn run(&mut self, model: &Model, steps: u32) {
        advance(Scalar, model, self, steps);
    }
}

impl Steps for Block<WIDE> {
    fn run(&mut self, model: &Model, steps: u32) {
        self.advance_on(InstructionSet::widest(), model, steps);
    }
}

impl Block<WIDE> {
    /// `steps` solver steps on an instruction set of this processor; the bits are those of any other.
    pub fn advance_on(&mut self, set: InstructionSet, model: &Model, steps: u32) {
        struct Task<'a>(&'a Model, &'a mut Block<WIDE>, u32);
        impl WideTask for Task<'_> {
            type Output = ();
            #[inline(always)]
            fn run<I: Isa<WIDE>>(self, isa: I) {
                advance(isa, self.0, self.1, self.2);
            }
        }
        run_wide_on(set, Task(model, self, steps));
    }

    /// One phase of a solver step, to be looked at on its own; the phases of the model one after another are a step.
    pub fn run_phase_on(&mut self, set: InstructionSet, model: &Model, phase: Phase) {
        struct Task<'a>(&'a Model, &'a mut Block<WIDE>, Phase);
        impl WideTask for Task<'_> {
            type Output = ();
            #[inline(always)]
            fn run<I: Isa<WIDE>>(self, isa: I) {
                run_phase(isa, self.0, self.1, self.2);
            }
        }
        run_wide_on(set, Task(model, self, phase));
    }
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
pub(super) fn control_block<const W: usize>(
    model: &Model,
    block: &mut Block<W>,
    first: usize,
    actions: &[f64],
    rows: ControlRows<'_>,
) where
    Block<W>: Steps,
{
    let count = rows.status.len();
    if let Some(drive) = model.program.drive.as_ref().filter(|d| d.is_controlled()) {
        let size = observe::action_size(model);
        for lane in 0..count {
            if block.status[lane] == Status::Running {
                let action = &actions[size * (first + lane)..][..size];
                command(model, drive, block, lane, action);
            }
        }
    }
    let before: [[f64; 3]; W] = std::array::from_fn(|lane| block.robot_pose(model, lane));
    block.run(model, model.steps_per_control);
    let width = observe::size(model);
    for lane in 0..count {
        rows.progress_m[lane] = progress_m(before[lane], block.robot_pose(model, lane));
        rows.status[lane] = block.status[lane] as u8;
    }
    for (lane, row) in rows.observation.chunks_mut(width).enumerate() {
        observe::write(model, block, lane, row);
    }
}
