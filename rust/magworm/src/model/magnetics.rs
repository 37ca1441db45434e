//! Compiled wrench of the drive magnets on the body magnets.

use crate::magnetic::{Cuboid, PlanarDipole, PlanarPair};
use crate::scene::{Drive, Magnet, MagnetModel, Scene};

/// Model of one drive magnet and one body magnet, and which components of the wrench act.
#[derive(Clone, Debug)]
pub struct Magnetics {
    /// The pair.
    pub pair: PairModel,
    /// 1 for components (F_x, F_y, T_z) that act, 0 for those switched off.
    pub terms: [f64; 3],
    /// |Br| of a drive magnet [T].
    pub drive_remanence_t: f64,
}

/// A model of two magnets.
#[derive(Clone, Debug)]
pub enum PairModel {
    /// Closed-form field, integrated over the charged faces.
    Cuboid(PlanarPair),
    /// Point dipoles.
    Dipole(PlanarDipole),
}

impl Magnetics {
    /// Compiles the magnets of a scene.
    pub fn new(scene: &Scene, magnet: &Magnet, drive: &Drive) -> Self {
        let source =
            Cuboid { length_m: drive.length_m, height_m: drive.height_m, width_m: drive.width_m };
        let body = cuboid(magnet);
        let pair = match scene.solver.magnet_model {
            MagnetModel::Cuboid => {
                PairModel::Cuboid(PlanarPair::new(source, body, scene.solver.quadrature_order))
            }
            MagnetModel::Dipole => PairModel::Dipole(PlanarDipole::new(source, body)),
        };
        let terms = &scene.magnetic_terms;
        let acts = [terms.horizontal_force, terms.vertical_force, terms.torque];
        Self {
            pair,
            terms: acts.map(|on| if on { 1.0 } else { 0.0 }),
            drive_remanence_t: drive.remanence_t,
        }
    }
}

/// The cuboid of a body magnet.
pub fn cuboid(magnet: &Magnet) -> Cuboid {
    Cuboid { length_m: magnet.length_m, height_m: magnet.height_m, width_m: magnet.width_m }
}
