//! Steps of a scene: their operations, their chains and their time.

use crate::counting::{Counting, KINDS, Tally, tallied};
use crate::robots::{BEFORE, CONTROL_STEPS, act, start};
use crate::twin::{TWIN, Twin};
use magworm::internals::lanes::{InstructionSet, Isa, Row, Scalar, WIDE, WideTask, run_wide_on};
use magworm::internals::{Block, Steps, advance, run_phase};
use magworm::{Counters, Model};
use std::marker::PhantomData;
use std::time::{Duration, Instant};

/// Name of all phases together.
const STEP: &str = "step";

/// A block of robots that has begun to crawl.
fn crawling<R: Row<Number = f64>>(
    model: &Model,
    first: usize,
    mut steps: impl FnMut(&mut Block<R>),
) -> Block<R> {
    let mut block = start(model, first, WIDE);
    for control_step in 0..BEFORE {
        act(model, &mut block, first, WIDE, control_step);
        steps(&mut block);
    }
    block
}

/// The control steps that are looked at, one after the other.
fn crawl<R: Row<Number = f64>>(
    model: &Model,
    block: &mut Block<R>,
    first: usize,
    mut steps: impl FnMut(&mut Block<R>),
) {
    for control_step in BEFORE..BEFORE + CONTROL_STEPS {
        act(model, block, first, WIDE, control_step);
        steps(block);
    }
}

fn advance_wide(model: &Model, block: &mut Block<[f64; WIDE]>) {
    block.advance_on(InstructionSet::widest(), model, model.steps_per_control);
}

fn same<R: Row<Number = f64>>(one: &Block<R>, other: &Block<R>) -> bool {
    one.state_rows().iter().zip(other.state_rows()).all(|(a, b)| ***a == **b)
}

/// Lines of lanes, phase, rows of lanes that are read or written, chain [ns], operations by kind, and those in the longest
/// chain; all per solver step. One lane: the mean of the eight robots each alone.
///
/// # Errors
/// If a step that was counted differs from one that was not.
pub fn count(model: &Model, latency_ns: [f64; KINDS.len()]) -> Result<(), String> {
    let mut block = crawling(model, 0, |block| advance_wide(model, block));
    let mut sums = Sums::new(model);
    let mut uncounted = block.clone();
    let before = block.counters;
    crawl(model, &mut block, 0, |block| {
        (0..model.steps_per_control).for_each(|_| sums.step(model, latency_ns, block));
    });
    crawl(model, &mut uncounted, 0, |block| advance_wide(model, block));
    if !same(&block, &uncounted) {
        return Err("steps that were counted differ from those that were not".to_string());
    }
    sums.print(WIDE, block.counters, before);

    let mut alone = Sums::new(model);
    let (mut counters, mut before) = (Counters::default(), Counters::default());
    for robot in 0..WIDE {
        let steps =
            |block: &mut Block<[f64; 1]>| advance(Scalar, model, block, model.steps_per_control);
        let mut block = crawling(model, robot, steps);
        before = before.plus(block.counters);
        crawl(model, &mut block, robot, |block| {
            (0..model.steps_per_control).for_each(|_| alone.phases(model, latency_ns, block));
        });
        counters = counters.plus(block.counters);
    }
    alone.print(1, counters, before);
    Ok(())
}

/// What was tallied of each phase, and of whole steps last.
struct Sums {
    names: Vec<&'static str>,
    tallies: Vec<Tally>,
    rows: Vec<usize>,
}

impl Sums {
    fn new(model: &Model) -> Self {
        let phases = model.phases.iter().map(|phase| phase.name());
        let names: Vec<_> = phases.chain([STEP]).collect();
        let (tallies, rows) = (vec![Tally::default(); names.len()], vec![0; names.len()]);
        Self { names, tallies, rows }
    }

    fn add(&mut self, place: usize, found: &Tally) {
        self.rows[place] += found.rows.len();
        let sum = &mut self.tallies[place];
        sum.longest.ns += found.longest.ns;
        for kind in 0..KINDS.len() {
            sum.operations[kind] += found.operations[kind];
            sum.longest.operations[kind] += found.longest.operations[kind];
        }
    }

    /// A step, phase by phase, and once more as a whole for the chain that goes through all of it.
    fn step<R: Row<Number = f64>>(
        &mut self,
        model: &Model,
        latency_ns: [f64; KINDS.len()],
        block: &mut Block<R>,
    ) {
        let mut whole = block.clone();
        let run = || {
            model
                .phases
                .iter()
                .for_each(|&p| run_phase(Counting(PhantomData), model, &mut whole, p))
        };
        self.add(self.names.len() - 1, &tallied(latency_ns, run));
        self.phases(model, latency_ns, block);
    }

    fn phases<R: Row<Number = f64>>(
        &mut self,
        model: &Model,
        latency_ns: [f64; KINDS.len()],
        block: &mut Block<R>,
    ) {
        for (place, &phase) in model.phases.iter().enumerate() {
            let found =
                tallied(latency_ns, || run_phase(Counting(PhantomData), model, block, phase));
            self.add(place, &found);
        }
        block.counters.steps += 1;
    }

    fn print(&self, lanes: usize, after: Counters, before: Counters) {
        let steps = (after.steps - before.steps) as f64;
        for ((name, tally), rows) in self.names.iter().zip(&self.tallies).zip(&self.rows) {
            let rows = *rows as f64 / steps;
            let operations = tally.operations.map(|count| format!("{}", count as f64 / steps));
            let chain =
                tally.longest.operations.map(|count| format!("{}", f64::from(count) / steps));
            let ns = tally.longest.ns / steps;
            println!("{lanes},{name},{rows},{ns},{},{}", operations.join(","), chain.join(","));
        }
        let systems = (after.factorisations - before.factorisations) as f64 / steps;
        let trials = (after.trials - before.trials) as f64 / steps;
        println!("{lanes},systems,{systems}\n{lanes},trials,{trials}");
    }
}

/// Lines of instruction set, lanes, phase and nanoseconds of a solver step; every run is one line each. The clock's own
/// time is taken off the phases. One lane: the mean of the eight robots each alone.
///
/// # Errors
/// If sixteen lanes do not do what eight do.
pub fn measure(model: &Model, runs: usize) -> Result<(), String> {
    let eight = crawling(model, 0, |block| advance_wide(model, block));
    let sixteen: Block<[f64; TWIN]> = crawling(model, 0, |block| advance_twin(model, block));
    let one: Vec<Block<[f64; 1]>> = (0..WIDE)
        .map(|robot| {
            crawling(model, robot, |block| advance(Scalar, model, block, model.steps_per_control))
        })
        .collect();
    if eight.q[0][..] != sixteen.q[0][..WIDE] || eight.q[0][..] != sixteen.q[0][WIDE..] {
        return Err("sixteen lanes do not do what eight do".to_string());
    }
    let steps = CONTROL_STEPS as f64 * f64::from(model.steps_per_control);
    let widest = InstructionSet::widest().name();
    for _ in 0..runs {
        for set in InstructionSet::available() {
            let whole = |block: &mut Block<[f64; WIDE]>| {
                block.advance_on(set, model, model.steps_per_control);
            };
            print(
                set.name(),
                WIDE,
                STEP,
                run(model, eight.clone(), 0, whole).as_nanos() as f64 / steps,
            );
            by_phases(model, set, eight.clone(), steps);
        }
        let twins = run(model, sixteen.clone(), 0, |block| advance_twin(model, block));
        print(widest, TWIN, STEP, twins.as_nanos() as f64 / steps);
        let alone = one.iter().enumerate().map(|(robot, block)| {
            run(model, block.clone(), robot, |block| {
                advance(Scalar, model, block, model.steps_per_control)
            })
        });
        let alone: Duration = alone.sum();
        print("one lane", 1, STEP, alone.as_nanos() as f64 / steps / WIDE as f64);
    }
    Ok(())
}

fn print(set: &str, lanes: usize, phase: &str, ns: f64) {
    println!("{set},{lanes},{phase},{ns}");
}

/// Time of all solver steps, actions left out.
fn run<R: Row<Number = f64>>(
    model: &Model,
    mut block: Block<R>,
    first: usize,
    mut steps: impl FnMut(&mut Block<R>),
) -> Duration {
    let mut sum = Duration::ZERO;
    crawl(model, &mut block, first, |block| {
        let begin = Instant::now();
        steps(block);
        sum += begin.elapsed();
    });
    sum
}

/// Prints the time of each phase.
fn by_phases(model: &Model, set: InstructionSet, mut block: Block<[f64; WIDE]>, steps: f64) {
    let mut sums = vec![Duration::ZERO; model.phases.len()];
    crawl(model, &mut block, 0, |block| {
        for _ in 0..model.steps_per_control {
            for (&phase, sum) in model.phases.iter().zip(&mut sums) {
                let begin = Instant::now();
                block.run_phase_on(set, model, phase);
                *sum += begin.elapsed();
            }
        }
    });
    let clock = clock_ns();
    for (phase, sum) in model.phases.iter().zip(sums) {
        print(set.name(), WIDE, phase.name(), sum.as_nanos() as f64 / steps - clock);
    }
}

/// What the clock tells of a time in which nothing is done [ns]: the least of several means, none of which is long
/// enough to be interrupted often.
fn clock_ns() -> f64 {
    const MEANS: u32 = 20;
    const TIMES: u32 = 100;
    let mut least = Duration::MAX;
    for _ in 0..MEANS {
        let mut sum = Duration::ZERO;
        for _ in 0..TIMES {
            let begin = Instant::now();
            sum += begin.elapsed();
        }
        least = least.min(sum);
    }
    least.as_nanos() as f64 / f64::from(TIMES)
}

/// Two blocks side by side.
fn advance_twin(model: &Model, block: &mut Block<[f64; TWIN]>) {
    struct Task<'a>(&'a Model, &'a mut Block<[f64; TWIN]>);
    impl WideTask for Task<'_> {
        type Output = ();
        #[inline(always)]
        fn run<I: Isa<Row = [f64; WIDE]>>(self, isa: I) {
            advance(Twin(isa), self.0, self.1, self.0.steps_per_control);
        }
    }
    run_wide_on(InstructionSet::widest(), Task(model, block));
}
