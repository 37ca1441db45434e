//! Magnets of a model and what carries them.

use super::Mesh;
use crate::actuator::Actuator;
use crate::magnetic::{self, Cuboid};
use crate::scene::{Direction, Drive, MeshMagnet};
use nalgebra::Vector3;

/// A permanent magnet: a cuboid that what carries it moves and turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnet {
    /// What carries it.
    pub on: Carrier,
    /// Place of its centre in the frame of a body, along it, up and to the side [m]; none where it is its origin. An
    /// actuator knows the places of its magnets.
    pub offset_m: Option<[f64; 3]>,
    /// Edges along its carrier, up and to the side [m].
    pub size_m: [f64; 3],
    /// Remanence along `direction`, negative where it points the other way [T].
    pub remanence_t: f64,
    /// Direction of the remanence in the frame of its carrier; up where it is magnetised straight down.
    pub direction: Direction,
}

/// What carries a magnet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// A rigid body of the robot.
    Body(usize),
    /// An actuator.
    Actuator {
        /// Its place in the list of a scene's actuators.
        actuator: usize,
        /// Which of its magnets.
        magnet: usize,
    },
}

impl Magnet {
    /// All magnets of a scene: those of bodies in the order of the mesh, then those of actuators.
    pub(super) fn all(mesh: &Mesh, drive: Option<&Drive>, actuators: &[Actuator]) -> Vec<Self> {
        let held = mesh.magnets.iter().map(Self::in_body);
        let moved = drive.into_iter().flat_map(|drive| {
            let stages = actuators.iter().map(Actuator::stage).enumerate();
            let stages = stages.filter_map(|(place, stage)| Some((place, stage?)));
            stages.flat_map(move |(actuator, stage)| {
                let magnets = stage.layout.polarity.iter().enumerate();
                magnets.map(move |(magnet, polarity)| {
                    Self::on_stage(drive, Carrier::Actuator { actuator, magnet }, *polarity)
                })
            })
        });
        held.chain(moved).collect()
    }

    fn in_body(MeshMagnet { body, magnet }: &MeshMagnet) -> Self {
        let (direction, sign) = Direction::of(magnet);
        let offset_m = magnet.offset_m();
        Self {
            on: Carrier::Body(*body),
            offset_m: (offset_m != [0.0; 3]).then_some(offset_m),
            size_m: [magnet.length_m, magnet.height_m, magnet.width_m],
            remanence_t: magnet.remanence_t * sign,
            direction,
        }
    }

    fn on_stage(drive: &Drive, on: Carrier, polarity: f64) -> Self {
        Self {
            on,
            offset_m: None,
            size_m: [drive.length_m, drive.height_m, drive.width_m],
            remanence_t: drive.remanence_t * polarity,
            direction: Direction::Up,
        }
    }

    /// Its cuboid.
    pub fn cuboid(&self) -> Cuboid {
        let [length_m, height_m, width_m] = self.size_m;
        Cuboid { length_m, height_m, width_m }
    }

    /// The same magnet of 1 T.
    pub fn unit(&self) -> magnetic::Magnet {
        let remanence_t = self.direction.vector().into();
        magnetic::Magnet { size_m: Vector3::from(self.size_m), remanence_t }
    }

    /// Whether another magnet has its shape and direction; strength and place aside.
    pub fn is_alike(&self, other: &Self) -> bool {
        self.size_m == other.size_m && self.direction == other.direction
    }
}
