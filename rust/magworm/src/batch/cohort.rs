//! The environments of one block.

use crate::lanes::Row;
use crate::model::Model;
use crate::state::Block;
use std::sync::Arc;

/// Consecutive environments of one scene: as many as a block has lanes, or fewer where the scene changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Seats {
    /// Which scene of the ensemble.
    pub scene: usize,
    /// The first environment.
    pub first: usize,
    /// How many there are.
    pub count: usize,
}

impl Seats {
    /// Those of blocks with so many lanes, given the scene of each environment.
    pub(super) fn of(scenes: impl Iterator<Item = usize>, lanes: usize) -> Vec<Self> {
        let mut seats: Vec<Self> = Vec::new();
        for (environment, scene) in scenes.enumerate() {
            match seats.last_mut() {
                Some(last) if last.scene == scene && last.count < lanes => last.count += 1,
                _ => seats.push(Self { scene, first: environment, count: 1 }),
            }
        }
        seats
    }
}

/// Environments, the scene that they have and the block that they stand in. Lanes beyond their number are unused.
#[derive(Debug)]
pub(super) struct Cohort<R: Row> {
    pub seats: Seats,
    pub model: Arc<Model>,
    pub block: Block<R>,
}

/// The cohort of an environment, and its lane there.
pub(super) fn place<R: Row>(cohorts: &[Cohort<R>], environment: usize) -> (&Cohort<R>, usize) {
    let cohort = &cohorts[index(cohorts, environment)];
    (cohort, environment - cohort.seats.first)
}

/// The same, to change it.
pub(super) fn place_mut<R: Row>(
    cohorts: &mut [Cohort<R>],
    environment: usize,
) -> (&mut Cohort<R>, usize) {
    let index = index(cohorts, environment);
    let cohort = &mut cohorts[index];
    let lane = environment - cohort.seats.first;
    (cohort, lane)
}

fn index<R: Row>(cohorts: &[Cohort<R>], environment: usize) -> usize {
    cohorts.partition_point(|cohort| cohort.seats.first + cohort.seats.count <= environment)
}
