//! A batch: many environments of one model, stepped together on all cores.

use super::block::{Block, Counters, Status};
use super::pool::Pool;
use super::view::View;
use crate::lanes::math::sin_cos;
use crate::lanes::{InstructionSet, Isa, Scalar, WIDE, WideTask, run_wide_on};
use crate::model::{Model, Phase};
use crate::observe;
use crate::reset::{Draws, StartPose, reset, scene_start};
use crate::step::{advance, command, run_phase};
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use std::sync::Arc;

/// Environments side by side in a vector, or one by one. Results are equal bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LaneChoice {
    /// Eight per block.
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
    Wide(Vec<Block<WIDE>>),
    Scalar(Vec<Block<1>>),
}

/// Runs `$body` with `$blocks` bound to the blocks of either width.
macro_rules! with_blocks {
    ($any:expr, $blocks:ident => $body:expr) => {
        match $any {
            Blocks::Wide($blocks) => $body,
            Blocks::Scalar($blocks) => $body,
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
        let blocks = match lanes {
            LaneChoice::Wide => Blocks::Wide(new_blocks(&model, count)),
            LaneChoice::Scalar => Blocks::Scalar(new_blocks(&model, count)),
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
            Blocks::Wide(_) => LaneChoice::Wide,
            Blocks::Scalar(_) => LaneChoice::Scalar,
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

    /// `steps` solver steps without new actions.
    pub fn advance(&mut self, steps: u32) {
        let model = Arc::clone(&self.model);
        let pool = self.pool.get();
        with_blocks!(&mut self.blocks, blocks => for_each(pool, blocks, |block| block.run(&model, steps)));
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

    /// Columns of the state of one environment, see [`super::snapshot`].
    pub(super) fn write_column(&self, environment: usize, out: &mut Vec<u8>) {
        with_blocks!(&self.blocks, blocks => {
            let (block, lane) = place(blocks, environment);
            super::snapshot::write_lane(block, lane, out);
        });
    }

    pub(super) fn read_column(&mut self, environment: usize, column: &[u8]) {
        let model = Arc::clone(&self.model);
        with_blocks!(&mut self.blocks, blocks => {
            let (block, lane) = place_mut(blocks, environment);
            super::snapshot::read_lane(&model, block, lane, column);
        });
    }
}

/// A block that knows how to step itself.
trait Steps: Send {
    fn run(&mut self, model: &Model, steps: u32);
}

impl Steps for Block<1> {
    fn run(&mut self, model: &Model, steps: u32) {
        advance(Scalar, model, self, steps);
    }
}

impl Steps for Block<WIDE> {
    fn run(&mut self, model: &Model, steps: u32) {
        self.advance_on(InstructionSet::widest(), model, steps);
    }
}

impl Block<WIDE> {
    /// `steps` solver steps on an instruction set of this processor; the bits are those of any other.
    pub fn advance_on(&mut self, set: InstructionSet, model: &Model, steps: u32) {
        struct Task<'a>(&'a Model, &'a mut Block<WIDE>, u32);
        impl WideTask for Task<'_> {
            type Output = ();
            #[inline(always)]
            fn run<I: Isa<WIDE>>(self, isa: I) {
                advance(isa, self.0, self.1, self.2);
            }
        }
        run_wide_on(set, Task(model, self, steps));
    }
}

impl Block<WIDE> {
    /// One phase of a solver step, to be looked at on its own; the phases of the model one after another are a step.
    pub fn run_phase_on(&mut self, set: InstructionSet, model: &Model, phase: Phase) {
        struct Task<'a>(&'a Model, &'a mut Block<WIDE>, Phase);
        impl WideTask for Task<'_> {
            type Output = ();
            #[inline(always)]
            fn run<I: Isa<WIDE>>(self, isa: I) {
                run_phase(isa, self.0, self.1, self.2);
            }
        }
        run_wide_on(set, Task(model, self, phase));
    }
}

fn new_blocks<const W: usize>(model: &Model, count: usize) -> Vec<Block<W>> {
    (0..count.div_ceil(W)).map(|_| Block::new(model)).collect()
}

fn place<const W: usize>(blocks: &[Block<W>], environment: usize) -> (&Block<W>, usize) {
    (&blocks[environment / W], environment % W)
}

fn place_mut<const W: usize>(
    blocks: &mut [Block<W>],
    environment: usize,
) -> (&mut Block<W>, usize) {
    (&mut blocks[environment / W], environment % W)
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
fn control_step<const W: usize>(
    model: &Model,
    blocks: &mut [Block<W>],
    pool: Option<&rayon::ThreadPool>,
    actions: &[f64],
    output: StepOutput<'_>,
) where
    Block<W>: Steps,
{
    let width = observe::size(model);
    let work = |first: usize, block: &mut Block<W>, rows: BlockOutput<'_>| {
        control_block(model, block, first, actions, rows);
    };
    match pool {
        None => {
            let rows = output.observation.chunks_mut(W * width);
            let rows = rows.zip(output.progress_m.chunks_mut(W)).zip(output.status.chunks_mut(W));
            for (index, (block, rows)) in blocks.iter_mut().zip(rows).enumerate() {
                work(index * W, block, BlockOutput::new(rows));
            }
        }
        Some(pool) => pool.install(|| {
            let rows = output.observation.par_chunks_mut(W * width);
            let rows =
                rows.zip(output.progress_m.par_chunks_mut(W)).zip(output.status.par_chunks_mut(W));
            blocks.par_chunks_mut(1).zip(rows).enumerate().for_each(|(index, (block, rows))| {
                work(index * W, &mut block[0], BlockOutput::new(rows));
            });
        }),
    }
}

/// How far the centre has moved towards where the head was.
fn progress_m([x, z, heading]: [f64; 3], [next_x, next_z, _]: [f64; 3]) -> f64 {
    if heading == 0.0 {
        return x - next_x;
    }
    let (sin, cos) = sin_cos(heading);
    (x - next_x) * cos - (z - next_z) * sin
}

struct BlockOutput<'a> {
    observation: &'a mut [f32],
    progress_m: &'a mut [f64],
    status: &'a mut [u8],
}

impl<'a> BlockOutput<'a> {
    fn new(
        ((observation, progress_m), status): ((&'a mut [f32], &'a mut [f64]), &'a mut [u8]),
    ) -> Self {
        Self { observation, progress_m, status }
    }
}

fn control_block<const W: usize>(
    model: &Model,
    block: &mut Block<W>,
    first: usize,
    actions: &[f64],
    rows: BlockOutput<'_>,
) where
    Block<W>: Steps,
{
    let count = rows.status.len();
    if let Some(drive) = model.program.drive.as_ref().filter(|d| d.is_controlled()) {
        let size = observe::action_size(model);
        for lane in 0..count {
            if block.status[lane] == Status::Running {
                let action = &actions[size * (first + lane)..][..size];
                command(model, drive, block, lane, action);
            }
        }
    }
    let before: [[f64; 3]; W] = std::array::from_fn(|lane| block.robot_pose(model, lane));
    block.run(model, model.steps_per_control);
    let width = observe::size(model);
    for lane in 0..count {
        rows.progress_m[lane] = progress_m(before[lane], block.robot_pose(model, lane));
        rows.status[lane] = block.status[lane] as u8;
        observe::write(model, block, lane, &mut rows.observation[lane * width..][..width]);
    }
}
