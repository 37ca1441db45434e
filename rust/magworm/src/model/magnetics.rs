//! Compiled wrench of the drive magnets on the body magnets.

use super::{Carrier, Magnet};
use crate::lanes::Dimensions;
use crate::magnetic::{ObliquePair, PlanarDipole, PlanarPair, SpatialDipole, SpatialPair};
use crate::scene::{Direction, MagnetModel, Parameter, Scene};

/// The pairs of magnets of a scene, and which components of their wrench act.
#[derive(Clone, Debug)]
pub struct Magnetics {
    /// For each body magnet the pairs that it is the target of, in the order in which their wrenches are summed.
    pub pairs: Vec<Vec<MagneticPair>>,
    /// The models that pairs name: one for all pairs that are alike.
    pub models: Vec<PairModel>,
    /// The parameter that each component is multiplied by, and 1 where it acts, 0 where it is switched off: (F_x, F_y, T_z) in
    /// the plane, where those beyond do not count, (F_x, F_y, F_z, T_x, T_y, T_z) in space.
    pub terms: [(Parameter, f64); 6],
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
    /// The model of a drive magnet, which stands upright, and a body magnet.
    fn new(scene: &Scene, source: &Magnet, target: &Magnet) -> Self {
        match (scene.solver.magnet_model, scene.dimensions) {
            (MagnetModel::Cuboid, _) => {
                Self::cuboids(scene, source, target, scene.solver.quadrature_order)
            }
            (MagnetModel::Dipole, 2) => {
                Self::Dipole(PlanarDipole::new(source.cuboid(), target.cuboid()))
            }
            (MagnetModel::Dipole, _) => {
                Self::SpatialDipole(SpatialDipole::new(source.cuboid(), target.cuboid()))
            }
        }
    }

    /// Two cuboids of any direction, with so many points an edge.
    pub(super) fn cuboids(scene: &Scene, source: &Magnet, target: &Magnet, order: usize) -> Self {
        let units = [source, target].map(Magnet::unit);
        if scene.dimensions == 3 {
            return Self::SpatialCuboid(SpatialPair::new(&units[0], &units[1], order));
        }
        match [source.direction, target.direction] {
            [Direction::Up, Direction::Up] => {
                Self::Cuboid(PlanarPair::new(source.cuboid(), target.cuboid(), order))
            }
            _ => Self::ObliqueCuboid(Box::new(ObliquePair::new(&units[0], &units[1], order))),
        }
    }
}

/// The parameter of each component of a wrench, and 1 where it acts, else 0.
fn terms(scene: &Scene) -> [(Parameter, f64); 6] {
    let axes = Dimensions::new(scene.dimensions).axes;
    let forces = [Parameter::HorizontalForce, Parameter::VerticalForce, Parameter::HorizontalForce];
    let mut terms = [Parameter::Torque; 6];
    terms[..axes].copy_from_slice(&forces[..axes]);
    terms.map(|term| (term, if scene.magnetic_terms.has(term) { 1.0 } else { 0.0 }))
}
