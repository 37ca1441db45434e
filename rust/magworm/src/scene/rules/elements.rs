//! Rules of elements and nodes that all bodies share.

use super::super::Magnet;
use super::super::error::Problem;
use super::super::fields::SHORTEST_ELEMENT_M;
use super::super::schema::quantity;
use super::{require, rounded};

/// Largest part of its section that a magnet may fill where the body ends with it: the last node
/// needs rubber for its mass.
pub(super) const FULLEST_END: f64 = 1.0 - 1e-6;
/// Most nodes of a body.
pub(super) const MAX_NODES: usize = 1000;

/// A magnet that the body ends with leaves rubber beside it.
pub(super) fn rubber_at_the_end(
    magnet: &Magnet,
    thickness_m: f64,
    width_m: f64,
) -> Result<(), Problem> {
    let filled = magnet.height_m * magnet.width_m <= FULLEST_END * thickness_m * width_m;
    require(filled, "magnet.height_m", quantity(magnet.height_m, "m"), || {
        "less than the body's thickness where the body ends with a magnet as wide".into()
    })
}

/// A length in so many elements.
pub(super) fn elements_long_enough(
    field: &str,
    elements: usize,
    length_m: f64,
) -> Result<(), Problem> {
    let most = (length_m / SHORTEST_ELEMENT_M * (1.0 + 1e-9)).floor();
    require(elements as f64 <= most, field, elements.to_string(), || {
        let (length, shortest) =
            (quantity(rounded(length_m), "m"), quantity(SHORTEST_ELEMENT_M, "m"));
        format!("at most {most}, each {shortest} or longer, in a length of {length}")
    })
}
