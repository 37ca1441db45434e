//! Compiled wrench of the drive magnets on the body magnets.

use crate::magnetic::{self, Cuboid, PlanarDipole, PlanarPair, SpatialDipole, SpatialPair};
use crate::scene::{Drive, Magnet, MagnetModel, Scene};
use nalgebra::Vector3;

/// Model of one drive magnet and one body magnet, and which components of the wrench act.
#[derive(Clone, Debug)]
pub struct Magnetics {
    /// The pair.
    pub pair: PairModel,
    /// 1 for components that act, 0 for those switched off: (F_x, F_y, T_z, …) in the plane,
    /// (F_x, F_y, F_z, T_x, T_y, T_z) in space.
    pub terms: [f64; 6],
    /// |Br| of a drive magnet [T].
    pub drive_remanence_t: f64,
    /// Steps for which a wrench acts; 1: it is computed in each, and nothing is held.
    pub interval: u64,
}

/// A model of two magnets.
#[derive(Clone, Debug)]
pub enum PairModel {
    /// Closed-form field, integrated over the charged faces, in the plane.
    Cuboid(PlanarPair),
    /// Point dipoles in the plane.
    Dipole(PlanarDipole),
    /// Closed-form field, integrated over the charged faces, in space; both remanences are 1 T.
    SpatialCuboid(SpatialPair),
    /// Point dipoles in space; both remanences are 1 T.
    SpatialDipole(SpatialDipole),
}

impl Magnetics {
    /// Compiles the magnets of a scene.
    pub fn new(scene: &Scene, magnet: &Magnet, drive: &Drive) -> Self {
        let source =
            Cuboid { length_m: drive.length_m, height_m: drive.height_m, width_m: drive.width_m };
        let body = cuboid(magnet);
        let order = scene.solver.quadrature_order;
        let pair = match (scene.solver.magnet_model, scene.dimensions) {
            (MagnetModel::Cuboid, 2) => PairModel::Cuboid(PlanarPair::new(source, body, order)),
            (MagnetModel::Dipole, 2) => PairModel::Dipole(PlanarDipole::new(source, body)),
            (MagnetModel::Cuboid, _) => {
                PairModel::SpatialCuboid(SpatialPair::new(&unit(source), &unit(body), order))
            }
            (MagnetModel::Dipole, _) => PairModel::SpatialDipole(SpatialDipole::new(source, body)),
        };
        let terms = &scene.magnetic_terms;
        let (along, up, turn) = (terms.horizontal_force, terms.vertical_force, terms.torque);
        let acts = match scene.dimensions {
            2 => [along, up, turn, false, false, false],
            _ => [along, up, along, turn, turn, turn],
        };
        Self {
            pair,
            terms: acts.map(|on| if on { 1.0 } else { 0.0 }),
            drive_remanence_t: drive.remanence_t,
            interval: scene.solver.wrench_interval as u64,
        }
    }
}

/// A cuboid of 1 T along its height, in the order length, height, width.
fn unit(cuboid: Cuboid) -> magnetic::Magnet {
    magnetic::Magnet {
        size_m: Vector3::new(cuboid.length_m, cuboid.height_m, cuboid.width_m),
        remanence_t: Vector3::y(),
    }
}

/// The cuboid of a body magnet.
pub fn cuboid(magnet: &Magnet) -> Cuboid {
    Cuboid { length_m: magnet.length_m, height_m: magnet.height_m, width_m: magnet.width_m }
}
