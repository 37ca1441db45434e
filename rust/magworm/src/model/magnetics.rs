//! Compiled wrench of the drive magnets on the body magnets.

use super::{Carrier, Magnet};
use crate::lanes::Dimensions;
use crate::magnetic::{ObliquePair, PlanarDipole, PlanarPair, SpatialDipole, SpatialPair};
use crate::scene::{Direction, MagnetModel, Scene};

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
    /// Steps for which a wrench acts; 1: it is computed in each, and nothing is held.
    pub interval: u64,
}

/// A magnet in the field of another; both are places in [`super::Model::magnets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MagneticPair {
    /// The magnet whose field acts.
    pub source: usize,
    /// The magnet that it acts on.
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
    /// Compiles the wrenches of the drive on the body.
    pub fn new(scene: &Scene, magnets: &[Magnet]) -> Self {
        let (sources, targets): (Vec<usize>, Vec<usize>) =
            (0..magnets.len()).partition(|&k| matches!(magnets[k].on, Carrier::Actuator { .. }));
        let mut kinds: Vec<[&Magnet; 2]> = Vec::new();
        let mut pair = |source: usize, target: usize| {
            let pair = [source, target].map(|k| &magnets[k]);
            let is_alike = |kind: &[&Magnet; 2]| (0..2).all(|k| kind[k].is_alike(pair[k]));
            let model = kinds.iter().position(is_alike).unwrap_or_else(|| {
                kinds.push(pair);
                kinds.len() - 1
            });
            MagneticPair { source, target, model }
        };
        let on = |target: usize| sources.iter().map(move |&source| (source, target));
        let pairs = targets
            .iter()
            .map(|&target| on(target).map(|(source, target)| pair(source, target)).collect())
            .collect();
        Self {
            pairs,
            models: kinds
                .iter()
                .map(|&[source, target]| PairModel::new(scene, source, target))
                .collect(),
            terms: terms(scene),
            interval: scene.solver.wrench_interval as u64,
        }
    }

    /// Number of pairs.
    pub fn count(&self) -> usize {
        self.pairs.iter().map(Vec::len).sum()
    }
}

impl PairModel {
    /// The model of two magnets, the source upright.
    fn new(scene: &Scene, source: &Magnet, target: &Magnet) -> Self {
        let (from, to, order) = (source.cuboid(), target.cuboid(), scene.solver.quadrature_order);
        let (of_from, of_to) = (source.unit(), target.unit());
        match (scene.solver.magnet_model, scene.dimensions) {
            (MagnetModel::Cuboid, 2) => match target.direction {
                Direction::Up => Self::Cuboid(PlanarPair::new(from, to, order)),
                Direction::Oblique(_) => {
                    Self::ObliqueCuboid(Box::new(ObliquePair::new(&of_from, &of_to, order)))
                }
            },
            (MagnetModel::Dipole, 2) => Self::Dipole(PlanarDipole::new(from, to)),
            (MagnetModel::Cuboid, _) => {
                Self::SpatialCuboid(SpatialPair::new(&of_from, &of_to, order))
            }
            (MagnetModel::Dipole, _) => Self::SpatialDipole(SpatialDipole::new(from, to)),
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
