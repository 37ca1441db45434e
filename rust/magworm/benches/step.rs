//! Time, work and error of stepping `paper-3` with random actions, eight lanes against one.
//!
//! Prints environment steps per second of one thread and of all, the work counters per solver step, and
//! the ratio of wide to scalar: the median of several repetitions.

use magworm::internals::Draws;
use magworm::scene::Scene;
use magworm::{Batch, LaneChoice, Model, StepOutput, observe};
use std::sync::Arc;
use std::time::Instant;

const ENVIRONMENTS: usize = 256;
const CONTROL_STEPS: usize = 60;
const REPETITIONS: usize = 7;

/// Environment steps per second: median over the repetitions.
fn steps_per_second(model: &Arc<Model>, lanes: LaneChoice, threads: Option<usize>) -> (f64, Batch) {
    let mut batch = Batch::new(model.clone(), ENVIRONMENTS, lanes, threads);
    (0..ENVIRONMENTS).for_each(|k| batch.reset(k, k as u64, 0, None));
    let mut observation = vec![0.0; ENVIRONMENTS * observe::size(model)];
    let (mut progress_m, mut status) = (vec![0.0; ENVIRONMENTS], vec![0; ENVIRONMENTS]);
    let mut draws = Draws::new(1, 2);
    let mut rates: Vec<f64> = (0..REPETITIONS)
        .map(|_| {
            let actions: Vec<f64> =
                (0..3 * ENVIRONMENTS * CONTROL_STEPS).map(|_| draws.uniform(-1.0, 1.0)).collect();
            let start = Instant::now();
            for step in actions.chunks(3 * ENVIRONMENTS) {
                let output = StepOutput {
                    observation: &mut observation,
                    progress_m: &mut progress_m,
                    status: &mut status,
                };
                batch.step(step, output);
            }
            (ENVIRONMENTS * CONTROL_STEPS) as f64 / start.elapsed().as_secs_f64()
        })
        .collect();
    rates.sort_by(f64::total_cmp);
    (rates[REPETITIONS / 2], batch)
}

/// One block for a few control steps: short enough for a run under callgrind, which counts instructions.
fn brief(model: &Arc<Model>) {
    let mut batch = Batch::new(model.clone(), 8, LaneChoice::Wide, Some(1));
    (0..8).for_each(|k| batch.reset(k, k as u64, 0, None));
    batch.advance(200);
    println!("{:?}", batch.counters());
}

fn main() {
    let model = Scene::preset("paper-3").and_then(|scene| Model::compile(&scene));
    let model = Arc::new(model.expect("the preset is valid"));
    if std::env::args().any(|argument| argument == "--brief") {
        return brief(&model);
    }
    let (scalar, _) = steps_per_second(&model, LaneChoice::Scalar, Some(1));
    let (wide, batch) = steps_per_second(&model, LaneChoice::Wide, Some(1));
    let (all, _) = steps_per_second(&model, LaneChoice::Wide, None);
    let work = batch.counters();
    let per_step = |count: u64| count as f64 / work.steps as f64;
    println!("paper-3, {ENVIRONMENTS} environments, control step {} s", model.scene.control.step_s);
    println!("one thread, one lane     {scalar:>10.0} environment steps/s");
    println!(
        "one thread, eight lanes  {wide:>10.0} environment steps/s ({:.2} times)",
        wide / scalar
    );
    println!("all threads, eight lanes {all:>10.0} environment steps/s");
    println!(
        "per solver step of a block: {:.2} factorisations, {:.2} trials, {:.2} wrenches",
        per_step(work.factorisations),
        per_step(work.trials),
        per_step(work.wrenches)
    );
}
