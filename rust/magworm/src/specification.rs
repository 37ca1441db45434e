//! How observations and actions are declared and written: named slices, units, the frame of the robot.

use crate::lanes::math::sin_cos;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// One named slice of an observation or action.
#[derive(Clone, Debug, PartialEq)]
pub struct Specification {
    /// Name.
    pub name: &'static str,
    /// Unit of its components.
    pub unit: String,
    /// Number of components.
    pub size: usize,
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// One sentence.
    pub description: &'static str,
}

impl Specification {
    /// A slice without bounds.
    pub fn new(name: &'static str, unit: &str, size: usize, description: &'static str) -> Self {
        let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        Self { name, unit: unit.to_string(), size, low, high, description }
    }

    /// Numbers in [−1, 1].
    pub fn within_one(name: &'static str, size: usize, description: &'static str) -> Self {
        Self { low: -1.0, high: 1.0, ..Self::new(name, "1", size, description) }
    }
}

/// What lengths and speeds of an observation are in units of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Unit of lengths [m].
    pub length_m: f64,
    /// Unit of speeds [m/s].
    pub speed_m_s: f64,
}

impl Scales {
    /// Unit of lengths, for a person.
    pub fn length(&self) -> String {
        format!("{} m", self.length_m)
    }

    /// Unit of speeds.
    pub fn speed(&self) -> String {
        format!("{} m/s", self.speed_m_s)
    }

    /// Unit of angular velocities.
    pub fn rate(&self) -> String {
        format!("{} rad/s", self.rate_rad_s())
    }

    /// Unit of angular velocities [rad/s].
    pub fn rate_rad_s(&self) -> f64 {
        self.speed_m_s / self.length_m
    }
}

/// What a robot in space is seen from: the point beneath its centre, x from its head to its tail, z to its side.
#[derive(Clone, Copy, Debug)]
pub struct Outlook {
    /// x, z of its centre [m], and its heading [rad].
    pub robot: [f64; 3],
    robot_from_world: Rotation3<f64>,
}

impl Outlook {
    /// The outlook of a robot: x, z of its centre [m], and its heading [rad].
    pub fn new(robot: [f64; 3]) -> Self {
        let (sin, cos) = sin_cos(robot[2]);
        let matrix = Matrix3::new(cos, 0.0, -sin, 0.0, 1.0, 0.0, sin, 0.0, cos);
        Self { robot, robot_from_world: Rotation3::from_matrix_unchecked(matrix) }
    }

    /// A place in the frame of the robot [m].
    pub fn place(&self, place_m: Vector3<f64>) -> Vector3<f64> {
        self.vector(place_m - Vector3::new(self.robot[0], 0.0, self.robot[1]))
    }

    /// A velocity or an axis in the frame of the robot.
    pub fn vector(&self, vector: Vector3<f64>) -> Vector3<f64> {
        self.robot_from_world * vector
    }

    /// An orientation in the frame of the robot.
    pub fn orientation(&self, world_from_body: UnitQuaternion<f64>) -> UnitQuaternion<f64> {
        self.robot_from_world * world_from_body
    }
}

/// Writes an observation number by number.
#[derive(Debug)]
pub struct Observation<'a> {
    row: &'a mut [f32],
    at: usize,
}

impl<'a> Observation<'a> {
    /// Begins at the start of a row.
    pub fn new(row: &'a mut [f32]) -> Self {
        Self { row, at: 0 }
    }

    /// Writes numbers one after the other.
    pub fn numbers(&mut self, numbers: &[f64]) {
        for &number in numbers {
            self.row[self.at] = number as f32;
            self.at += 1;
        }
    }

    /// Writes a vector.
    pub fn vector(&mut self, vector: Vector3<f64>) {
        self.numbers(vector.as_slice());
    }

    /// Writes zeros to the end of the row.
    pub fn nothing(&mut self) {
        self.row[self.at..].fill(0.0);
        self.at = self.row.len();
    }
}
