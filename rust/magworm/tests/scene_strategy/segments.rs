//! Random bodies of segments: any order of rubber and magnets of any size, with rubber between two magnets.

use magworm::scene::*;

use super::body::{EDGE_M, ELEMENT_M, fitting, section};
use super::dice::Dice;

/// Numbers that [`segments`] reads at most.
pub const NUMBERS: usize = 8 * 16;
const MAX_SEGMENTS: usize = 8;

pub fn segments(dice: &mut Dice, most_nodes: usize, dimensions: usize) -> Body {
    let count = dice.whole(1, (most_nodes / 3).min(MAX_SEGMENTS));
    // A segment with a magnet has as many elements on each side of it.
    let most_elements = ((most_nodes - 1) / count - 1) / 2;
    let mut segment: Vec<Segment> = Vec::new();
    for _ in 0..count {
        let at_magnet = segment.last().is_none_or(|before| before.magnet.is_some());
        segment.push(one(dice, most_elements.max(1), at_magnet, dimensions));
    }
    let may_clamp = segment[0].magnet.is_none() && segment[0].elements > 1;
    let clamp = if may_clamp && dice.coin() { Clamp::Head } else { Clamp::None };
    Body::Segments(Segments { clamp, segment })
}

/// A segment; behind a magnet, and at the head, it begins with rubber.
fn one(
    dice: &mut Dice,
    most_elements: usize,
    begins_with_rubber: bool,
    dimensions: usize,
) -> Segment {
    let (thickness_m, width_m) = section(dice);
    let mut segment = Segment {
        length_m: dice.decades(1e-3, EDGE_M.1),
        thickness_m,
        width_m,
        foot: false,
        elements: 1,
        magnet: None,
    };
    let mut room_m = segment.length_m;
    if dice.coin() {
        let full = !begins_with_rubber && dice.coin();
        let magnet = magnet(dice, &segment, full, dimensions);
        segment.foot = dice.coin();
        if !full {
            room_m = 0.5 * (segment.length_m - magnet.length_m) - magnet.along_m.abs();
        }
        segment.magnet = Some(magnet);
    }
    segment.elements = dice.whole(1, fitting(room_m, most_elements));
    segment
}

/// A magnet that fits into a segment and leaves rubber at its sides; and before and behind it, unless it is `full`.
fn magnet(dice: &mut Dice, segment: &Segment, full: bool, dimensions: usize) -> SegmentMagnet {
    let longest_m = segment.length_m - 2.0 * ELEMENT_M;
    let length_m = if full { segment.length_m } else { dice.decades(EDGE_M.0, longest_m) };
    let reach_m = (0.5 * (segment.length_m - length_m) - ELEMENT_M).max(0.0);
    let along_m = if dice.coin() { 0.0 } else { dice.between(-reach_m, reach_m) };
    let width_m = dice.decades(EDGE_M.0, 0.999 * segment.width_m);
    let height_m = dice.decades(EDGE_M.0, segment.thickness_m);
    let beside = dice.one_of(&[0.0, 0.0, 0.5]);
    let up_m = beside * (segment.thickness_m - height_m);
    let aside_m = beside * (segment.width_m - width_m);
    SegmentMagnet {
        length_m,
        width_m,
        height_m,
        remanence_t: dice.between(0.0, 10.0),
        density_kg_m3: dice.decades(1.0, 1e5),
        angle_deg: if dice.coin() {
            dice.one_of(&[0.0, 90.0, 180.0])
        } else {
            dice.between(-360.0, 360.0)
        },
        aside_deg: dice.in_space(dimensions, -90.0, 90.0),
        along_m,
        up_m: dice.between(-up_m, up_m),
        aside_m: dice.in_space(dimensions, -aside_m, aside_m),
        present: dice.between(0.0, 1.0) < 0.8,
    }
}
