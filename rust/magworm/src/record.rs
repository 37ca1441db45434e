//! Recordings: many scenes, each run once from its start pose, watched at even intervals.
//!
//! For fits, sweeps and figures, where the scenes differ in what a batch shares (sizes, motion, mesh).
//! Scenes run side by side on all cores, one environment each.

use crate::batch::{Pool, View, advance_block};
use crate::draws::Draws;
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::Row;
use crate::model::Model;
use crate::reset::{reset, scene_start};
use crate::scene::Precision;
use crate::state::{Block, Status};
use crate::step::Steps;
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
///
/// # Errors
/// The call was stopped.
pub fn record(
    models: &[(Arc<Model>, Watch)],
    threads: Option<usize>,
    interruption: &Interruption<'_>,
) -> Result<Vec<Recording>, Interrupted> {
    let mut recordings: Vec<Option<Recording>> = models.iter().map(|_| None).collect();
    Pool::new(threads).each(interruption, &mut recordings, 1, |k, recording| {
        let (model, watch) = &models[k];
        recording[0] = record_one(model, *watch, interruption).ok();
    });
    interruption.last_asked()?;
    Ok(recordings.into_iter().flatten().collect())
}

fn record_one(
    model: &Model,
    watch: Watch,
    interruption: &Interruption<'_>,
) -> Result<Recording, Interrupted> {
    match model.scene.solver.precision {
        Precision::Double => record_with::<[f64; 1]>(model, watch, interruption),
        Precision::Single => record_with::<[f32; 1]>(model, watch, interruption),
    }
}

fn record_with<R: Row>(
    model: &Model,
    watch: Watch,
    interruption: &Interruption<'_>,
) -> Result<Recording, Interrupted>
where
    Block<R>: Steps,
{
    let mut block = Block::<R>::new(model);
    let present = model.present();
    let factors = [1.0; Model::PARAMETERS.len()];
    reset(model, &mut block, 0, scene_start(model), &factors, &present, Draws::new(0, 0));
    let (mut recording, sizes) =
        (Recording::with_room(model, watch), Recording::sizes(model, watch));
    recording.note(&View::new(model, &block, 0), sizes);
    for _ in 0..watch.intervals {
        advance_block(model, &mut block, watch.steps, interruption)?;
        recording.note(&View::new(model, &block, 0), sizes);
    }
    recording.status = block.status[0];
    Ok(recording)
}

impl Recording {
    /// What it takes in memory [bytes].
    pub fn bytes(model: &Model, watch: Watch) -> usize {
        let instants = watch.intervals as usize + 1;
        let numbers = |[things, width]: [usize; 2]| things * width * instants;
        8 * Self::sizes(model, watch).map(numbers).iter().sum::<usize>()
    }

    /// Body magnets, drive magnets and nodes, each with the numbers of one at an instant.
    fn sizes(model: &Model, watch: Watch) -> [[usize; 2]; 3] {
        let sizes = model.sizes();
        let nodes = if watch.nodes { model.nodes() } else { 0 };
        [
            [model.magnets(), sizes.pose()],
            [model.program.drive_magnets(), sizes.stage],
            [nodes, sizes.axes],
        ]
    }

    fn with_room(model: &Model, watch: Watch) -> Self {
        let instants = watch.intervals as usize + 1;
        let room = |[things, width]: [usize; 2]| Vec::with_capacity(things * width * instants);
        let [magnet_poses, drive, node_m] = Self::sizes(model, watch).map(room);
        Self { magnet_poses, drive, node_m, status: Status::Running }
    }

    fn note(&mut self, view: &View<'_>, sizes: [[usize; 2]; 3]) {
        let [magnets, drives, nodes] = sizes;
        append(&mut self.magnet_poses, magnets, |k, row| view.write_magnet_pose(k, row));
        append(&mut self.drive, drives, |k, row| view.write_drive_place(k, row));
        append(&mut self.node_m, nodes, |k, row| view.write_node(k, row));
    }
}

/// Appends a row for each of so many things.
fn append(table: &mut Vec<f64>, [things, width]: [usize; 2], write: impl Fn(usize, &mut [f64])) {
    for thing in 0..things {
        let start = table.len();
        table.resize(start + width, 0.0);
        write(thing, &mut table[start..]);
    }
}
