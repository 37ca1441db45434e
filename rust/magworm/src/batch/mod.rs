//! A batch: many environments of one scene or several, stepped together on all cores.

mod blocks;
mod check;
mod cohort;
mod column;
mod construction;
mod control;
mod ensemble;
mod episode;
mod pool;
mod rollout;
mod snapshot;
mod view;
mod wrenches;

pub use check::SnapshotError;
pub(crate) use control::advance_block;
pub use ensemble::Ensemble;
pub use episode::Start;
pub use pool::Pool;
pub use rollout::{Plan, RolloutOutput};
pub use view::View;

use crate::interruption::{Interrupted, Interruption};
use crate::lanes::{InstructionSet, WIDE, WIDE_SINGLE};
use crate::model::Model;
use crate::observe;
use crate::reset::StartPose;
use crate::state::{Counters, Status};
use blocks::{control_step, each_block, settle};
use cohort::{Cohort, Seats, place, place_mut};
use episode::Settings;
use rollout::rollout;
use std::sync::Arc;

/// Environments side by side in a vector, or one by one. Results are equal bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LaneChoice {
    /// Eight per block, sixteen in single precision.
    #[default]
    Wide,
    /// One per block.
    Scalar,
}

/// Many environments of one scene, or of several of one shape, which change nothing in each other.
#[derive(Debug)]
pub struct Batch {
    ensemble: Ensemble,
    count: usize,
    blocks: Blocks,
    pool: Pool,
    factors: Vec<f64>,
    present: Vec<bool>,
}

#[derive(Debug)]
enum Blocks {
    Wide(Vec<Cohort<[f64; WIDE]>>),
    Scalar(Vec<Cohort<[f64; 1]>>),
    WideSingle(Vec<Cohort<[f32; WIDE_SINGLE]>>),
    ScalarSingle(Vec<Cohort<[f32; 1]>>),
}

/// Runs `$body` with `$blocks` bound to the blocks of any width and precision.
macro_rules! with_blocks {
    ($any:expr, $blocks:ident => $body:expr) => {
        match $any {
            Blocks::Wide($blocks) => $body,
            Blocks::Scalar($blocks) => $body,
            Blocks::WideSingle($blocks) => $body,
            Blocks::ScalarSingle($blocks) => $body,
        }
    };
}

use with_blocks;

/// Entries of a table that one thread writes sooner than many threads are woken.
const FEW: usize = 1 << 14;

/// Where a step writes what it saw, one row per environment.
pub struct StepOutput<'a> {
    /// Shape [environments × observation].
    pub observation: &'a mut [f32],
    /// Progress towards the head in this control step [m], shape [environments].
    pub progress_m: &'a mut [f64],
    /// Status codes, shape [environments].
    pub status: &'a mut [u8],
}

impl<'a> StepOutput<'a> {
    /// The rows of so many environments, and those of the others.
    fn split_at(self, environments: usize) -> (Self, Self) {
        let width = self.observation.len() / self.status.len().max(1);
        let (observation, other_observation) = self.observation.split_at_mut(width * environments);
        let (progress_m, other_progress_m) = self.progress_m.split_at_mut(environments);
        let (status, other_status) = self.status.split_at_mut(environments);
        (
            Self { observation, progress_m, status },
            Self {
                observation: other_observation,
                progress_m: other_progress_m,
                status: other_status,
            },
        )
    }
}

impl Batch {
    /// The scene that all environments have, or the first of several: one of their shape.
    pub fn model(&self) -> &Arc<Model> {
        self.ensemble.first()
    }

    /// The scenes.
    pub fn ensemble(&self) -> &Ensemble {
        &self.ensemble
    }

    /// The scene of an environment: its place in the [`ensemble`](Self::ensemble).
    pub fn scene_of(&self, environment: usize) -> usize {
        with_blocks!(&self.blocks, blocks => place(blocks, environment).0.seats.scene)
    }

    /// The compiled scene of an environment.
    pub fn model_of(&self, environment: usize) -> &Arc<Model> {
        &self.ensemble.models()[self.scene_of(environment)]
    }

    /// Number of environments.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How environments are laid out.
    pub fn lanes(&self) -> LaneChoice {
        match self.blocks {
            Blocks::Wide(_) | Blocks::WideSingle(_) => LaneChoice::Wide,
            Blocks::Scalar(_) | Blocks::ScalarSingle(_) => LaneChoice::Scalar,
        }
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.pool.threads()
    }

    /// Steps on a narrower instruction set from now on. Tests show by it that bits do not depend on the set.
    #[doc(hidden)]
    pub fn use_instruction_set(&mut self, set: InstructionSet) {
        with_blocks!(&mut self.blocks, blocks => {
            blocks.iter_mut().for_each(|cohort| cohort.block.set = set);
        });
    }

    /// Factors of the scene's parameters for the next reset, shape [environments × parameters].
    pub fn factors_mut(&mut self) -> &mut [f64] {
        &mut self.factors
    }

    /// See [`factors_mut`](Self::factors_mut).
    pub fn factors(&self) -> &[f64] {
        &self.factors
    }

    /// Which magnets are in from the next reset on, shape [environments × magnets].
    pub fn present_mut(&mut self) -> &mut [bool] {
        &mut self.present
    }

    /// See [`present_mut`](Self::present_mut).
    pub fn present(&self) -> &[bool] {
        &self.present
    }

    /// Starts an episode in one environment. `start`: none for the scene's.
    pub fn reset(&mut self, environment: usize, seed: u64, episode: u64, start: Option<StartPose>) {
        let Self { factors, present, .. } = self;
        let settings = Settings { factors, present };
        with_blocks!(&mut self.blocks, blocks => {
            let (cohort, lane) = place_mut(blocks, environment);
            settings.start(cohort, lane, Start { seed, episode, pose: start });
        });
    }

    /// Starts episodes: one entry per environment, none for those that go on as they are.
    ///
    /// # Errors
    /// The call was stopped; all environments are as before.
    pub fn reset_unless(
        &mut self,
        interruption: &Interruption<'_>,
        starts: &[Option<Start>],
    ) -> Result<(), Interrupted> {
        let Self { factors, present, pool, .. } = self;
        let settings = Settings { factors, present };
        with_blocks!(&mut self.blocks, blocks => {
            each_block(pool, interruption, blocks, |cohort| {
                let Seats { first, count, .. } = cohort.seats;
                for (lane, start) in starts[first..][..count].iter().enumerate() {
                    if let Some(start) = *start {
                        settings.start(cohort, lane, start);
                    }
                }
            })
        })
    }

    /// One control step. `actions` in [−1, 1], shape [environments × action]; empty where the drive is not
    /// controlled. Everything in `actions` must be finite.
    pub fn step(&mut self, actions: &[f64], output: StepOutput<'_>) {
        // Nothing stops it.
        let _ = self.step_unless(&Interruption::never(), actions, output);
    }

    /// See [`step`](Self::step).
    ///
    /// # Errors
    /// The call was stopped; all environments are as before.
    pub fn step_unless(
        &mut self,
        interruption: &Interruption<'_>,
        actions: &[f64],
        output: StepOutput<'_>,
    ) -> Result<(), Interrupted> {
        let pool = self.pool.get();
        with_blocks!(&mut self.blocks, blocks => {
            control_step(blocks, pool.as_deref(), actions, output, interruption);
            settle(blocks, interruption)
        })
    }

    /// The control steps of a plan, one after the other, in one call: bit for bit what as many calls of
    /// [`step`](Self::step) give.
    ///
    /// # Errors
    /// The call was stopped; all environments are as before.
    pub fn rollout(
        &mut self,
        plan: Plan<'_>,
        output: RolloutOutput<'_>,
        interruption: &Interruption<'_>,
    ) -> Result<(), Interrupted> {
        let (count, pool) = (self.count, self.pool.get());
        with_blocks!(&mut self.blocks, blocks => {
            rollout(blocks, count, pool.as_deref(), plan, output, interruption);
            settle(blocks, interruption)
        })
    }

    /// What the bookkeeping of a plan takes beside its actions and output [bytes].
    pub fn plan_bytes(&self, plan: &Plan<'_>) -> usize {
        with_blocks!(&self.blocks, blocks => plan.bytes(blocks.len()))
    }

    /// `steps` solver steps without new actions.
    pub fn advance(&mut self, steps: u32) {
        // Nothing stops it.
        let _ = self.advance_unless(&Interruption::never(), steps);
    }

    /// See [`advance`](Self::advance).
    ///
    /// # Errors
    /// The call was stopped; all environments are as before.
    pub fn advance_unless(
        &mut self,
        interruption: &Interruption<'_>,
        steps: u32,
    ) -> Result<(), Interrupted> {
        with_blocks!(&mut self.blocks, blocks => {
            each_block(&self.pool, interruption, blocks, |Cohort { model, block, .. }| {
                // Where it was stopped, the block is put back.
                let _ = advance_block(model, block, steps, interruption);
            })
        })
    }

    /// Writes the observations, shape [environments × observation].
    pub fn observe(&self, observation: &mut [f32]) {
        let width = observe::size(self.model());
        for (environment, row) in observation.chunks_mut(width).enumerate() {
            self.view(environment, |view| view.observe(row));
        }
    }

    /// Status of each environment.
    pub fn status(&self, environment: usize) -> Status {
        self.view(environment, |view| view.status())
    }

    /// Looks at one environment.
    pub fn view<R>(&self, environment: usize, look: impl FnOnce(View<'_>) -> R) -> R {
        with_blocks!(&self.blocks, blocks => {
            let (cohort, lane) = place(blocks, environment);
            look(View::new(&cohort.model, &cohort.block, lane))
        })
    }

    /// Work done by all blocks.
    pub fn counters(&self) -> Counters {
        with_blocks!(&self.blocks, blocks => {
            blocks.iter().fold(Counters::default(), |sum, cohort| sum.plus(cohort.block.counters))
        })
    }

    /// Writes a row of equal length for each environment, as `look` finds it.
    ///
    /// # Errors
    /// The call was stopped; some rows have been written.
    pub fn look_unless<T: Send>(
        &self,
        interruption: &Interruption<'_>,
        table: &mut [T],
        look: impl Fn(&View<'_>, &mut [T]) + Sync,
    ) -> Result<(), Interrupted> {
        let alone = Pool::new(Some(1));
        let pool = if table.len() < FEW { &alone } else { &self.pool };
        pool.fill(interruption, table, table.len() / self.count.max(1), |environment, row| {
            self.view(environment, |view| look(&view, row));
        })
    }

    /// Hands the state of one environment on, see `snapshot.rs`.
    fn write_state(&self, environment: usize, add: &mut dyn FnMut(u64)) {
        with_blocks!(&self.blocks, blocks => {
            let (cohort, lane) = place(blocks, environment);
            snapshot::write_lane(&cohort.block, lane, add);
        });
    }

    /// Reads the state of every environment, which `write` appends to an empty list of bytes.
    ///
    /// # Errors
    /// The call was stopped; all environments are as before.
    fn read_columns(
        &mut self,
        interruption: &Interruption<'_>,
        write: impl Fn(usize, &mut Vec<u8>) + Sync,
    ) -> Result<(), Interrupted> {
        with_blocks!(&mut self.blocks, blocks => {
            each_block(&self.pool, interruption, blocks, |Cohort { seats, model, block }| {
                let mut column = Vec::new();
                for lane in 0..seats.count {
                    column.clear();
                    write(seats.first + lane, &mut column);
                    snapshot::read_lane(model, block, lane, &column);
                }
            })
        })
    }

    fn pool(&self) -> &Pool {
        &self.pool
    }
}
