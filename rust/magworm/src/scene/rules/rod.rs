//! Rules of a rod and the magnets in it.

use super::super::error::Problem;
use super::super::fields::SHORTEST_ELEMENT_M;
use super::super::schema::{number, quantity};
use super::super::segments::NOTHING;
use super::super::{Clamp, Magnet, Rod};
use super::elements::{MAX_NODES, elements_long_enough, rubber_at_the_end};
use super::{no_longer, require, rounded};

/// Shortest gap beside a magnet, less rounding [m].
const SHORTEST_GAP_M: f64 = SHORTEST_ELEMENT_M - 1e-9;

pub(super) fn check_rod(rod: &Rod, magnet: Option<&Magnet>) -> Result<(), Problem> {
    elements_long_enough("body.elements", rod.elements, rod.length_m)?;
    let count = rod.magnets.len();
    // Each magnet is an element, and each stretch between magnets may round up to one more.
    let nodes = rod.elements + 1 + if count > 0 { 2 * count + 1 } else { 0 };
    require(nodes <= MAX_NODES, "body.elements", rod.elements.to_string(), || {
        format!("at most {MAX_NODES} nodes in the body, here up to {nodes}")
    })?;
    // The clamp holds the first element: alone it would leave nothing to move.
    require(rod.clamp == Clamp::None || rod.elements > 1, "body.elements", "1".into(), || {
        "2 or more where body.clamp is \"head\"".into()
    })?;
    match magnet {
        Some(magnet) if count > 0 => rod_magnets(rod, magnet),
        _ => Ok(()),
    }
}

fn rod_magnets(rod: &Rod, magnet: &Magnet) -> Result<(), Problem> {
    no_longer("magnet.height_m", magnet.height_m, "body.thickness_m", rod.thickness_m)?;
    no_longer("magnet.width_m", magnet.width_m, "body.width_m", rod.width_m)?;
    let half_m = 0.5 * magnet.length_m;
    rod.magnets.iter().enumerate().try_for_each(|(place, one)| {
        let head = room(rod, one.position_m - half_m - clamped_m(rod));
        let tail = room(rod, rod.length_m - one.position_m - half_m);
        let apart = rod.magnets[..place].last().is_none_or(|before| {
            one.position_m - before.position_m - magnet.length_m >= SHORTEST_GAP_M
        });
        // Right behind a clamped element there is no room: the clamp would hold the magnet too.
        let inside = tail != Room::Short && (head == Room::Enough || may_end_at_head(rod, &head));
        let field = format!("body.magnets[{place}].position_m");
        require(inside && apart, field, quantity(one.position_m, "m"), || allowed(rod, half_m))?;
        if head == Room::None || tail == Room::None {
            rubber_at_the_end(magnet, rod.thickness_m, rod.width_m)?;
        }
        Ok(())
    })
}

/// What lies between a magnet and an end of the rod.
#[derive(PartialEq)]
enum Room {
    /// Nothing: they end together.
    None,
    /// Too little for an element, or less than nothing.
    Short,
    /// An element or more.
    Enough,
}

fn room(rod: &Rod, gap_m: f64) -> Room {
    let nothing_m = NOTHING * rod.length_m / rod.elements as f64;
    match gap_m {
        gap_m if gap_m.abs() <= nothing_m => Room::None,
        gap_m if gap_m >= SHORTEST_GAP_M => Room::Enough,
        _ => Room::Short,
    }
}

fn may_end_at_head(rod: &Rod, head: &Room) -> bool {
    rod.clamp == Clamp::None && *head == Room::None
}

/// Length that a clamp takes at the head: the mesh starts half an element behind the wall, and the
/// magnet needs a free node after the first, clamped element.
fn clamped_m(rod: &Rod) -> f64 {
    match rod.clamp {
        Clamp::None => 0.0,
        Clamp::Head => rod.length_m / (rod.elements as f64 - 0.5),
    }
}

fn allowed(rod: &Rod, half_m: f64) -> String {
    let (clamp, first_m) = match rod.clamp {
        Clamp::None => ("", 0.0),
        Clamp::Head => (", behind the clamped element", clamped_m(rod) + SHORTEST_ELEMENT_M),
    };
    let low = number(rounded(first_m + half_m));
    let high = quantity(rounded(rod.length_m - half_m), "m");
    let gap = quantity(SHORTEST_ELEMENT_M, "m");
    format!("{low} to {high}{clamp}, from head to tail with gaps of {gap} or more")
}
