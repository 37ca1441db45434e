//! Batches of unequal robots under random actions, and everything public about them as bits.
//!
//! A robot's parameters, magnets, start, actions and mishaps follow from its number alone, never from
//! its place in a batch. So two batches that share a robot must show the same bits for it.

mod record;

pub use record::Record;

use magworm::internals::Draws;
use magworm::{Batch, Ensemble, LaneChoice, Model, StartPose, StepOutput};
use std::sync::Arc;

/// Control step in which some robots fare ill.
pub const MISHAP: u64 = 20;
/// Control step in which some robots start afresh.
const FRESH_START: u64 = 30;

/// A batch with its output buffers.
pub struct World {
    /// The batch.
    pub batch: Batch,
    robots: Vec<u64>,
    control_steps: u64,
    observation: Vec<f32>,
    progress_m: Vec<f64>,
    status: Vec<u8>,
}

impl World {
    /// The robots of these numbers, side by side, each at its start.
    pub fn new(model: &Arc<Model>, robots: &[u64], lanes: LaneChoice, threads: usize) -> Self {
        Self::of(Arc::clone(model), robots, lanes, threads)
    }

    /// The same, of several scenes.
    pub fn of(
        scenes: impl Into<Ensemble>,
        robots: &[u64],
        lanes: LaneChoice,
        threads: usize,
    ) -> Self {
        let count = robots.len();
        let batch = Batch::new(scenes, count, lanes, Some(threads));
        let mut world = Self {
            robots: robots.to_vec(),
            control_steps: 0,
            observation: vec![0.0; count * magworm::observe::size(batch.model())],
            progress_m: vec![0.0; count],
            status: vec![0; count],
            batch,
        };
        (0..count).for_each(|place| world.start(place, 0));
        world
    }

    /// One control step with random actions; every third is followed by a few solver steps.
    pub fn step(&mut self) {
        self.meet_fate();
        let size = magworm::observe::action_size(self.batch.model());
        let actions: Vec<f64> =
            self.robots.iter().flat_map(|&robot| action(robot, self.control_steps, size)).collect();
        self.batch.step(
            &actions,
            StepOutput {
                observation: &mut self.observation,
                progress_m: &mut self.progress_m,
                status: &mut self.status,
            },
        );
        if self.control_steps % 3 == 2 {
            self.batch.advance(3);
        }
        self.control_steps += 1;
    }

    /// What can be seen of the robot at a place.
    pub fn record(&self, place: usize) -> Record {
        let width = self.observation.len() / self.robots.len();
        let mut record = Record::default();
        record.add_f32("observation", &self.observation[place * width..][..width]);
        record.add("progress", &[self.progress_m[place]]);
        record.add("status", &[f64::from(self.status[place])]);
        let model = self.batch.model_of(place);
        self.batch.view(place, |view| record.look(&view, model, model.contacts.len()));
        record
    }

    fn meet_fate(&mut self) {
        for place in 0..self.robots.len() {
            match (self.robots[place] % 8, self.control_steps) {
                (3, MISHAP) => self.fall_apart(place),
                (5, MISHAP) => self.sink(place),
                (6, FRESH_START) => self.start(place, 1),
                _ => {}
            }
        }
    }

    fn start(&mut self, place: usize, episode: u64) {
        let robot = self.robots[place];
        let mut draws = Draws::new(robot, 1000 + episode);
        let parameters = Model::PARAMETERS.len();
        // The first robot is the scene's own.
        let spread = if robot == 0 { 1.0 } else { 3.0 };
        for factor in &mut self.batch.factors_mut()[place * parameters..][..parameters] {
            *factor = draws.uniform(1.0 / spread, spread);
        }
        let magnets = self.batch.model().magnets();
        for is_in in &mut self.batch.present_mut()[place * magnets..][..magnets] {
            *is_in = draws.uniform(0.0, 1.0) < 0.8 || robot == 0;
        }
        let angle_rad = draws.uniform(-0.2, 0.2);
        let mut tilted = StartPose { height_m: 0.004, angle_rad, ..StartPose::default() };
        if self.batch.model().dimensions() == 3 {
            tilted.z_m = draws.uniform(-0.02, 0.02);
            tilted.yaw_rad = draws.uniform(-4.0, 4.0);
        }
        self.batch.reset(place, robot, episode, (robot % 3 == 2).then_some(tilted));
    }

    /// Almost no stiffness in free fall: stretched beyond its limit a little later.
    fn fall_apart(&mut self, place: usize) {
        let parameters = Model::PARAMETERS.len();
        let factors = &mut self.batch.factors_mut()[place * parameters..][..parameters];
        factors.fill(1.0);
        factors[..4].copy_from_slice(&[1e-7, 0.0, 1.0, 30.0]);
        let steep = StartPose { height_m: 0.02, angle_rad: 0.7, ..StartPose::default() };
        self.batch.reset(place, self.robots[place], 2, Some(steep));
    }

    /// Starts deep inside the ground.
    fn sink(&mut self, place: usize) {
        let buried = StartPose { height_m: -1.0, ..StartPose::default() };
        self.batch.reset(place, self.robots[place], 3, Some(buried));
    }
}

/// The records of all robots over some control steps, `[control step][place]`.
pub fn run(world: &mut World, steps: u64) -> Vec<Vec<Record>> {
    let places = world.batch.count();
    (0..steps)
        .map(|_| {
            world.step();
            (0..places).map(|place| world.record(place)).collect()
        })
        .collect()
}

/// A little beyond [−1, 1], so that clipping is part of the test.
fn action(robot: u64, control_step: u64, size: usize) -> Vec<f64> {
    let mut draws = Draws::new(robot, 1_000_000 + control_step / 4);
    (0..size).map(|_| draws.uniform(-1.1, 1.1)).collect()
}
