//! Making a batch: of scenes, or of copies of the environments of another one; and what memory it takes.

use super::blocks::new_blocks;
use super::cohort::{Seats, place};
use super::{Batch, Blocks, Ensemble, LaneChoice, Pool, with_blocks};
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::{WIDE, WIDE_SINGLE};
use crate::model::Model;
use crate::scene::Precision;
use std::sync::Arc;

impl LaneChoice {
    /// Environments of a block.
    fn number(self, model: &Model) -> usize {
        match (self, model.scene.solver.precision) {
            (Self::Wide, Precision::Double) => WIDE,
            (Self::Wide, Precision::Single) => WIDE_SINGLE,
            (Self::Scalar, _) => 1,
        }
    }
}

impl Batch {
    /// `count` environments at rest in the start pose of their scene, see [`Ensemble::environments`]; each waits for its first
    /// [`reset`](Self::reset). `threads`: none for one per core.
    pub fn new(
        scenes: impl Into<Ensemble>,
        count: usize,
        lanes: LaneChoice,
        threads: Option<usize>,
    ) -> Self {
        let pool = Pool::new(threads);
        let made = Self::new_unless(&Interruption::never(), scenes, count, lanes, pool);
        made.expect("nothing stops it")
    }

    /// See [`new`](Self::new).
    ///
    /// # Errors
    /// The call was stopped.
    pub fn new_unless(
        on: &Interruption<'_>,
        scenes: impl Into<Ensemble>,
        count: usize,
        lanes: LaneChoice,
        pool: Pool,
    ) -> Result<Self, Interrupted> {
        let ensemble = scenes.into();
        let seats = Seats::of(ensemble.scenes(count), lanes.number(ensemble.first()));
        Self::with_seats(on, ensemble, &seats, lanes, pool)
    }

    /// The same, given the scene of each environment by its place in the ensemble.
    ///
    /// # Errors
    /// The call was stopped.
    pub fn assigned_unless(
        on: &Interruption<'_>,
        ensemble: Ensemble,
        scenes: &[usize],
        lanes: LaneChoice,
        pool: Pool,
    ) -> Result<Self, Interrupted> {
        let seats = Seats::of(scenes.iter().copied(), lanes.number(ensemble.first()));
        Self::with_seats(on, ensemble, &seats, lanes, pool)
    }

    /// The same, given who has which scene and stands in which block.
    fn with_seats(
        on: &Interruption<'_>,
        ensemble: Ensemble,
        seats: &[Seats],
        lanes: LaneChoice,
        pool: Pool,
    ) -> Result<Self, Interrupted> {
        let precision = ensemble.first().scene.solver.precision;
        let blocks = match (lanes, precision) {
            (LaneChoice::Wide, Precision::Double) => {
                Blocks::Wide(new_blocks(&ensemble, seats, &pool, on)?)
            }
            (LaneChoice::Scalar, Precision::Double) => {
                Blocks::Scalar(new_blocks(&ensemble, seats, &pool, on)?)
            }
            (LaneChoice::Wide, Precision::Single) => {
                Blocks::WideSingle(new_blocks(&ensemble, seats, &pool, on)?)
            }
            (LaneChoice::Scalar, Precision::Single) => {
                Blocks::ScalarSingle(new_blocks(&ensemble, seats, &pool, on)?)
            }
        };
        let count = seats.iter().map(|seats| seats.count).sum();
        let of = |seats: &Seats| ensemble.models()[seats.scene].present().repeat(seats.count);
        let present = seats.iter().flat_map(of).collect();
        let factors = vec![1.0; count * Model::PARAMETERS.len()];
        Ok(Self { ensemble, count, blocks, pool, factors, present })
    }

    /// What so many environments take in memory [bytes].
    pub fn bytes(ensemble: &Ensemble, count: usize, lanes: LaneChoice) -> usize {
        let of_scene = |(scene, model): (usize, &Arc<Model>)| {
            let one = Self::new(Arc::clone(model), 1, lanes, Some(1));
            let environments = ensemble.environments(scene, count).len();
            let blocks = environments.div_ceil(lanes.number(model));
            let settings = environments.saturating_mul(one.settings_bytes());
            blocks.saturating_mul(one.block_bytes(0)).saturating_add(settings)
        };
        let scenes = ensemble.models().iter().enumerate();
        scenes.map(of_scene).fold(0, usize::saturating_add)
    }

    /// What the block takes in which an environment stands [bytes].
    fn block_bytes(&self, environment: usize) -> usize {
        with_blocks!(&self.blocks, blocks => place(blocks, environment).0.block.bytes())
    }

    /// What the settings of an environment for its next reset take [bytes].
    fn settings_bytes(&self) -> usize {
        size_of::<f64>() * Model::PARAMETERS.len() + self.model().magnets()
    }

    /// A batch of its own, as this one in lanes and threads, whose environment k is a copy of `environments[k]`: its
    /// state and its settings for the next reset, bit for bit.
    pub fn copies(&self, environments: &[usize]) -> Self {
        let copied = self.copies_unless(&Interruption::never(), environments);
        copied.expect("nothing stops it")
    }

    /// See [`copies`](Self::copies).
    ///
    /// # Errors
    /// The call was stopped.
    pub fn copies_unless(
        &self,
        interruption: &Interruption<'_>,
        environments: &[usize],
    ) -> Result<Self, Interrupted> {
        let (ensemble, seats) = (self.ensemble().clone(), self.seats_of(environments));
        let (lanes, pool) = (self.lanes(), Pool::new(Some(self.threads())));
        let mut batch = Self::with_seats(interruption, ensemble, &seats, lanes, pool)?;
        batch.read_columns(interruption, |copy, state| {
            self.write_column(environments[copy], state);
        })?;
        let mut column = Vec::new();
        for (copy, &environment) in environments.iter().enumerate() {
            column.clear();
            self.write_column(environment, &mut column);
            batch.read_settings(copy, &column);
        }
        Ok(batch)
    }

    /// What such copies take in memory [bytes].
    pub fn copies_bytes(&self, environments: &[usize]) -> usize {
        let seats = self.seats_of(environments);
        let blocks = seats.iter().map(|seats| self.block_bytes(environments[seats.first]));
        let settings = environments.len().saturating_mul(self.settings_bytes());
        blocks.fold(settings, usize::saturating_add)
    }

    fn seats_of(&self, environments: &[usize]) -> Vec<Seats> {
        let scenes = environments.iter().map(|&environment| self.scene_of(environment));
        Seats::of(scenes, self.lanes().number(self.model()))
    }
}
