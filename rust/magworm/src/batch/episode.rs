//! The start of an episode in an environment of a batch.

use super::cohort::Cohort;
use crate::draws::Draws;
use crate::lanes::Row;
use crate::model::Model;
use crate::reset::{StartPose, reset, scene_start};

/// What an environment starts an episode with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Seed of the environment; what is drawn depends on it and the episode alone.
    pub seed: u64,
    /// Number of the episode.
    pub episode: u64,
    /// Pose of the body; none for the scene's.
    pub pose: Option<StartPose>,
}

/// What a reset of any environment needs to know.
pub(super) struct Settings<'a> {
    pub factors: &'a [f64],
    pub present: &'a [bool],
}

impl Settings<'_> {
    pub fn start<R: Row>(&self, cohort: &mut Cohort<R>, lane: usize, start: Start) {
        let Cohort { seats, model, block } = cohort;
        let (environment, magnets) = (seats.first + lane, model.magnets());
        let parameters = Model::PARAMETERS.len();
        let factors = &self.factors[environment * parameters..][..parameters];
        let present = &self.present[environment * magnets..][..magnets];
        let pose = start.pose.unwrap_or_else(|| scene_start(model));
        let draws = Draws::new(start.seed, start.episode);
        reset(model, block, lane, pose, factors, present, draws);
    }
}
