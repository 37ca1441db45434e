//! How far apart two cuboids are, by the axis that separates them most.
//!
//! Two convex polyhedra are disjoint exactly where the normal of a face or the product of two edges separates their
//! shadows (S. Gottschalk, M. C. Lin, D. Manocha, SIGGRAPH 1996): 15 axes for two cuboids. The greatest gap of these
//! shadows is at most the distance of the cuboids, and equal to it where a face is nearest; a negative one is the depth
//! by which they overlap.

use nalgebra::{Matrix3, Vector3};

/// The gap between a cuboid at the origin, its edges along the axes, and another one.
pub(super) struct Separation {
    /// Gap of the shadows [m], negative where the cuboids overlap.
    pub gap_m: f64,
    /// Unit vector along the axis of that gap.
    pub direction: Vector3<f64>,
}

impl Separation {
    /// `axes`: edges of the other cuboid as columns; `position_m`: its centre.
    pub fn new(
        size_m: Vector3<f64>,
        other_m: Vector3<f64>,
        position_m: Vector3<f64>,
        axes: &Matrix3<f64>,
    ) -> Self {
        let own = Matrix3::identity();
        let edges = |of: &Matrix3<f64>| [0, 1, 2].map(|k| of.column(k).into_owned());
        let faces = edges(&own).into_iter().chain(edges(axes));
        let pairs = edges(&own).into_iter().flat_map(|a| edges(axes).map(|b| a.cross(&b)));
        let gap = |direction: Vector3<f64>| {
            let reach = |of: &Matrix3<f64>, size: Vector3<f64>| {
                (of.transpose() * direction).abs().dot(&(0.5 * size))
            };
            let reaches = reach(&own, size_m) + reach(axes, other_m);
            Separation { gap_m: position_m.dot(&direction).abs() - reaches, direction }
        };
        // Parallel edges have no product; faces stand for it.
        let directions = faces.chain(pairs).filter_map(|direction| direction.try_normalize(1e-12));
        let nothing = Separation { gap_m: f64::NEG_INFINITY, direction: Vector3::z() };
        directions
            .map(gap)
            .fold(nothing, |best, next| if next.gap_m > best.gap_m { next } else { best })
    }
}
