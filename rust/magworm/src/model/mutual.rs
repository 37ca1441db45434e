//! Compiled wrenches of body magnets on each other.
//!
//! Of two magnets the one nearer the middle of the robot is the source, whose field is integrated over the faces of the other.
//! Where both are as near, each is the source of half of the wrench: a robot and its mirror image then differ by rounding.

use super::contacts::body_mass_kg;
use super::{Magnet, Mesh, Model, PairByDistance};
use crate::scene::Scene;
use nalgebra::Vector3;

/// Greatest error of the force of two dipoles in place of two cuboids, as a share of the robot's weight.
const FAR_ERROR: f64 = 2e-3;
/// Places that differ by less than this part of the robot's length are the same.
const SAME: f64 = 1e-9;

/// The body magnets of a scene as sources of the field on each other.
#[derive(Clone, Debug)]
pub struct Mutual {
    /// The pairs, in the order in which their wrenches are summed.
    pub pairs: Vec<MutualPair>,
    /// What pairs of one kind are at each distance: one for all that are alike.
    pub kinds: Vec<PairByDistance>,
}

/// A body magnet in the field of another; both are places in [`Model::magnets`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MutualPair {
    /// The magnet whose field acts.
    pub source: usize,
    /// The magnet that it acts on.
    pub target: usize,
    /// Share of the wrench between both: ½ where each is the other's source.
    pub share: f64,
    /// Place in [`Mutual::kinds`].
    pub kind: usize,
}

impl Mutual {
    /// Compiles the body magnets of a scene; none where it has fewer than two, or leaves the term out.
    pub(super) fn new(scene: &Scene, mesh: &Mesh, magnets: &[Magnet]) -> Option<Self> {
        let held = if scene.magnetic_terms.mutual { mesh.magnets.len() } else { 0 };
        let two = (0..held).flat_map(|one| (one + 1..held).map(move |other| [one, other]));
        let apart = two.filter(|[one, other]| magnets[*one].on != magnets[*other].on);
        let (mut pairs, mut alike) = (Vec::new(), Vec::<[&Magnet; 2]>::new());
        for (source, target, share) in apart.flat_map(|two| from_the_middle(mesh, two)) {
            let both = [&magnets[source], &magnets[target]];
            let known = alike.iter().position(|other| (0..2).all(|k| equal(both[k], other[k])));
            pairs.push(MutualPair { source, target, share, kind: known.unwrap_or(alike.len()) });
            if known.is_none() {
                alike.push(both);
            }
        }
        let error_n = FAR_ERROR * 9.81 * body_mass_kg(scene, mesh);
        let kinds = alike.into_iter().map(|both| PairByDistance::new(scene, both, error_n));
        let kinds = kinds.collect();
        (!pairs.is_empty()).then_some(Self { pairs, kinds })
    }

    /// What the pairs are where the body lies straight, for a person.
    pub fn explain(&self, model: &Model) -> String {
        let (mut near, mut far, mut most) = (0.0, 0.0, 0);
        for pair in &self.pairs {
            match self.kinds[pair.kind].order(straight_m(model, pair)) {
                Some(order) => (near, most) = (near + pair.share, most.max(order)),
                None => far += pair.share,
            }
        }
        let from_m = self.kinds.iter().map(|kind| kind.far_m2.sqrt()).fold(0.0, f64::max);
        format!(
            "{near} near pairs, cuboids of order {most} or less, more where magnets come nearer; {far} far pairs, dipoles from \
             {:.1} mm on, where the force is off by at most {FAR_ERROR} of the weight",
            1e3 * from_m
        )
    }
}

/// Distance of the magnets of a pair where the body lies straight [m].
fn straight_m(model: &Model, pair: &MutualPair) -> f64 {
    let [from, to] = [pair.source, pair.target].map(|k| {
        let Magnet { offset_m, .. } = model.magnets[k];
        let along_m = model.mesh.middle_m(model.mesh.magnets[k].body);
        Vector3::from(offset_m.unwrap_or_default()) + Vector3::x() * along_m
    });
    (to - from).norm()
}

/// Source, target and share of two magnets: once, or each as the source of the other.
fn from_the_middle(mesh: &Mesh, [one, other]: [usize; 2]) -> Vec<(usize, usize, f64)> {
    let aside_m = |k: usize| (mesh.middle_m(mesh.magnets[k].body) - 0.5 * mesh.length_m()).abs();
    let nearer_m = aside_m(other) - aside_m(one);
    if nearer_m.abs() < SAME * mesh.length_m() {
        return vec![(one, other, 0.5), (other, one, 0.5)];
    }
    vec![if nearer_m > 0.0 { (one, other, 1.0) } else { (other, one, 1.0) }]
}

/// Whether two magnets have the same field, but for its sign.
fn equal(a: &Magnet, b: &Magnet) -> bool {
    a.is_alike(b) && a.remanence_t.abs() == b.remanence_t.abs()
}
