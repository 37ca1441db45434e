//! Random bodies with the magnets that fit into them.

use magworm::scene::*;

use super::dice::Dice;
use super::segments::segments;

/// A little more than the shortest element, so that rounding does not matter [m].
pub const ELEMENT_M: f64 = 1.01e-5;
/// Shortest and longest edge [m].
pub const EDGE_M: (f64, f64) = (1e-4, 0.5);

pub fn body(dice: &mut Dice, most_nodes: usize, dimensions: usize) -> (Body, Option<Magnet>) {
    let most_nodes = most_nodes.clamp(6, 1000);
    match dice.one_of(&[0, 1, 2]) {
        0 => worm(dice, most_nodes),
        1 => rod(dice, most_nodes),
        _ => (segments(dice, most_nodes, dimensions), None),
    }
}

/// How many of `most` elements fit into a length.
pub fn fitting(length_m: f64, most: usize) -> usize {
    ((length_m / ELEMENT_M) as usize).clamp(1, most)
}

/// A magnet that fits a section. Where the body ends with it, it leaves rubber at its sides.
fn magnet(dice: &mut Dice, length_m: f64, at_end: bool, section_m: (f64, f64)) -> Magnet {
    let widest_m = if at_end { 0.999 * section_m.1 } else { section_m.1 };
    Magnet {
        length_m,
        width_m: dice.decades(EDGE_M.0, widest_m),
        height_m: dice.decades(EDGE_M.0, section_m.0),
        remanence_t: dice.between(0.0, 10.0),
        density_kg_m3: dice.decades(1.0, 1e5),
    }
}

/// Thickness and width of a body.
pub fn section(dice: &mut Dice) -> (f64, f64) {
    (dice.decades(1e-4, 0.03), dice.decades(1.01 * EDGE_M.0, EDGE_M.1))
}

fn worm(dice: &mut Dice, most_nodes: usize) -> (Body, Option<Magnet>) {
    // A magnet brings at least two foot ends, itself and one bridge element: four nodes.
    let magnets = dice.whole(1, (most_nodes / 4).min(32));
    let pitch_m = dice.decades(1e-3, 1.0);
    let longest_foot_m = (pitch_m - ELEMENT_M).min(EDGE_M.1);
    let foot_length_m = dice.decades(EDGE_M.0 + 2.1 * ELEMENT_M, longest_foot_m);
    let with_ends_m = dice.decades(EDGE_M.0, foot_length_m - 2.0 * ELEMENT_M);
    let magnet_m = dice.one_of(&[with_ends_m, with_ends_m, with_ends_m, foot_length_m]);
    let most_ends = (most_nodes - 2 * magnets) / (2 * magnets);
    let ends = dice.whole(1, fitting(0.5 * (foot_length_m - magnet_m), most_ends));
    let left = most_nodes - 1 - magnets * (2 * ends + 1);
    let most_per_bridge = left.checked_div(magnets - 1).unwrap_or(999).max(1);
    let bridges = dice.whole(1, fitting(pitch_m - foot_length_m, most_per_bridge));
    let section_m = section(dice);
    let worm = Worm {
        magnets,
        pitch_m,
        foot_length_m,
        foot_thickness_m: section_m.0,
        bridge_thickness_m: dice.decades(1e-4, section_m.0),
        width_m: section_m.1,
        first_polarity: dice.polarity(),
        removed: (0..magnets).rev().filter(|_| dice.between(0.0, 1.0) > 0.7).collect(),
        elements_per_bridge: bridges,
        elements_per_foot_end: ends,
    };
    (Body::Worm(worm), Some(magnet(dice, magnet_m, magnet_m == foot_length_m, section_m)))
}

fn rod(dice: &mut Dice, most_nodes: usize) -> (Body, Option<Magnet>) {
    let clamp = dice.one_of(&[Clamp::None, Clamp::Head]);
    let length_m = dice.decades(1e-3, 10.0);
    let wanted = dice.whole(0, ((most_nodes - 4) / 3).min(32));
    let fewest = if clamp == Clamp::Head { 2 } else { 1 };
    let most_elements = fitting(length_m, most_nodes - 2 - 2 * wanted);
    let elements = dice.whole(fewest, most_elements.max(fewest));
    let first_m = if clamp == Clamp::Head { length_m / (elements as f64 - 0.5) } else { 0.0 };
    let (magnet_m, magnets) = rod_magnets(dice, first_m, length_m, wanted);
    let last_m = magnets.last().map(|last| last.position_m);
    let at_end = last_m == Some(length_m - 0.5 * magnet_m);
    let section_m = section(dice);
    let needed = !magnets.is_empty() || dice.coin();
    let magnet = needed.then(|| magnet(dice, magnet_m, at_end, section_m));
    let (thickness_m, width_m) = section_m;
    (Body::Rod(Rod { length_m, width_m, thickness_m, elements, clamp, magnets }), magnet)
}

/// At most `wanted` magnets, each in its slot between `first_m` and the end of the rod.
fn rod_magnets(
    dice: &mut Dice,
    first_m: f64,
    length_m: f64,
    wanted: usize,
) -> (f64, Vec<RodMagnet>) {
    let room_m = length_m - first_m;
    let count = wanted.min((room_m / (EDGE_M.0 + 2.1 * ELEMENT_M)) as usize);
    if count == 1 && first_m == 0.0 && length_m <= EDGE_M.1 && dice.coin() {
        let whole = RodMagnet { position_m: 0.5 * length_m, polarity: dice.polarity() };
        return (length_m, vec![whole]);
    }
    let slot_m = room_m / count.max(1) as f64;
    let magnet_m = dice.decades(EDGE_M.0, (slot_m - 2.0 * ELEMENT_M).clamp(EDGE_M.0, EDGE_M.1));
    let spare_m = (slot_m - magnet_m - 2.0 * ELEMENT_M).max(0.0);
    let placed = |(place, ahead_m): (usize, f64)| {
        first_m + place as f64 * slot_m + ELEMENT_M + ahead_m + 0.5 * magnet_m
    };
    let ahead_m: Vec<f64> = (0..count).map(|_| dice.between(0.0, spare_m)).collect();
    let mut magnets: Vec<RodMagnet> = ahead_m
        .into_iter()
        .enumerate()
        .map(|place| RodMagnet { position_m: placed(place), polarity: dice.polarity() })
        .collect();
    if let (Some(last), true) = (magnets.last_mut(), dice.coin()) {
        last.position_m = length_m - 0.5 * magnet_m;
    }
    (magnet_m, magnets)
}
