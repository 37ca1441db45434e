//! Stepping allocates nothing. In a program of its own, without libtest: the counter sees every thread.

mod scenes;

use magworm::{Batch, LaneChoice, Status, StepOutput};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const ENVIRONMENTS: usize = 24;
const CONTROL_STEPS: usize = 300;

/// A batch with everything that a caller has to bring.
struct Caller {
    batch: Batch,
    actions: Vec<f64>,
    observation: Vec<f32>,
    progress_m: Vec<f64>,
    status: Vec<u8>,
}

impl Caller {
    fn new(scene: &str, lanes: LaneChoice, threads: usize) -> Self {
        let model = scenes::model(scene);
        let width = magworm::observe::size(&model);
        let actions = magworm::observe::action_size(&model) * ENVIRONMENTS;
        let mut batch = Batch::new(model, ENVIRONMENTS, lanes, Some(threads));
        // Almost no stiffness: one environment breaks on the way.
        batch.factors_mut()[0] = 1e-9;
        (0..ENVIRONMENTS).for_each(|environment| batch.reset(environment, 1, 0, None));
        Self {
            batch,
            actions: (0..actions).map(|k| (k as f64).sin()).collect(),
            observation: vec![0.0; ENVIRONMENTS * width],
            progress_m: vec![0.0; ENVIRONMENTS],
            status: vec![0; ENVIRONMENTS],
        }
    }

    fn step(&mut self) {
        self.actions.rotate_left(1);
        self.batch.step(
            &self.actions,
            StepOutput {
                observation: &mut self.observation,
                progress_m: &mut self.progress_m,
                status: &mut self.status,
            },
        );
    }

    /// Everything that a training loop calls over and over.
    fn go_on(&mut self, control_steps: usize) {
        for _ in 0..control_steps {
            self.step();
            self.batch.advance(2);
            self.batch.observe(&mut self.observation);
            self.batch.reset(ENVIRONMENTS - 1, 3, 1, None);
        }
    }
}

/// Allocations and reallocations while a caller goes on, once it has warmed up.
fn allocations(scene: &str, lanes: LaneChoice, threads: usize) -> usize {
    let mut caller = Caller::new(scene, lanes, threads);
    caller.go_on(5);
    let region = Region::new(COUNTING);
    caller.go_on(CONTROL_STEPS);
    let change = region.change();
    assert!(caller.batch.status(1) == Status::Running, "{scene}: nothing was stepped");
    change.allocations + change.reallocations
}

/// Scenes that together step through every kernel.
const SCENES: [&str; 5] =
    ["three magnets", "belt", "cantilever", "three magnets in space", "belt in space"];

/// Most allocations of rayon's queue: it makes a new block for every 63 jobs handed to the pool, and
/// `step` and `advance` hand in one each. Where the threads are interrupted, what they leave to be freed
/// is collected in further blocks, fewer than those.
const QUEUE: usize = 2 * (2 * CONTROL_STEPS).div_ceil(63);

fn main() {
    for (threads, most) in [(1, 0), (2, QUEUE)] {
        for scene in SCENES {
            for lanes in [LaneChoice::Wide, LaneChoice::Scalar] {
                let count = allocations(scene, lanes, threads);
                println!("{scene}, {lanes:?}, {threads} threads: {count}");
                assert!(count <= most, "{scene}, {lanes:?}, {threads} threads: {count}");
            }
        }
    }
}
