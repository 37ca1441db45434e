//! Looking at one environment of a batch, whatever the width of its block.

use super::block::{Block, Status};
use crate::model::Model;
use crate::observe;

/// One environment, to be looked at.
pub struct View<'a> {
    model: &'a Model,
    block: &'a dyn LaneView,
    lane: usize,
}

impl<'a> View<'a> {
    /// One lane of a block.
    pub(super) fn new<const W: usize>(model: &'a Model, block: &'a Block<W>, lane: usize) -> Self {
        Self { model, block, lane }
    }
}

/// What can be asked of a block of any width.
trait LaneView {
    fn node(&self, model: &Model, node: usize, lane: usize) -> [f64; 2];
    fn magnet(&self, model: &Model, magnet: usize, lane: usize) -> ([f64; 3], [f64; 3]);
    fn stage(&self, lane: usize) -> [f64; 4];
    fn centre_x(&self, model: &Model, lane: usize) -> f64;
    fn steps(&self, lane: usize) -> f64;
    fn status(&self, lane: usize) -> Status;
    fn observe(&self, model: &Model, lane: usize, row: &mut [f32]);
    fn contact(&self, contact: usize, lane: usize) -> [f64; 3];
}

impl<const W: usize> LaneView for Block<W> {
    fn node(&self, model: &Model, node: usize, lane: usize) -> [f64; 2] {
        self.node_position(model, node, lane)
    }
    fn magnet(&self, model: &Model, magnet: usize, lane: usize) -> ([f64; 3], [f64; 3]) {
        (self.magnet_pose(model, magnet, lane), self.magnet_velocity(model, magnet, lane))
    }
    fn stage(&self, lane: usize) -> [f64; 4] {
        [0, 1, 2, 3].map(|k| self.stage[k][lane])
    }
    fn centre_x(&self, model: &Model, lane: usize) -> f64 {
        Block::centre_x(self, model, lane)
    }
    fn steps(&self, lane: usize) -> f64 {
        self.step_count[0][lane]
    }
    fn status(&self, lane: usize) -> Status {
        self.status[lane]
    }
    fn observe(&self, model: &Model, lane: usize, row: &mut [f32]) {
        observe::write(model, self, lane, row);
    }
    fn contact(&self, contact: usize, lane: usize) -> [f64; 3] {
        [self.mode[contact][lane], self.normal[contact][lane], self.tangential[contact][lane]]
    }
}

impl View<'_> {
    /// Position of a node [m].
    pub fn node_m(&self, node: usize) -> [f64; 2] {
        self.block.node(self.model, node, self.lane)
    }
    /// Pose (x, y [m], angle [rad]) of a body magnet.
    pub fn magnet_pose(&self, magnet: usize) -> [f64; 3] {
        self.block.magnet(self.model, magnet, self.lane).0
    }
    /// Velocity of a body magnet [m/s, m/s, rad/s].
    pub fn magnet_velocity(&self, magnet: usize) -> [f64; 3] {
        self.block.magnet(self.model, magnet, self.lane).1
    }
    /// x of the robot's centre [m].
    pub fn centre_x_m(&self) -> f64 {
        self.block.centre_x(self.model, self.lane)
    }
    /// Position [m] of the centre of a drive magnet; none where the scene has no drive.
    pub fn drive_m(&self, drive_magnet: usize) -> Option<[f64; 2]> {
        let layout = &self.model.program.drive.as_ref()?.layout;
        let [x, y, ..] = self.block.stage(self.lane);
        Some([layout.position(drive_magnet, x, self.centre_x_m()), y])
    }
    /// Velocity of the drive along x and y [m/s].
    pub fn drive_m_s(&self) -> [f64; 2] {
        let [_, _, vx, vy] = self.block.stage(self.lane);
        [vx, vy]
    }
    /// Time since the reset [s].
    pub fn time_s(&self) -> f64 {
        self.block.steps(self.lane) * self.model.step_s
    }
    /// Status.
    pub fn status(&self) -> Status {
        self.block.status(self.lane)
    }
    /// Mode, normal and tangential impulse [N·s] of a contact point in the last step.
    pub fn contact(&self, contact: usize) -> [f64; 3] {
        self.block.contact(contact, self.lane)
    }
    /// Writes the observation.
    pub fn observe(&self, row: &mut [f32]) {
        self.block.observe(self.model, self.lane, row);
    }
}
