//! Runs one named task, whose work callgrind counts in instructions:
//!
//! ```text
//! valgrind --tool=callgrind --toggle-collect='*counted*' magworm-count paper-3
//! ```
//!
//! Only what runs within [`counted`] is collected. Prints how many units (steps, wrenches, control steps) that was.
//! Without an argument prints the names of all tasks. With the name of a phase behind that of a task of solver steps only
//! this phase is collected; with `phases` their names are printed. `studies/needs/counts.py` runs all this and compares.
//!
//! An example of this package since the extension's own build of the simulator then serves it as well.

mod cases;
mod robots;
mod wrench;

use cases::{CASES, Case, Work};
use magworm::internals::lanes::{InstructionSet, Row, WIDE, WIDE_SINGLE};
use magworm::internals::{Block, Phase, Steps};
use magworm::scene::Precision;
use magworm::{Batch, LaneChoice, Model, StepOutput, observe};
use robots::{BEFORE, CONTROL_STEPS, act, action, start};
use std::process::ExitCode;
use std::sync::Arc;

/// The function that collects.
#[inline(never)]
fn counted(work: &mut dyn FnMut()) {
    work();
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let said = match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => Ok(CASES.iter().map(|case| case.name).collect::<Vec<_>>().join("\n")),
        [name] => run(name, None).map(|units| units.to_string()),
        [name, "phases"] => phases(name),
        [name, phase, ..] => run(name, Some(phase)).map(|units| units.to_string()),
    };
    match said {
        Ok(text) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("count: {message}");
            ExitCode::FAILURE
        }
    }
}

fn find(name: &str) -> Result<&'static Case, String> {
    let case = CASES.iter().find(|case| case.name == name);
    case.ok_or_else(|| format!("task is {name:?}; allowed: those that are printed without one"))
}

/// Names of the phases of a task's step.
fn phases(name: &str) -> Result<String, String> {
    let model = find(name)?.model()?;
    Ok(model.phases.iter().map(|phase| phase.name()).collect::<Vec<_>>().join("\n"))
}

/// Units of work done.
fn run(name: &str, phase: Option<&str>) -> Result<u64, String> {
    let case = find(name)?;
    let model = Arc::new(case.model()?);
    match case.work {
        Work::Block => match model.scene.solver.precision {
            Precision::Double => block::<[f64; WIDE]>(&model, avx2()?, phase),
            Precision::Single => block::<[f32; WIDE_SINGLE]>(&model, avx2()?, phase),
        },
        Work::Wrench => wrench::count(&model, avx2()?),
        Work::Scalar => Ok(scalar(&model)),
        Work::Control => {
            let widest = InstructionSet::widest().name();
            if widest != "AVX2" {
                return Err(format!(
                    "instruction set is {widest}; allowed: AVX2, that of the counts"
                ));
            }
            Ok(control(&model))
        }
    }
}

/// The instruction set of all counts: valgrind knows no AVX-512, and every processor of recent years has this one.
fn avx2() -> Result<InstructionSet, String> {
    let sets = InstructionSet::available();
    let found = sets.iter().find(|set| set.name() == "AVX2").copied();
    found.ok_or_else(|| format!("instruction set is {}; allowed: AVX2", sets[0].name()))
}

/// Solver steps of a block of robots, each with actions of its own. `phase`: all if none.
fn block<R: Row>(model: &Model, set: InstructionSet, phase: Option<&str>) -> Result<u64, String>
where
    Block<R>: Steps,
{
    let chosen = match phase {
        None => None,
        Some(name) => {
            let found = model.phases.iter().find(|phase| phase.name() == name);
            Some(*found.ok_or_else(|| format!("phase is {name:?}; allowed: those of the task"))?)
        }
    };
    let mut block = start::<R>(model, 0, R::LANES);
    for control_step in 0..BEFORE + CONTROL_STEPS {
        act(model, &mut block, 0, R::LANES, control_step);
        let steps = model.steps_per_control;
        if control_step < BEFORE {
            block.advance_on(set, model, steps);
        } else if let Some(chosen) = chosen {
            (0..steps).for_each(|_| step_by_phases(&mut block, set, model, chosen));
        } else {
            counted(&mut || block.advance_on(set, model, steps));
        }
    }
    Ok(CONTROL_STEPS * u64::from(model.steps_per_control))
}

/// A solver step of which one phase is counted.
fn step_by_phases(block: &mut impl Steps, set: InstructionSet, model: &Model, chosen: Phase) {
    for &phase in &model.phases {
        let mut run = || block.run_phase_on(set, model, phase);
        if phase == chosen { counted(&mut run) } else { run() }
    }
}

/// Solver steps of one robot in plain `f64`.
fn scalar(model: &Arc<Model>) -> u64 {
    let mut batch = Batch::new(model.clone(), 1, LaneChoice::Scalar, Some(1));
    batch.reset(0, 0, 0, None);
    let mut caller = Caller::new(model, 1);
    for control_step in 0..BEFORE + CONTROL_STEPS {
        caller.act(control_step);
        let mut advance = || caller.step(&mut batch);
        if control_step < BEFORE { advance() } else { counted(&mut advance) }
    }
    CONTROL_STEPS * u64::from(model.steps_per_control)
}

/// Control steps of a batch of eight environments, with actions and observations.
fn control(model: &Arc<Model>) -> u64 {
    let mut batch = Batch::new(model.clone(), WIDE, LaneChoice::Wide, Some(1));
    (0..WIDE).for_each(|robot| batch.reset(robot, robot as u64, 0, None));
    let mut caller = Caller::new(model, WIDE);
    for control_step in 0..BEFORE + CONTROL_STEPS {
        caller.act(control_step);
        let mut advance = || caller.step(&mut batch);
        if control_step < BEFORE { advance() } else { counted(&mut advance) }
    }
    CONTROL_STEPS
}

/// The arrays that a caller of a batch brings.
struct Caller {
    actions: Vec<f64>,
    size: usize,
    observation: Vec<f32>,
    progress_m: Vec<f64>,
    status: Vec<u8>,
}

impl Caller {
    fn new(model: &Model, robots: usize) -> Self {
        let size = observe::action_size(model);
        Self {
            actions: vec![0.0; robots * size],
            size,
            observation: vec![0.0; robots * observe::size(model)],
            progress_m: vec![0.0; robots],
            status: vec![0; robots],
        }
    }

    fn act(&mut self, control_step: u64) {
        for (robot, row) in self.actions.chunks_mut(self.size.max(1)).enumerate() {
            row.copy_from_slice(&action(robot, control_step)[..self.size]);
        }
    }

    fn step(&mut self, batch: &mut Batch) {
        let output = StepOutput {
            observation: &mut self.observation,
            progress_m: &mut self.progress_m,
            status: &mut self.status,
        };
        batch.step(&self.actions, output);
    }
}
