//! What each phase of a step costs, measured.
//!
//! A block of robots of the scene acts at random from its start pose. The same run is made several times: trajectories are
//! equal bit for bit, so of each phase in each step the least time counts, and interruptions do not.

use crate::actuate::command;
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::{InstructionSet, Row, WIDE, WIDE_SINGLE};
use crate::model::{Model, Phase};
use crate::reset::{Draws, reset, scene_start};
use crate::scene::Precision;
use crate::state::Block;
use crate::step::Steps;
use std::fmt::Write;
use std::time::{Duration, Instant};

/// Solver steps of a run.
const STEPS: u32 = 200;
const RUNS: usize = 3;

/// The phases of a model's step in their order, each with its share of the time of a step; they sum to 1.
///
/// Takes as long as 600 steps of a block. Times differ from run to run by some per cent; nothing in a simulation
/// depends on them.
///
/// # Errors
/// The call was stopped.
pub fn shares(
    model: &Model,
    interruption: &Interruption<'_>,
) -> Result<Vec<(Phase, f64)>, Interrupted> {
    match model.scene.solver.precision {
        Precision::Double => shares_of::<[f64; WIDE]>(model, interruption),
        Precision::Single => shares_of::<[f32; WIDE_SINGLE]>(model, interruption),
    }
}

fn shares_of<R: Row>(
    model: &Model,
    interruption: &Interruption<'_>,
) -> Result<Vec<(Phase, f64)>, Interrupted>
where
    Block<R>: Steps,
{
    let phases = model.phases.len();
    let mut least = vec![Duration::MAX; phases * STEPS as usize];
    for _ in 0..RUNS {
        run::<R>(model, &mut least, interruption)?;
    }
    let of_phase = |phase| least.iter().skip(phase).step_by(phases).map(Duration::as_secs_f64);
    let total: f64 = least.iter().map(Duration::as_secs_f64).sum();
    let share = |phase| of_phase(phase).sum::<f64>() / total;
    Ok(model.phases.iter().enumerate().map(|(k, &phase)| (phase, share(k))).collect())
}

/// [`Model::explain`], and the share of each phase in percent.
///
/// # Errors
/// The call was stopped.
pub fn explain(model: &Model, interruption: &Interruption<'_>) -> Result<String, Interrupted> {
    let mut text = model.explain();
    text.push_str("\nshare of a step's time, measured with random actions\n");
    for (phase, share) in shares(model, interruption)? {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{:<16}{:>5.1} %", phase.name(), 100.0 * share);
    }
    Ok(text)
}

/// Lowers the times of phases, shape [steps × phases], to those of one more run.
fn run<R: Row>(
    model: &Model,
    least: &mut [Duration],
    interruption: &Interruption<'_>,
) -> Result<(), Interrupted>
where
    Block<R>: Steps,
{
    let mut block = start::<R>(model);
    for (step, row) in (0..STEPS).zip(least.chunks_mut(model.phases.len())) {
        if interruption.stops() {
            return Err(Interrupted);
        }
        if step.is_multiple_of(model.steps_per_control) {
            act(model, &mut block, u64::from(step / model.steps_per_control));
        }
        for (&phase, least) in model.phases.iter().zip(row) {
            let begin = Instant::now();
            block.run_phase_on(InstructionSet::widest(), model, phase);
            *least = begin.elapsed().min(*least);
        }
    }
    interruption.last_asked()
}

/// As many robots as a block has lanes at the scene's start pose.
fn start<R: Row>(model: &Model) -> Block<R> {
    let mut block = Block::new(model);
    let present = model.present();
    for lane in 0..R::LANES {
        let draws = Draws::new(lane as u64, 0);
        let factors = [1.0; Model::PARAMETERS.len()];
        reset(model, &mut block, lane, scene_start(model), &factors, &present, draws);
    }
    block
}

/// A random action for each robot, held for four control steps.
fn act<R: Row>(model: &Model, block: &mut Block<R>, control_step: u64) {
    for lane in 0..R::LANES {
        let mut draws = Draws::new(lane as u64, 1000 + control_step / 4);
        let action: [f64; 5] = std::array::from_fn(|_| draws.uniform(-1.0, 1.0));
        command(model, block, lane, &action);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn measured(preset: &str) -> Vec<(Phase, f64)> {
        let model = Scene::preset(preset).and_then(|scene| Model::compile(&scene));
        let model = model.expect("the preset is valid");
        shares(&model, &Interruption::never()).expect("nothing stops it")
    }

    #[test]
    fn shares_sum_to_one_and_are_those_of_the_phases_of_the_scene() {
        for preset in ["paper-3", "turn-3", "cantilever"] {
            let shares = measured(preset);
            let total: f64 = shares.iter().map(|(_, share)| share).sum();
            assert!((total - 1.0).abs() < 1e-9, "{preset}: {total}");
            assert!(shares.iter().all(|(_, share)| (0.0..1.0).contains(share)), "{shares:?}");
        }
    }

    #[test]
    fn what_a_scene_lacks_has_no_share() {
        let has = |shares: &[(Phase, f64)], phase| shares.iter().any(|(other, _)| *other == phase);
        let (crawler, beam) = (measured("paper-3"), measured("cantilever"));
        for phase in [Phase::Magnets, Phase::Drive, Phase::Contact, Phase::ContactPoints] {
            assert!(has(&crawler, phase) && !has(&beam, phase), "{}", phase.name());
        }
        assert!(has(&beam, Phase::System) && !has(&crawler, Phase::System));
    }

    #[test]
    fn the_phases_one_by_one_are_a_step() {
        let model = Scene::preset("turn-3").and_then(|scene| Model::compile(&scene));
        let model = model.expect("the preset is valid");
        let set = InstructionSet::widest();
        let (mut whole, mut parts) = (start::<[f64; WIDE]>(&model), start::<[f64; WIDE]>(&model));
        whole.advance_on(set, &model, 20);
        for _ in 0..20 {
            model.phases.iter().for_each(|&phase| parts.run_phase_on(set, &model, phase));
        }
        assert!(whole.state_rows().iter().zip(parts.state_rows()).all(|(a, b)| ***a == **b));
    }
}
