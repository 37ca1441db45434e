//! A batch: many environments of one model, stepped together on all cores.

mod control;
mod pool;
mod rollout;
mod snapshot;
mod view;

pub(crate) use pool::Pool;
pub use rollout::{Plan, RolloutOutput};
pub use snapshot::SnapshotError;
pub use view::View;

use crate::lanes::{InstructionSet, Row, WIDE, WIDE_SINGLE};
use crate::model::Model;
use crate::observe;
use crate::reset::{Draws, StartPose, reset, scene_start};
use crate::scene::Precision;
use crate::state::{Block, Counters, Status};
use crate::step::Steps;
use control::{ControlRows, control_block};
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
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

/// Many environments of one model.
#[derive(Debug)]
pub struct Batch {
    model: Arc<Model>,
    count: usize,
    blocks: Blocks,
    pool: Pool,
    factors: Vec<f64>,
    present: Vec<bool>,
}

#[derive(Debug)]
enum Blocks {
    Wide(Vec<Block<[f64; WIDE]>>),
    Scalar(Vec<Block<[f64; 1]>>),
    WideSingle(Vec<Block<[f32; WIDE_SINGLE]>>),
    ScalarSingle(Vec<Block<[f32; 1]>>),
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

/// Where a step writes what it saw, one row per environment.
pub struct StepOutput<'a> {
    /// Shape [environments × observation].
    pub observation: &'a mut [f32],
    /// Progress towards the head in this control step [m], shape [environments].
    pub progress_m: &'a mut [f64],
    /// Status codes, shape [environments].
    pub status: &'a mut [u8],
}

impl Batch {
    /// `count` environments at rest in the scene's start pose; each waits for its first
    /// [`reset`](Self::reset). `threads`: none for one per core.
    pub fn new(model: Arc<Model>, count: usize, lanes: LaneChoice, threads: Option<usize>) -> Self {
        let blocks = match (lanes, model.scene.solver.precision) {
            (LaneChoice::Wide, Precision::Double) => Blocks::Wide(new_blocks(&model, count)),
            (LaneChoice::Scalar, Precision::Double) => Blocks::Scalar(new_blocks(&model, count)),
            (LaneChoice::Wide, Precision::Single) => Blocks::WideSingle(new_blocks(&model, count)),
            (LaneChoice::Scalar, Precision::Single) => {
                Blocks::ScalarSingle(new_blocks(&model, count))
            }
        };
        let present: Vec<bool> = model.mesh.magnets.iter().map(|m| m.present).collect();
        Self {
            factors: vec![1.0; count * Model::PARAMETERS.len()],
            present: present.repeat(count),
            pool: Pool::new(threads),
            model,
            count,
            blocks,
        }
    }

    /// The model.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
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
        let model = &*self.model;
        let start = start.unwrap_or_else(|| scene_start(model));
        let parameters = Model::PARAMETERS.len();
        let factors = &self.factors[environment * parameters..][..parameters];
        let present = &self.present[environment * model.magnets()..][..model.magnets()];
        let draws = Draws::new(seed, episode);
        with_blocks!(&mut self.blocks, blocks => {
            let (block, lane) = place_mut(blocks, environment);
            reset(model, block, lane, start, factors, present, draws);
        });
    }

    /// One control step. `actions` in [−1, 1], shape [environments × action]; empty where the drive is not
    /// controlled. Everything in `actions` must be finite.
    pub fn step(&mut self, actions: &[f64], output: StepOutput<'_>) {
        let model = Arc::clone(&self.model);
        let pool = self.pool.get();
        with_blocks!(&mut self.blocks, blocks => control_step(&model, blocks, pool, actions, output));
    }

    /// The control steps of a plan, one after the other, in one call: bit for bit what as many calls of
    /// [`step`](Self::step) give. `interrupted` is asked every few hundredths of a second whether to stop.
    ///
    /// Returns whether the plan was run to its end. Where it was not, some environments have gone further than
    /// others.
    pub fn rollout(
        &mut self,
        plan: Plan<'_>,
        output: RolloutOutput<'_>,
        interrupted: &mut dyn FnMut() -> bool,
    ) -> bool {
        let model = Arc::clone(&self.model);
        let (count, pool) = (self.count, self.pool.get());
        with_blocks!(&mut self.blocks, blocks => {
            rollout(&model, blocks, count, pool, plan, output, interrupted)
        })
    }

    /// `steps` solver steps without new actions.
    pub fn advance(&mut self, steps: u32) {
        let model = Arc::clone(&self.model);
        let pool = self.pool.get();
        with_blocks!(&mut self.blocks, blocks => for_each(pool, blocks, |block| {
            block.advance_on(InstructionSet::widest(), &model, steps);
        }));
    }

    /// Writes the observations, shape [environments × observation].
    pub fn observe(&self, observation: &mut [f32]) {
        let width = observe::size(&self.model);
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
            let (block, lane) = place(blocks, environment);
            look(View::new(&self.model, block, lane))
        })
    }

    /// Work done by all blocks.
    pub fn counters(&self) -> Counters {
        with_blocks!(&self.blocks, blocks => {
            blocks.iter().fold(Counters::default(), |sum, block| sum.plus(block.counters))
        })
    }

    /// Columns of the state of one environment, see `snapshot.rs`.
    fn write_column(&self, environment: usize, out: &mut Vec<u8>) {
        with_blocks!(&self.blocks, blocks => {
            let (block, lane) = place(blocks, environment);
            snapshot::write_lane(block, lane, out);
        });
    }

    fn read_column(&mut self, environment: usize, column: &[u8]) {
        let model = Arc::clone(&self.model);
        with_blocks!(&mut self.blocks, blocks => {
            let (block, lane) = place_mut(blocks, environment);
            snapshot::read_lane(&model, block, lane, column);
        });
    }
}

fn new_blocks<R: Row>(model: &Model, count: usize) -> Vec<Block<R>> {
    (0..count.div_ceil(R::LANES)).map(|_| Block::new(model)).collect()
}

fn place<R: Row>(blocks: &[Block<R>], environment: usize) -> (&Block<R>, usize) {
    (&blocks[environment / R::LANES], environment % R::LANES)
}

fn place_mut<R: Row>(blocks: &mut [Block<R>], environment: usize) -> (&mut Block<R>, usize) {
    (&mut blocks[environment / R::LANES], environment % R::LANES)
}

fn for_each<B: Send>(
    pool: Option<&rayon::ThreadPool>,
    blocks: &mut [B],
    work: impl Fn(&mut B) + Sync,
) {
    match pool {
        None => blocks.iter_mut().for_each(work),
        Some(pool) => pool.install(|| blocks.par_chunks_mut(1).for_each(|one| work(&mut one[0]))),
    }
}

/// Blocks with the rows of the output that belong to each.
fn control_step<R: Row>(
    model: &Model,
    blocks: &mut [Block<R>],
    pool: Option<&rayon::ThreadPool>,
    actions: &[f64],
    output: StepOutput<'_>,
) where
    Block<R>: Steps,
{
    let width = observe::size(model);
    let work = |first: usize, block: &mut Block<R>, rows: ControlRows<'_>| {
        control_block(model, block, first, actions, rows);
    };
    match pool {
        None => {
            let rows = output.observation.chunks_mut(R::LANES * width);
            let rows = rows
                .zip(output.progress_m.chunks_mut(R::LANES))
                .zip(output.status.chunks_mut(R::LANES));
            for (index, (block, rows)) in blocks.iter_mut().zip(rows).enumerate() {
                work(index * R::LANES, block, ControlRows::new(rows));
            }
        }
        Some(pool) => pool.install(|| {
            let rows = output.observation.par_chunks_mut(R::LANES * width);
            let rows = rows
                .zip(output.progress_m.par_chunks_mut(R::LANES))
                .zip(output.status.par_chunks_mut(R::LANES));
            blocks.par_chunks_mut(1).zip(rows).enumerate().for_each(|(index, (block, rows))| {
                work(index * R::LANES, &mut block[0], ControlRows::new(rows));
            });
        }),
    }
}
