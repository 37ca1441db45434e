//! Random bodies with the magnets that fit into them.

use magworm::scene::*;

use super::dice::Dice;

/// A little more than the shortest element, so that rounding does not matter [m].
const ELEMENT_M: f64 = 1.01e-5;
const EDGE_M: (f64, f64) = (1e-4, 0.5);

pub fn body(dice: &mut Dice, most_nodes: usize) -> (Body, Option<Magnet>) {
    let most_nodes = most_nodes.clamp(6, 1000);
    if dice.coin() { worm(dice, most_nodes) } else { rod(dice, most_nodes) }
}

/// How many of `most` elements fit into a length.
fn fitting(length_m: f64, most: usize) -> usize {
    ((length_m / ELEMENT_M) as usize).clamp(1, most)
}

fn magnet(dice: &mut Dice, length_m: f64, thickness_m: f64, width_m: f64) -> Magnet {
    Magnet {
        length_m,
        width_m: dice.decades(EDGE_M.0, width_m),
        height_m: dice.decades(EDGE_M.0, thickness_m.max(EDGE_M.0)),
        remanence_t: dice.between(0.0, 10.0),
        density_kg_m3: dice.decades(1.0, 1e5),
    }
}

fn worm(dice: &mut Dice, most_nodes: usize) -> (Body, Option<Magnet>) {
    // A magnet brings at least two foot ends, itself and one bridge element: four nodes.
    let magnets = dice.whole(1, (most_nodes / 4).min(32));
    let pitch_m = dice.decades(1e-3, 1.0);
    let longest_foot_m = (pitch_m - ELEMENT_M).min(EDGE_M.1);
    let foot_length_m = dice.decades(EDGE_M.0 + 2.1 * ELEMENT_M, longest_foot_m);
    // A magnet may be as long as its foot.
    let longest_m = if dice.coin() { foot_length_m - 2.0 * ELEMENT_M } else { foot_length_m };
    let magnet_m = match dice.decades(EDGE_M.0, longest_m) {
        length_m if length_m > foot_length_m - 2.0 * ELEMENT_M => foot_length_m,
        length_m => length_m,
    };
    let end_m = 0.5 * (foot_length_m - magnet_m);
    let most_ends = (most_nodes - 2 * magnets) / (2 * magnets);
    let ends = dice.whole(1, fitting(end_m, most_ends));
    let left = most_nodes - 1 - magnets * (2 * ends + 1);
    let most_per_bridge = left.checked_div(magnets - 1).unwrap_or(999).max(1);
    let bridges = dice.whole(1, fitting(pitch_m - foot_length_m, most_per_bridge));
    let foot_thickness_m = dice.decades(1e-4, 0.03);
    let width_m = dice.decades(EDGE_M.0, EDGE_M.1);
    let worm = Worm {
        magnets,
        pitch_m,
        foot_length_m,
        foot_thickness_m,
        bridge_thickness_m: dice.decades(1e-4, foot_thickness_m),
        width_m,
        first_polarity: dice.polarity(),
        removed: (0..magnets).rev().filter(|_| dice.between(0.0, 1.0) > 0.7).collect(),
        elements_per_bridge: bridges,
        elements_per_foot_end: ends,
    };
    (Body::Worm(worm), Some(magnet(dice, magnet_m, foot_thickness_m, width_m)))
}

fn rod(dice: &mut Dice, most_nodes: usize) -> (Body, Option<Magnet>) {
    let clamp = dice.one_of(&[Clamp::None, Clamp::Head]);
    let length_m = dice.decades(1e-3, 10.0);
    let wanted = dice.whole(0, ((most_nodes - 3) / 3).min(32));
    let fewest = if clamp == Clamp::Head { 2 } else { 1 };
    let most_elements = fitting(length_m, most_nodes - 1 - 2 * wanted);
    let elements = dice.whole(fewest, most_elements.max(fewest));
    let (thickness_m, width_m) = (dice.decades(1e-4, 0.03), dice.decades(EDGE_M.0, EDGE_M.1));
    let first_m = if clamp == Clamp::Head { length_m / elements as f64 } else { 0.0 };
    let room_m = length_m - first_m;
    let shortest_slot_m = EDGE_M.0 + 2.1 * ELEMENT_M;
    let count = wanted.min((room_m / shortest_slot_m) as usize);
    let slot_m = room_m / count.max(1) as f64;
    let longest_m = (slot_m - 2.0 * ELEMENT_M).clamp(EDGE_M.0, EDGE_M.1);
    let magnet_m = dice.decades(EDGE_M.0, longest_m);
    let magnets = (0..count).map(|place| {
        let spare_m = (slot_m - magnet_m - 2.0 * ELEMENT_M).max(0.0);
        let ahead_m = ELEMENT_M + dice.between(0.0, spare_m) + 0.5 * magnet_m;
        let position_m = first_m + place as f64 * slot_m + ahead_m;
        RodMagnet { position_m, polarity: dice.polarity() }
    });
    let mut magnets: Vec<RodMagnet> = magnets.collect();
    if let (Some(last), true) = (magnets.last_mut(), dice.coin()) {
        last.position_m = length_m - 0.5 * magnet_m;
    }
    let needed = !magnets.is_empty() || dice.coin();
    let magnet = needed.then(|| magnet(dice, magnet_m, thickness_m, width_m));
    let rod = Rod { length_m, width_m, thickness_m, elements, clamp, magnets };
    (Body::Rod(rod), magnet)
}
