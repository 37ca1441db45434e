//! Rules of the body and its magnets.

use super::super::error::Problem;
use super::super::schema::{number, quantity};
use super::super::{Body, Clamp, Magnet, Rod, Scene, Worm};
use super::{no_longer, require, rounded};

/// Shortest rod element [m]: shorter ones make the stiffness of a step too badly scaled to solve.
const SHORTEST_ELEMENT_M: f64 = 1e-5;
/// Shortest gap beside a magnet, less rounding [m].
const SHORTEST_GAP_M: f64 = SHORTEST_ELEMENT_M - 1e-9;
/// Lengths below this part of a foot or an element are none: 0.049 + 0.005 misses 0.054 by rounding.
const NOTHING: f64 = 1e-9;
/// Largest part of its section that a magnet may fill where the body ends with it: the last node
/// needs rubber for its mass.
const FULLEST_END: f64 = 1.0 - 1e-6;
/// Most nodes of a body.
const MOST_NODES: usize = 1000;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    match (&scene.body, &scene.magnet) {
        (Body::Worm(worm), Some(magnet)) => check_worm(worm, magnet),
        (Body::Rod(rod), magnet) if rod.magnets.is_empty() => check_rod(rod, magnet.as_ref()),
        (Body::Rod(rod), Some(magnet)) => check_rod(rod, Some(magnet)),
        (_, None) => Err(Problem::Missing {
            field: "magnet".into(),
            allowed: "a table that describes the magnets of the body".into(),
        }),
    }
}

fn check_worm(worm: &Worm, magnet: &Magnet) -> Result<(), Problem> {
    feet(worm)?;
    removed(worm)?;
    no_longer("magnet.length_m", magnet.length_m, "body.foot_length_m", worm.foot_length_m)?;
    no_longer("magnet.height_m", magnet.height_m, "body.foot_thickness_m", worm.foot_thickness_m)?;
    no_longer("magnet.width_m", magnet.width_m, "body.width_m", worm.width_m)?;
    worm_elements(worm, magnet)
}

fn feet(worm: &Worm) -> Result<(), Problem> {
    require(
        worm.foot_length_m < worm.pitch_m,
        "body.foot_length_m",
        quantity(worm.foot_length_m, "m"),
        || format!("less than body.pitch_m = {}", quantity(worm.pitch_m, "m")),
    )?;
    let (bridge_m, foot_m) = (worm.bridge_thickness_m, worm.foot_thickness_m);
    no_longer("body.bridge_thickness_m", bridge_m, "body.foot_thickness_m", foot_m)
}

fn removed(worm: &Worm) -> Result<(), Problem> {
    worm.removed.iter().enumerate().try_for_each(|(place, index)| {
        require(
            *index < worm.magnets && !worm.removed[..place].contains(index),
            format!("body.removed[{place}]"),
            index.to_string(),
            || format!("0 to {}, each at most once", worm.magnets - 1),
        )
    })
}

fn worm_elements(worm: &Worm, magnet: &Magnet) -> Result<(), Problem> {
    let (ends, bridges) = (worm.elements_per_foot_end, worm.elements_per_bridge);
    let end_m = 0.5 * (worm.foot_length_m - magnet.length_m);
    if end_m > NOTHING * worm.foot_length_m {
        elements_long_enough("body.elements_per_foot_end", ends, end_m)?;
    } else {
        rubber_at_the_end(magnet, worm.foot_thickness_m, worm.width_m)?;
    }
    elements_long_enough("body.elements_per_bridge", bridges, worm.pitch_m - worm.foot_length_m)?;
    let nodes = worm.magnets * (2 * ends + 1) + (worm.magnets - 1) * bridges + 1;
    require(nodes <= MOST_NODES, "body.elements_per_bridge", bridges.to_string(), || {
        format!("at most {MOST_NODES} nodes in the body, here {nodes}")
    })
}

fn rubber_at_the_end(magnet: &Magnet, thickness_m: f64, width_m: f64) -> Result<(), Problem> {
    let filled = magnet.height_m * magnet.width_m <= FULLEST_END * thickness_m * width_m;
    require(filled, "magnet.height_m", quantity(magnet.height_m, "m"), || {
        "less than the body's thickness where the body ends with a magnet as wide".into()
    })
}

fn elements_long_enough(field: &str, elements: usize, length_m: f64) -> Result<(), Problem> {
    let most = (length_m / SHORTEST_ELEMENT_M * (1.0 + 1e-9)).floor();
    require(elements as f64 <= most, field, elements.to_string(), || {
        let (length, shortest) =
            (quantity(rounded(length_m), "m"), quantity(SHORTEST_ELEMENT_M, "m"));
        format!("at most {most}, each {shortest} or longer, in a length of {length}")
    })
}

fn check_rod(rod: &Rod, magnet: Option<&Magnet>) -> Result<(), Problem> {
    elements_long_enough("body.elements", rod.elements, rod.length_m)?;
    let count = rod.magnets.len();
    // Each magnet is an element, and each stretch between magnets may round up to one more.
    let nodes = rod.elements + 1 + if count > 0 { 2 * count + 1 } else { 0 };
    require(nodes <= MOST_NODES, "body.elements", rod.elements.to_string(), || {
        format!("at most {MOST_NODES} nodes in the body, here up to {nodes}")
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
