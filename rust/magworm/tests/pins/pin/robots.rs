//! Unequal robots under random actions, and the hash of everything that is seen of them.
//!
//! A robot's parameters, magnets, start, actions and mishaps follow from its number alone.

use super::hash::Hash;
use magworm::internals::Draws;
use magworm::{Batch, LaneChoice, Model, StartPose, StepOutput, View};
use std::sync::Arc;

/// The scene's own robot.
const OWN: u64 = 0;
/// Has lost its last magnet.
const DAMAGED: u64 = 1;
/// Starts tilted above the ground.
const TILTED: u64 = 2;
/// Starts afresh midway.
const RESET: u64 = 3;
/// Falls with hardly any stiffness after a while, and is stretched beyond its limit.
const LIMP: u64 = 4;
/// Starts deep in the ground after a while.
const BURIED: u64 = 5;

/// All of them; the last two break.
pub const ALL: &[u64] = &[OWN, DAMAGED, TILTED, RESET, LIMP, BURIED];

/// So many parameters are a robot's own: those that there were when the pins were made.
const DRAWN: usize = 7;

/// Control step in which robots meet their fate.
const FATE: u64 = 100;

/// A batch of robots with its output buffers.
pub struct Robots {
    /// The batch.
    pub batch: Batch,
    numbers: Vec<u64>,
    observation: Vec<f32>,
    progress_m: Vec<f64>,
    status: Vec<u8>,
}

impl Robots {
    /// The robots of these numbers, side by side, each at its start.
    pub fn new(model: &Arc<Model>, numbers: &[u64], lanes: LaneChoice) -> Self {
        let count = numbers.len();
        let mut robots = Self {
            batch: Batch::new(Arc::clone(model), count, lanes, Some(1)),
            numbers: numbers.to_vec(),
            observation: vec![0.0; count * magworm::observe::size(model)],
            progress_m: vec![0.0; count],
            status: vec![0; count],
        };
        (0..count).for_each(|place| robots.start(place, 0));
        robots
    }

    /// The hash of some control steps.
    pub fn run(&mut self, control_steps: u64) -> Hash {
        let mut hash = Hash::EMPTY;
        for control_step in 0..control_steps {
            if control_step == FATE {
                self.meet_fate();
            }
            self.step(control_step);
            (0..self.numbers.len()).for_each(|place| self.see(place, &mut hash));
        }
        hash
    }

    fn start(&mut self, place: usize, episode: u64) {
        let robot = self.numbers[place];
        let mut draws = Draws::new(robot, 1000 + episode);
        let spread = if robot == OWN { 1.0 } else { 1.5 };
        let factors: [f64; DRAWN] = std::array::from_fn(|_| draws.uniform(1.0 / spread, spread));
        self.set_factors(place, factors);
        let magnets = self.batch.model().magnets();
        if robot == DAMAGED && magnets > 0 {
            self.batch.present_mut()[(place + 1) * magnets - 1] = false;
        }
        let mut tilted = StartPose { height_m: 0.004, angle_rad: 0.15, ..StartPose::default() };
        if self.batch.model().dimensions() == 3 {
            (tilted.z_m, tilted.yaw_rad) = (-0.01, 2.5);
        }
        self.batch.reset(place, robot, episode, (robot == TILTED).then_some(tilted));
    }

    fn set_factors<const N: usize>(&mut self, place: usize, factors: [f64; N]) {
        let parameters = Model::PARAMETERS.len();
        self.batch.factors_mut()[place * parameters..][..N].copy_from_slice(&factors);
    }

    fn meet_fate(&mut self) {
        for place in 0..self.numbers.len() {
            match self.numbers[place] {
                RESET => self.start(place, 1),
                LIMP => self.fall_apart(place),
                BURIED => self.sink(place),
                _ => {}
            }
        }
    }

    fn fall_apart(&mut self, place: usize) {
        self.set_factors(place, [1e-7, 0.0, 1.0, 30.0, 1.0, 1.0, 1.0]);
        let steep = StartPose { height_m: 0.02, angle_rad: 0.7, ..StartPose::default() };
        self.batch.reset(place, LIMP, 2, Some(steep));
    }

    fn sink(&mut self, place: usize) {
        let buried = StartPose { height_m: -1.0, ..StartPose::default() };
        self.batch.reset(place, BURIED, 3, Some(buried));
    }

    /// One control step; every third is followed by a few solver steps.
    fn step(&mut self, control_step: u64) {
        let size = magworm::observe::action_size(self.batch.model());
        let actions: Vec<f64> =
            self.numbers.iter().flat_map(|&robot| action(robot, control_step, size)).collect();
        self.batch.step(
            &actions,
            StepOutput {
                observation: &mut self.observation,
                progress_m: &mut self.progress_m,
                status: &mut self.status,
            },
        );
        if control_step % 3 == 2 {
            self.batch.advance(3);
        }
    }

    fn see(&self, place: usize, hash: &mut Hash) {
        let width = self.observation.len() / self.numbers.len();
        let observation = &self.observation[place * width..][..width];
        observation.iter().for_each(|&value| hash.add(&[f64::from(value)]));
        hash.add(&[self.progress_m[place], f64::from(self.status[place])]);
        self.batch.view(place, |view| see_view(&view, self.batch.model(), hash));
    }
}

fn see_view(view: &View<'_>, model: &Model, hash: &mut Hash) {
    for magnet in 0..model.magnets() {
        hash.add(&view.magnet_pose(magnet));
        hash.add(&view.magnet_velocity(magnet));
    }
    (0..model.nodes()).for_each(|node| hash.add(&view.node_m(node)));
    (0..model.contacts.len()).for_each(|contact| hash.add(&view.contact(contact)));
    hash.add(&view.drive_place(0).unwrap_or_default());
    hash.add(&view.drive_velocity());
    hash.add(&view.robot_pose());
    hash.add(&[view.time_s(), f64::from(view.status() as u8)]);
}

/// A little beyond [−1, 1], so that clipping is seen.
fn action(robot: u64, control_step: u64, size: usize) -> Vec<f64> {
    let mut draws = Draws::new(robot, 1_000_000 + control_step / 4);
    (0..size).map(|_| draws.uniform(-1.1, 1.1)).collect()
}
