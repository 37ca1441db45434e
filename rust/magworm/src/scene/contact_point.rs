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
