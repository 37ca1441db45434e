//! Recordings: many scenes, each run once from its start pose, watched at even intervals.
//!
//! For fits, sweeps and figures, where the scenes differ in what a batch shares (sizes, motion, mesh).
//! Scenes run side by side on all cores, one environment each.

use crate::batch::{Batch, LaneChoice, Pool, View};
use crate::model::Model;
use crate::state::Status;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::sync::Arc;

/// One environment over time: S + 1 instants, M body magnets, D drive magnets, K nodes. Numbers of a pose or
/// place are those of a [`View`]'s rows.
#[derive(Clone, Debug)]
pub struct Recording {
    /// Poses of the body magnets, shape [S + 1 × M × 3], in space [S + 1 × M × 7].
    pub magnet_poses: Vec<f64>,
    /// Places of the drive magnets, shape [S + 1 × D × 2], in space [S + 1 × D × 4].
    pub drive: Vec<f64>,
    /// Node positions [m], shape [S + 1 × K × 2], in space [S + 1 × K × 3]; empty where they were not asked for.
    pub node_m: Vec<f64>,
    /// Status at the end. A broken environment stands still in the instants after it broke.
    pub status: Status,
}

/// How long to watch, and what.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    /// Number S of intervals.
    pub intervals: u32,
    /// Solver steps of an interval.
    pub steps: u32,
    /// Whether nodes are kept.
    pub nodes: bool,
}

/// Records scenes side by side on `threads` threads (none: one per core), in their order. A controlled
/// drive stands still.
pub fn record(models: &[(Arc<Model>, Watch)], threads: Option<usize>) -> Vec<Recording> {
    let run = |(model, watch): &(Arc<Model>, Watch)| record_one(model, *watch);
    match Pool::new(threads).get() {
        None => models.iter().map(run).collect(),
        Some(pool) => pool.install(|| models.par_iter().map(run).collect()),
    }
}

fn record_one(model: &Arc<Model>, watch: Watch) -> Recording {
    let mut batch = Batch::new(model.clone(), 1, LaneChoice::Scalar, Some(1));
    batch.reset(0, 0, 0, None);
    let mut recording =
        Recording { magnet_poses: vec![], drive: vec![], node_m: vec![], status: Status::Running };
    batch.view(0, |view| recording.note(model, &view, watch.nodes));
    for _ in 0..watch.intervals {
        batch.advance(watch.steps);
        batch.view(0, |view| recording.note(model, &view, watch.nodes));
    }
    recording.status = batch.status(0);
    recording
}

impl Recording {
    fn note(&mut self, model: &Model, view: &View<'_>, nodes: bool) {
        self.magnet_poses.extend((0..model.magnets()).flat_map(|j| view.magnet_pose(j)));
        let drives = 0..model.program.drive_magnets();
        self.drive.extend(drives.filter_map(|k| view.drive_place(k)).flatten());
        if nodes {
            self.node_m.extend((0..model.nodes()).flat_map(|n| view.node_m(n)));
        }
    }
}
