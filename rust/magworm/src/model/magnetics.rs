//! Compiled wrench of the drive magnets on the body magnets.

use super::{Mesh, MeshMagnet};
use crate::lanes::Dimensions;
use crate::magnetic::{
    self, Cuboid, ObliquePair, PlanarDipole, PlanarPair, SpatialDipole, SpatialPair,
};
use crate::scene::{Direction, Drive, MagnetModel, Scene};
use nalgebra::Vector3;

/// The pairs of magnets of a scene, and which components of their wrench act.
#[derive(Clone, Debug)]
pub struct Magnetics {
    /// For each body magnet the pairs that it is the target of, in the order in which their wrenches are summed.
    pub pairs: Vec<Vec<MagneticPair>>,
    /// The models that pairs name: one for all pairs that are alike.
    pub models: Vec<PairModel>,
    /// 1 for components that act, 0 for those switched off: (F_x, F_y, T_z) in the plane, where those beyond do not count,
    /// (F_x, F_y, F_z, T_x, T_y, T_z) in space.
    pub terms: [f64; 6],
    /// |Br| of a drive magnet [T].
    pub drive_remanence_t: f64,
    /// Steps for which a wrench acts; 1: it is computed in each, and nothing is held.
    pub interval: u64,
}

/// A magnet in the field of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MagneticPair {
    /// The drive magnet whose field acts.
    pub source: usize,
    /// The body magnet that it acts on.
    pub target: usize,
    /// Their model.
    pub model: usize,
}

/// A model of two magnets.
#[derive(Clone, Debug)]
pub enum PairModel {
    /// Closed-form field, integrated over the charged faces, in the plane.
    Cuboid(PlanarPair),
    /// The same with a body magnet whose remanence leans.
    ObliqueCuboid(Box<ObliquePair>),
    /// Point dipoles in the plane.
    Dipole(PlanarDipole),
    /// Closed-form field, integrated over the charged faces, in space; both remanences are 1 T.
    SpatialCuboid(SpatialPair),
    /// Point dipoles in space; both remanences are 1 T.
    SpatialDipole(SpatialDipole),
}

impl Magnetics {
    /// Compiles the magnets of a scene.
    pub fn new(scene: &Scene, mesh: &Mesh, drive: &Drive) -> Self {
        let mut kinds: Vec<&MeshMagnet> = Vec::new();
        let mut pairs = Vec::new();
        for (target, magnet) in mesh.magnets.iter().enumerate() {
            let known = kinds.iter().position(|kind| kind.is_alike(magnet));
            let model = known.unwrap_or(kinds.len());
            if known.is_none() {
                kinds.push(magnet);
            }
            let sources = 0..drive.arrangement.magnets();
            pairs.push(sources.map(|source| MagneticPair { source, target, model }).collect());
        }
        Self {
            pairs,
            models: kinds.iter().map(|magnet| PairModel::new(scene, drive, magnet)).collect(),
            terms: terms(scene),
            drive_remanence_t: drive.remanence_t,
            interval: scene.solver.wrench_interval as u64,
        }
    }

    /// Number of pairs.
    pub fn count(&self) -> usize {
        self.pairs.iter().map(Vec::len).sum()
    }
}

impl PairModel {
    /// The model of a drive magnet and a body magnet.
    fn new(scene: &Scene, drive: &Drive, magnet: &MeshMagnet) -> Self {
        let source =
            Cuboid { length_m: drive.length_m, height_m: drive.height_m, width_m: drive.width_m };
        let (body, order) = (magnet.cuboid(), scene.solver.quadrature_order);
        let units = || [unit(source, Direction::Up), unit(body, magnet.direction)];
        match (scene.solver.magnet_model, scene.dimensions) {
            (MagnetModel::Cuboid, 2) => match magnet.direction {
                Direction::Up => Self::Cuboid(PlanarPair::new(source, body, order)),
                Direction::Oblique(_) => {
                    let [source, body] = units();
                    Self::ObliqueCuboid(Box::new(ObliquePair::new(&source, &body, order)))
                }
            },
            (MagnetModel::Dipole, 2) => Self::Dipole(PlanarDipole::new(source, body)),
            (MagnetModel::Cuboid, _) => {
                let [source, body] = units();
                Self::SpatialCuboid(SpatialPair::new(&source, &body, order))
            }
            (MagnetModel::Dipole, _) => Self::SpatialDipole(SpatialDipole::new(source, body)),
        }
    }
}

/// 1 for each component of a wrench that acts, else 0.
fn terms(scene: &Scene) -> [f64; 6] {
    let (terms, axes) = (&scene.magnetic_terms, Dimensions::new(scene.dimensions).axes);
    let forces = [terms.horizontal_force, terms.vertical_force, terms.horizontal_force];
    let mut acts = [terms.torque; 6];
    acts[..axes].copy_from_slice(&forces[..axes]);
    acts.map(|on| if on { 1.0 } else { 0.0 })
}

/// A cuboid of 1 T, in the order length, height, width.
fn unit(cuboid: Cuboid, direction: Direction) -> magnetic::Magnet {
    magnetic::Magnet {
        size_m: Vector3::new(cuboid.length_m, cuboid.height_m, cuboid.width_m),
        remanence_t: direction.vector().into(),
    }
}
