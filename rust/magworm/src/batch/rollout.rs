//! Whole trajectories: the actions of many control steps, known beforehand, in one call.
//!
//! Each block runs all its control steps in one task of the pool. So its state stays in the cache of one core, and
//! threads wait for each other once a call instead of once a control step.

use super::StepOutput;
use super::cohort::Cohort;
use super::control::control_block;
use super::view::View;
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::Row;
use crate::model::{Model, Robot};
use crate::state::Block;
use crate::step::Steps;
use rayon::ThreadPool;
use rayon::iter::{
    IndexedParallelIterator, IntoParallelIterator, IntoParallelRefMutIterator, ParallelIterator,
};

/// The actions of T control steps.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// Number T of control steps.
    pub control_steps: usize,
    /// In [−1, 1] and finite, shape [T × environments × action]; empty where the drive is not controlled.
    pub actions: &'a [f64],
}

/// Where a rollout writes what it saw after each of T control steps. Broken environments stand still; their status
/// says so from then on.
pub struct RolloutOutput<'a> {
    /// Progress towards the head in the control step [m], shape [T × environments].
    pub progress_m: &'a mut [f64],
    /// Status codes, shape [T × environments].
    pub status: &'a mut [u8],
    /// x, z of the robot's centre [m] and its heading [rad], shape [T × environments × 3].
    pub robot_pose: &'a mut [f64],
    /// Poses of the body magnets as a [`View`] has them, shape [T × environments × magnets × 3], in space 7; or
    /// empty, where they are not wanted.
    pub magnet_pose: &'a mut [f64],
    /// Shape [T × environments × observation]; or empty.
    pub observation: &'a mut [f32],
}

/// What belongs to one block and one control step.
struct Instant<'a> {
    control: StepOutput<'a>,
    robot_pose: &'a mut [f64],
    magnet_pose: &'a mut [f64],
}

impl Plan<'_> {
    /// What dealing the rows of its output out to so many blocks takes [bytes].
    pub(super) fn bytes(&self, blocks: usize) -> usize {
        self.control_steps.saturating_mul(blocks).saturating_mul(size_of::<Instant<'_>>())
    }
}

/// See [`super::Batch::rollout`].
pub(super) fn rollout<R: Row>(
    cohorts: &mut [Cohort<R>],
    count: usize,
    pool: Option<&ThreadPool>,
    plan: Plan<'_>,
    output: RolloutOutput<'_>,
    interruption: &Interruption<'_>,
) where
    Block<R>: Steps,
{
    let instants = by_block(cohorts, count, plan.control_steps, output);
    let work = |(cohort, instants): (&mut Cohort<R>, Vec<Instant<'_>>)| {
        if cohort.block.begin(interruption) {
            // Where it was stopped, the block is put back.
            let _ = trajectory(cohort, plan, instants, interruption);
        }
    };
    interruption.run(pool, || match pool {
        None => cohorts.iter_mut().zip(instants).for_each(work),
        Some(_) => cohorts.par_iter_mut().zip(instants.into_par_iter()).for_each(work),
    });
}

/// All control steps of a block.
fn trajectory<R: Row>(
    cohort: &mut Cohort<R>,
    plan: Plan<'_>,
    instants: Vec<Instant<'_>>,
    interruption: &Interruption<'_>,
) -> Result<(), Interrupted>
where
    Block<R>: Steps,
{
    let per_step = plan.actions.len() / plan.control_steps.max(1);
    for (step, instant) in instants.into_iter().enumerate() {
        let actions = &plan.actions[per_step * step..][..per_step];
        control_block(cohort, actions, instant.control, interruption)?;
        note_poses(&cohort.model, &cohort.block, instant.robot_pose, instant.magnet_pose);
    }
    Ok(())
}

fn note_poses<R: Row>(
    model: &Model,
    block: &Block<R>,
    robot_pose: &mut [f64],
    magnet_pose: &mut [f64],
) {
    let lanes = robot_pose.len() / 3;
    for (lane, row) in robot_pose.chunks_mut(3).enumerate() {
        row.copy_from_slice(&block.robot_pose(model, Robot::AGENT, lane));
    }
    if magnet_pose.is_empty() {
        return;
    }
    for (lane, rows) in magnet_pose.chunks_mut(magnet_pose.len() / lanes).enumerate() {
        let view = View::new(model, block, lane);
        for (magnet, row) in rows.chunks_mut(rows.len() / model.magnets()).enumerate() {
            view.write_magnet_pose(magnet, row);
        }
    }
}

/// Deals the rows of an output out, `[block][control step]`.
fn by_block<'a, R: Row>(
    cohorts: &[Cohort<R>],
    count: usize,
    control_steps: usize,
    mut output: RolloutOutput<'a>,
) -> Vec<Vec<Instant<'a>>> {
    let rows = (control_steps * count).max(1);
    let (observed, posed) = (output.observation.len() / rows, output.magnet_pose.len() / rows);
    let mut dealt: Vec<Vec<_>> =
        cohorts.iter().map(|_| Vec::with_capacity(control_steps)).collect();
    for _ in 0..control_steps {
        for (cohort, instants) in cohorts.iter().zip(&mut dealt) {
            let lanes = cohort.seats.count;
            let control = StepOutput {
                observation: take(&mut output.observation, lanes * observed),
                progress_m: take(&mut output.progress_m, lanes),
                status: take(&mut output.status, lanes),
            };
            let robot_pose = take(&mut output.robot_pose, 3 * lanes);
            let magnet_pose = take(&mut output.magnet_pose, lanes * posed);
            instants.push(Instant { control, robot_pose, magnet_pose });
        }
    }
    dealt
}

/// The first numbers of what is left.
fn take<'a, T>(rest: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    rest.split_off_mut(..count).unwrap_or_default()
}
