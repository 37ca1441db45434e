//! How a body touches, beside the friction of what it touches.

use serde::{Deserialize, Serialize};

/// Where a body has points that may touch the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ContactPoints {
    /// At the corners of its feet; below every node where it has no feet.
    #[default]
    Feet,
    /// Below every node, by half of the body's thickness there: soft parts touch too. The soft unknowns then stay in the
    /// contact solve, which costs several times as much.
    Nodes,
}

/// Options of contact; each of them absent costs nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Contact {
    /// Where the points are.
    pub points: ContactPoints,
    /// Radius of the edges of feet, in space of their corners too [m]; 0: sharp.
    pub edge_radius_m: f64,
    /// Whether neighbouring feet touch each other: corners of each on the faces of the other, without friction, with
    /// edges rounded by a twentieth of the foot's shortest edge at least. A robot that folds stops there.
    pub between_feet: bool,
    /// Coefficient of restitution: a point that arrives leaves at this share of its speed; 0: impacts are inelastic, 1: elastic.
    pub restitution: f64,
    /// Slower points come to rest [m/s]; at least twice what gravity gives in a step.
    pub restitution_from_m_s: f64,
}

impl Default for Contact {
    fn default() -> Self {
        Self {
            points: ContactPoints::default(),
            edge_radius_m: 0.0,
            between_feet: false,
            restitution: 0.0,
            // A fall from 0.13 mm, a fiftieth of a preset's thickness: what falls from less need not be seen to rebound.
            restitution_from_m_s: 0.05,
        }
    }
}
