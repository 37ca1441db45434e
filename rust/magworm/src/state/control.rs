//! One control step of a block: actions in, solver steps, what was seen out.

use super::block::{Block, Status};
use crate::actuate::command;
use crate::lanes::math::sin_cos;
use crate::lanes::{
    InstructionSet, Isa, Row, Scalar, ScalarSingle, WIDE, WIDE_SINGLE, WideTask, run_single_on,
    run_wide_on,
};
use crate::model::{Model, Phase};
use crate::observe;
use crate::step::{advance, run_phase};

/// A block that knows how to step itself. Bits are those of any other instruction set.
pub trait Steps: Send {
    /// `steps` solver steps on an instruction set of this processor; one lane takes none.
    fn advance_on(&mut self, set: InstructionSet, model: &Model, steps: u32);
    /// One phase of a solver step, to be looked at on its own; the phases of the model one after another are a step.
    fn run_phase_on(&mut self, set: InstructionSet, model: &Model, phase: Phase);
}

macro_rules! one_lane {
    ($number:ty, $isa:expr) => {
        impl Steps for Block<[$number; 1]> {
            fn advance_on(&mut self, _: InstructionSet, model: &Model, steps: u32) {
                advance($isa, model, self, steps);
            }
            fn run_phase_on(&mut self, _: InstructionSet, model: &Model, phase: Phase) {
                run_phase($isa, model, self, phase);
            }
        }
    };
}

macro_rules! many_lanes {
    ($lanes:ident, $number:ty, $run_on:ident) => {
        impl Steps for Block<[$number; $lanes]> {
            fn advance_on(&mut self, set: InstructionSet, model: &Model, steps: u32) {
                struct Task<'a>(&'a Model, &'a mut Block<[$number; $lanes]>, u32);
                impl WideTask<[$number; $lanes]> for Task<'_> {
                    type Output = ();
                    #[inline(always)]
                    fn run<I: Isa<Row = [$number; $lanes]>>(self, isa: I) {
                        advance(isa, self.0, self.1, self.2);
                    }
                }
                $run_on(set, Task(model, self, steps));
            }

            fn run_phase_on(&mut self, set: InstructionSet, model: &Model, phase: Phase) {
                struct Task<'a>(&'a Model, &'a mut Block<[$number; $lanes]>, Phase);
                impl WideTask<[$number; $lanes]> for Task<'_> {
                    type Output = ();
                    #[inline(always)]
                    fn run<I: Isa<Row = [$number; $lanes]>>(self, isa: I) {
                        run_phase(isa, self.0, self.1, self.2);
                    }
                }
                $run_on(set, Task(model, self, phase));
            }
        }
    };
}

one_lane!(f64, Scalar);
one_lane!(f32, ScalarSingle);
many_lanes!(WIDE, f64, run_wide_on);
many_lanes!(WIDE_SINGLE, f32, run_single_on);

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
) where
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
        block.robot_before[lane] = block.robot_pose(model, lane);
    }
    block.advance_on(InstructionSet::widest(), model, model.steps_per_control);
    let width = observe::size(model);
    for lane in 0..count {
        rows.progress_m[lane] = progress_m(block.robot_before[lane], block.robot_pose(model, lane));
        rows.status[lane] = block.status[lane] as u8;
    }
    for (lane, row) in rows.observation.chunks_mut(width).enumerate() {
        observe::write(model, block, lane, row);
    }
}
