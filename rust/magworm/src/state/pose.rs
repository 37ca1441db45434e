//! Where the parts of a robot are, one lane at a time. In the plane z and all rotations but about z are 0.

use super::block::Block;
use crate::lanes::math::{atan2, sin_cos};
use crate::lanes::{Dimensions, Isa, Number, Row};
use crate::model::{Anchor, Model};
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// Pose of a body magnet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Centre [m].
    pub position_m: Vector3<f64>,
    /// Rotation from the magnet's tangent, up and side to x, y, z.
    pub orientation: UnitQuaternion<f64>,
}

impl Pose {
    /// Angle of the tangent in the plane x–y, anticlockwise [rad].
    pub fn pitch_rad(&self) -> f64 {
        let tangent = self.orientation * Vector3::x();
        atan2(tangent.y, tangent.x)
    }

    /// Roll about its own tangent [rad]: the angle of its side over the ground, positive where its up leans
    /// towards its side.
    pub fn roll_rad(&self) -> f64 {
        let (up, side) = (self.orientation * Vector3::y(), self.orientation * Vector3::z());
        atan2(-side.y, up.y)
    }
}

/// Velocity of a body magnet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Of its centre [m/s].
    pub linear_m_s: Vector3<f64>,
    /// Angular velocity about x, y, z [rad/s].
    pub angular_rad_s: Vector3<f64>,
}

impl<R: Row> Block<R> {
    /// Position [m] of a node in one lane.
    pub fn node_position(&self, model: &Model, node: usize, lane: usize) -> Vector3<f64> {
        let axes = model.dimensions();
        match model.coordinates.anchors[node] {
            Anchor::Free { dof } => self.vector(&self.q, dof, axes, lane),
            Anchor::Rigid { body, side } => {
                let arm = f64::from(side) * model.bodies[body].half_length_m;
                let dof = model.coordinates.bodies[body];
                self.vector(&self.q, dof, axes, lane) + self.rotation(model, body, lane).0 * arm
            }
            Anchor::Fixed => self.vector(&self.fixed_position, axes * node, axes, lane),
        }
    }

    /// Pose of a body magnet in one lane.
    pub fn magnet_pose(&self, model: &Model, magnet: usize, lane: usize) -> Pose {
        let (dof, axes) = (model.coordinates.bodies[magnet], model.dimensions());
        let position_m = self.vector(&self.q, dof, axes, lane);
        Pose { position_m, orientation: self.rotation(model, magnet, lane).1 }
    }

    /// Tangent of a body, and the rotation from its tangent, up and side to x, y, z, in one lane.
    fn rotation(
        &self,
        model: &Model,
        body: usize,
        lane: usize,
    ) -> (Vector3<f64>, UnitQuaternion<f64>) {
        if model.dimensions() == 2 {
            let angle_rad = self.q[model.coordinates.bodies[body] + 2][lane].f64();
            let (sin, cos) = sin_cos(angle_rad);
            return (Vector3::new(cos, sin, 0.0), about_z(angle_rad));
        }
        let up_row = 6 * model.bodies[body].element;
        let [up, tangent] =
            [up_row, up_row + 3].map(|row| self.vector(&self.director, row, 3, lane));
        let matrix = Matrix3::from_columns(&[tangent, up, tangent.cross(&up)]);
        let rotation = Rotation3::from_matrix_unchecked(matrix);
        (tangent, UnitQuaternion::from_rotation_matrix(&rotation))
    }

    /// Velocity of a body magnet in one lane.
    pub fn magnet_velocity(&self, model: &Model, magnet: usize, lane: usize) -> Twist {
        let Dimensions { axes, rotations, .. } = model.sizes();
        let dof = model.coordinates.bodies[magnet];
        let mut angular_rad_s = Vector3::zeros();
        for k in 0..rotations {
            // In the plane about z alone.
            angular_rad_s[3 - rotations + k] = self.v[dof + axes + k][lane].f64();
        }
        Twist { linear_m_s: self.vector(&self.v, dof, axes, lane), angular_rad_s }
    }

    /// Position x, y [m] of a body magnet in one lane, and its unknown of rotation about z [rad]: its angle in the plane, whole
    /// turns counted; in space the integral of its rate.
    pub fn planar_pose(&self, model: &Model, magnet: usize, lane: usize) -> [f64; 3] {
        let (dof, body) = (model.coordinates.bodies[magnet], model.sizes().body());
        [dof, dof + 1, dof + body - 1].map(|row| self.q[row][lane].f64())
    }

    /// Velocity of a body magnet in the plane x–y in one lane [m/s, m/s, rad/s].
    pub fn planar_velocity(&self, model: &Model, magnet: usize, lane: usize) -> [f64; 3] {
        let Twist { linear_m_s, angular_rad_s } = self.magnet_velocity(model, magnet, lane);
        [linear_m_s.x, linear_m_s.y, angular_rad_s.z]
    }

    /// x of a robot's centre in one lane [m]: mean of its magnets, or of its nodes where it has none.
    pub fn centre_x(&self, model: &Model, robot: usize, lane: usize) -> f64 {
        self.centre(model, robot, 0, lane)
    }

    /// The same in every lane, 0 where the robot has no magnets.
    #[inline(always)]
    pub fn centre_x_of_lanes<I: Isa<Row = R>>(&self, isa: I, model: &Model, robot: usize) -> I::F {
        let bodies = model.bodies_of(robot);
        let mut sum = isa.splat(0.0);
        for &dof in bodies {
            sum = sum + isa.load(&self.q[dof]);
        }
        sum / (bodies.len().max(1) as f64)
    }

    /// A robot seen from above in one lane: x, z of its centre [m], and its heading [rad].
    ///
    /// The heading is the yaw that would turn a straight robot along x so that its tail lies in the same
    /// direction from its head as that of this one.
    pub fn robot_pose(&self, model: &Model, robot: usize, lane: usize) -> [f64; 3] {
        if model.dimensions() == 2 {
            return [self.centre_x(model, robot, lane), 0.0, 0.0];
        }
        let [head, tail] = self.ends(model, robot, lane);
        let along = tail - head;
        let heading = atan2(-along.z, along.x);
        [self.centre(model, robot, 0, lane), self.centre(model, robot, 2, lane), heading]
    }

    /// First and last magnet in space, or node where a robot has fewer than two magnets.
    fn ends(&self, model: &Model, robot: usize, lane: usize) -> [Vector3<f64>; 2] {
        let nodes = &model.robots[robot].nodes;
        match model.bodies_of(robot) {
            [head, .., tail] => [*head, *tail].map(|dof| self.vector(&self.q, dof, 3, lane)),
            _ => [nodes.start, nodes.end - 1].map(|node| self.node_position(model, node, lane)),
        }
    }

    /// Mean along an axis.
    fn centre(&self, model: &Model, robot: usize, axis: usize, lane: usize) -> f64 {
        let bodies = model.bodies_of(robot);
        if bodies.is_empty() {
            let nodes = model.robots[robot].nodes.clone();
            let count = nodes.len();
            let sum: f64 = nodes.map(|n| self.node_position(model, n, lane)[axis]).sum();
            return sum / count as f64;
        }
        let places = bodies.iter().map(|&dof| self.q[dof + axis][lane].f64());
        places.sum::<f64>() / bodies.len() as f64
    }

    fn vector(&self, rows: &[R], first: usize, axes: usize, lane: usize) -> Vector3<f64> {
        let component = |k: usize| if k < axes { rows[first + k][lane].f64() } else { 0.0 };
        Vector3::new(component(0), component(1), component(2))
    }
}

/// The rotation about z by an angle [rad].
fn about_z(angle_rad: f64) -> UnitQuaternion<f64> {
    let (sin, cos) = sin_cos(0.5 * angle_rad);
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, Vector3::z() * sin))
}
