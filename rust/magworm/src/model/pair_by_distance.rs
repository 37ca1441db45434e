//! What two magnets are at each distance: cuboids, with more points the nearer they are, then dipoles.

use super::{Magnet, PairModel};
use crate::magnetic::{FarPair, orders_by_distance};
use crate::scene::{MagnetModel, Scene};

/// The models of two magnets, by the distance of their centres.
#[derive(Clone, Debug)]
pub struct PairByDistance {
    /// Cuboids, from the furthest to the nearest.
    pub near: Vec<NearPair>,
    /// Dipoles, beyond these.
    pub far: FarPair,
    /// Square of the distance from which on they are dipoles [m²].
    pub far_m2: f64,
}

/// Two cuboids in a range of distances.
#[derive(Clone, Debug)]
pub struct NearPair {
    /// Squares of the least distance and of the one that is beyond the range [m²].
    pub range_m2: [f64; 2],
    /// Points along each edge of a charged face.
    pub order: usize,
    /// Their model.
    pub model: PairModel,
}

impl PairByDistance {
    /// Source and target; dipoles where their force is off by at most `error_n`, whatever their directions.
    pub(super) fn new(scene: &Scene, [source, target]: [&Magnet; 2], error_n: f64) -> Self {
        let units = [source.unit(), target.unit()];
        let far = FarPair::new(&units[0], &units[1]);
        let strength_t2 = (source.remanence_t * target.remanence_t).abs();
        let error_n_at = |m: f64| strength_t2 * far.error_n_t2(&units[0], &units[1], m);
        let far_m = match scene.solver.magnet_model {
            MagnetModel::Cuboid => {
                // No two places of both can touch from there on.
                let apart_m = 0.5 * (units[0].size_m.norm() + units[1].size_m.norm());
                first_m(apart_m, |m| error_n_at(m) <= error_n)
            }
            MagnetModel::Dipole => 0.0,
        };
        let (mut near, mut beyond_m) = (Vec::new(), far_m);
        for (order, from_m) in orders_by_distance(&units[0], &units[1]) {
            if from_m < beyond_m {
                let range_m2 = [from_m * from_m, beyond_m * beyond_m];
                let model = PairModel::cuboids(scene, source, target, order);
                near.push(NearPair { range_m2, order, model });
                beyond_m = from_m;
            }
        }
        Self { near, far, far_m2: far_m * far_m }
    }

    /// The order of cuboids at a distance; none where they are dipoles.
    pub fn order(&self, distance_m: f64) -> Option<usize> {
        let square_m2 = distance_m * distance_m;
        let here = |near: &&NearPair| (near.range_m2[0]..near.range_m2[1]).contains(&square_m2);
        self.near.iter().find(here).map(|near| near.order)
    }
}

/// The first distance from `least_m` to a thousand times that on from which something holds.
fn first_m(least_m: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low_m, mut high_m) = (least_m, 1e3 * least_m);
    for _ in 0..60 {
        let middle_m = 0.5 * (low_m + high_m);
        if holds(middle_m) { high_m = middle_m } else { low_m = middle_m }
    }
    high_m
}
