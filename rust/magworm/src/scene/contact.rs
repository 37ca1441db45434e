//! How a body touches, beside the friction of what it touches.

use serde::{Deserialize, Serialize};

/// Options of contact; each of them absent costs nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Contact {
    /// Radius of the edges of feet, in space of their corners too [m]; 0: sharp.
    pub edge_radius_m: f64,
    /// Whether neighbouring feet touch each other: corners of each on the faces of the other, without friction. A robot that
    /// folds stops there.
    pub between_feet: bool,
}
