//! Points of a body that may touch a surface.

/// What a contact point or a surface moves with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// It stands still. Axes x, y, z.
    World,
    /// A magnet, with its rotation. Axes tangent, up, side.
    Body(usize),
    /// A node, without rotation. Axes x, y, z.
    Node(usize),
}

/// A point that may touch a surface.
///
/// Toe and heel of a foot belong to its magnet. On the light elements at the ends of the foot instead, a point with friction above
/// |e|/d would jam: pushing it back would press it down harder (Painlevé's paradox). Those of a rod belong to its nodes: rods
/// are thin, so that the turn of the section does not matter.
#[derive(Clone, Copy, Debug)]
pub struct ContactPoint {
    /// What it moves with.
    pub frame: Frame,
    /// Place from the origin of that frame along its axes [m].
    pub place_m: [f64; 3],
    /// Radius of the ball about this place that touches [m]: a rounded corner; 0: the place itself.
    pub radius_m: f64,
}

/// A foot: a box with rounded edges that moves with a body.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    /// The body.
    pub body: usize,
    /// Place of its middle along the body from the body's own [m].
    pub centre_m: f64,
    /// Half of its edges along tangent, up and side, less the radius [m].
    pub half_m: [f64; 3],
    /// Radius of its edges [m].
    pub radius_m: f64,
}

impl Foot {
    /// The same foot with edges rounded by a part of its shortest edge at least.
    pub fn rounded(self, part: f64, axes: usize) -> Self {
        let shortest_m = self.half_m[..axes].iter().copied().fold(f64::INFINITY, f64::min);
        let least_m = 2.0 * part * (shortest_m + self.radius_m);
        let more_m = (least_m - self.radius_m).max(0.0);
        let half_m = self.half_m.map(|half_m| half_m - more_m);
        Self { half_m, radius_m: self.radius_m + more_m, ..self }
    }

    /// Its corners below (−1) or above (1): one at each end in the plane, two in space; `across` in widths.
    pub fn corners(self, up: f64, across: &[f64]) -> impl Iterator<Item = ContactPoint> {
        let [length_m, height_m, width_m] = self.half_m;
        let ends_m = [-length_m, length_m].into_iter();
        let places =
            ends_m.flat_map(move |end_m| across.iter().map(move |across| (end_m, 2.0 * across)));
        places.map(move |(end_m, across)| ContactPoint {
            frame: Frame::Body(self.body),
            place_m: [end_m + self.centre_m, up * height_m, across * width_m],
            radius_m: self.radius_m,
        })
    }
}
