//! Looking at one environment of a batch, whatever the width of its block.

use super::wrenches::magnet_wrenches;
use crate::actuator::{Actuator, states};
use crate::lanes::{Dimensions, Number, Row};
use crate::model::{Model, Robot};
use crate::observe;
use crate::state::{Block, Pose, Status, Twist};
use nalgebra::Vector3;

/// One environment, to be looked at.
pub struct View<'a> {
    model: &'a Model,
    block: &'a dyn LaneView,
    lane: usize,
}

impl<'a> View<'a> {
    /// One lane of a block.
    pub(crate) fn new<R: Row>(model: &'a Model, block: &'a Block<R>, lane: usize) -> Self {
        Self { model, block, lane }
    }
}

/// What can be asked of a block of any width.
trait LaneView {
    fn node(&self, model: &Model, node: usize, lane: usize) -> Vector3<f64>;
    fn pose(&self, model: &Model, magnet: usize, lane: usize) -> Pose;
    fn velocity(&self, model: &Model, magnet: usize, lane: usize) -> Twist;
    fn planar_pose(&self, model: &Model, magnet: usize, lane: usize) -> [f64; 3];
    fn actuators(&self, lane: usize) -> Vec<f64>;
    fn robot_pose(&self, model: &Model, robot: usize, lane: usize) -> [f64; 3];
    fn steps(&self, lane: usize) -> u64;
    fn status(&self, lane: usize) -> Status;
    fn observe(&self, model: &Model, lane: usize, row: &mut [f32]);
    fn contact(&self, model: &Model, contact: usize, lane: usize) -> Vec<f64>;
    fn wrenches(&self, model: &Model, lane: usize) -> Vec<f64>;
}

impl<R: Row> LaneView for Block<R> {
    fn node(&self, model: &Model, node: usize, lane: usize) -> Vector3<f64> {
        self.node_position(model, node, lane)
    }
    fn pose(&self, model: &Model, magnet: usize, lane: usize) -> Pose {
        self.magnet_pose(model, magnet, lane)
    }
    fn velocity(&self, model: &Model, magnet: usize, lane: usize) -> Twist {
        self.magnet_velocity(model, magnet, lane)
    }
    fn planar_pose(&self, model: &Model, magnet: usize, lane: usize) -> [f64; 3] {
        Block::planar_pose(self, model, magnet, lane)
    }
    fn actuators(&self, lane: usize) -> Vec<f64> {
        self.stage.iter().map(|row| row[lane].f64()).collect()
    }
    fn robot_pose(&self, model: &Model, robot: usize, lane: usize) -> [f64; 3] {
        Block::robot_pose(self, model, robot, lane)
    }
    fn wrenches(&self, model: &Model, lane: usize) -> Vec<f64> {
        magnet_wrenches(model, self, lane)
    }
    fn steps(&self, lane: usize) -> u64 {
        self.step_count[lane]
    }
    fn status(&self, lane: usize) -> Status {
        self.status[lane]
    }
    fn observe(&self, model: &Model, lane: usize, row: &mut [f32]) {
        observe::write(model, self, lane, row);
    }
    fn contact(&self, model: &Model, contact: usize, lane: usize) -> Vec<f64> {
        let along = model.dimensions() - 1;
        let spring = (0..along).map(|t| self.tangential_spring[along * contact + t][lane].f64());
        [self.contact_mode[contact][lane].f64(), self.normal_impulse[contact][lane].f64()]
            .into_iter()
            .chain(spring)
            .collect()
    }
}

/// Rows of numbers as arrays hold them; their length is that of the scene's dimensions.
impl View<'_> {
    /// Writes the position of a node: x, y, in space also z [m].
    pub fn write_node(&self, node: usize, row: &mut [f64]) {
        let place = self.block.node(self.model, node, self.lane);
        row.copy_from_slice(&place.as_slice()[..row.len()]);
    }
    /// Writes the pose of a body magnet: in the plane x, y [m] and angle [rad], in space x, y, z [m] and the
    /// quaternion w, x, y, z of its orientation, w ≥ 0.
    pub fn write_magnet_pose(&self, magnet: usize, row: &mut [f64]) {
        if self.model.dimensions() == 2 {
            row.copy_from_slice(&self.block.planar_pose(self.model, magnet, self.lane));
            return;
        }
        let Pose { position_m, orientation } = self.pose(magnet);
        let [x, y, z, w] = orientation.coords.into();
        let sign = if w < 0.0 { -1.0 } else { 1.0 };
        row[..3].copy_from_slice(position_m.as_slice());
        row[3..].copy_from_slice(&[w, x, y, z].map(|q| sign * q));
    }
    /// Writes the velocity of a body magnet: in the plane vx, vy [m/s] and rate [rad/s], in space vx, vy, vz [m/s]
    /// and the angular velocity about x, y, z [rad/s].
    pub fn write_magnet_velocity(&self, magnet: usize, row: &mut [f64]) {
        let Twist { linear_m_s, angular_rad_s } =
            self.block.velocity(self.model, magnet, self.lane);
        let Dimensions { axes, rotations, .. } = self.model.sizes();
        row[..axes].copy_from_slice(&linear_m_s.as_slice()[..axes]);
        row[axes..].copy_from_slice(&angular_rad_s.as_slice()[3 - rotations..]);
    }
    /// Centre of a drive magnet: x, y, in space also z [m] and yaw [rad]; none where the scene has no drive.
    pub fn drive_place(&self, drive_magnet: usize) -> Option<Vec<f64>> {
        let state = self.block.actuators(self.lane);
        let place = |(actuator, state): (&Actuator, &[f64])| {
            let robot = self.block.robot_pose(self.model, actuator.robot(), self.lane);
            let place = |magnet| actuator.magnet_place(magnet, state, robot[0]);
            (0..actuator.magnets()).map(place).collect::<Vec<_>>()
        };
        states(&self.model.program.actuators, &state).flat_map(place).nth(drive_magnet)
    }
    /// Velocity of the drive along x and y, in space also along z [m/s] and of its yaw [rad/s].
    pub fn drive_velocity(&self) -> Vec<f64> {
        let state = self.block.actuators(self.lane);
        if state.is_empty() {
            return vec![0.0; self.model.sizes().stage];
        }
        let velocity = |(actuator, state): (&Actuator, _)| actuator.velocity(state);
        states(&self.model.program.actuators, &state).flat_map(velocity).collect()
    }
    /// Writes the centre of a drive magnet, see [`Self::drive_place`]; nothing where the scene has no drive.
    pub fn write_drive_place(&self, drive_magnet: usize, row: &mut [f64]) {
        if let Some(place) = self.drive_place(drive_magnet) {
            row.copy_from_slice(&place);
        }
    }
    /// A row of its own, see [`Self::write_node`].
    pub fn node_m(&self, node: usize) -> Vec<f64> {
        row(self.model.dimensions(), |row| self.write_node(node, row))
    }
    /// A row of its own, see [`Self::write_magnet_pose`].
    pub fn magnet_pose(&self, magnet: usize) -> Vec<f64> {
        row(self.model.sizes().pose(), |row| self.write_magnet_pose(magnet, row))
    }
    /// Force [N] and torque about its middle [N·m] of drive and field on each body magnet, one after another, as the next step
    /// takes them: (F_x, F_y, T_z) in the plane, (F_x, F_y, F_z, T_x, T_y, T_z) in space.
    pub fn magnet_wrenches(&self) -> Vec<f64> {
        self.block.wrenches(self.model, self.lane)
    }

    /// A row of its own, see [`Self::write_magnet_velocity`].
    pub fn magnet_velocity(&self, magnet: usize) -> Vec<f64> {
        row(self.model.sizes().body(), |row| self.write_magnet_velocity(magnet, row))
    }
    /// Mode and normal impulse of a contact point in the last step, and what its tangential spring holds along the
    /// ground [N·s].
    pub fn contact(&self, contact: usize) -> Vec<f64> {
        self.block.contact(self.model, contact, self.lane)
    }
}

impl View<'_> {
    /// Pose of a body magnet.
    pub fn pose(&self, magnet: usize) -> Pose {
        self.block.pose(self.model, magnet, self.lane)
    }
    /// The robot seen from above: x, z of its centre [m], and its heading [rad]; see [`Block::robot_pose`].
    pub fn robot_pose(&self) -> [f64; 3] {
        self.block.robot_pose(self.model, Robot::AGENT, self.lane)
    }
    /// Time since the reset [s].
    pub fn time_s(&self) -> f64 {
        self.block.steps(self.lane) as f64 * self.model.step_s
    }
    /// Status.
    pub fn status(&self) -> Status {
        self.block.status(self.lane)
    }
    /// Writes the observation.
    pub fn observe(&self, row: &mut [f32]) {
        self.block.observe(self.model, self.lane, row);
    }
}

fn row(width: usize, write: impl Fn(&mut [f64])) -> Vec<f64> {
    let mut row = vec![0.0; width];
    write(&mut row);
    row
}
