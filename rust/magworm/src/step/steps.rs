//! Steps of a block on an instruction set of this processor.

use super::{advance, run_phase};
use crate::lanes::{
    InstructionSet, Isa, Scalar, ScalarSingle, WIDE, WIDE_SINGLE, WideTask, run_single_on,
    run_wide_on,
};
use crate::model::{Model, Phase};
use crate::state::Block;

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
