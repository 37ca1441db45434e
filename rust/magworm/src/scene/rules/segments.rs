//! Rules of a body of segments: magnets fit into their segments, rubber holds them apart.

use super::super::error::Problem;
use super::super::fields::{MAX_MAGNETS, SHORTEST_ELEMENT_M};
use super::super::schema::{number, quantity};
use super::super::{Clamp, Segment, SegmentMagnet, Segments};
use super::elements::{FULLEST_END, MAX_NODES, elements_long_enough};
use super::{no_longer, require, rounded};

pub(super) fn check_segments(body: &Segments) -> Result<(), Problem> {
    let count = body.segment.len();
    require(count > 0, "body.segment", "a list of 0".into(), || "1 segment or more".into())?;
    body.segment.iter().enumerate().try_for_each(|(place, segment)| {
        let path = format!("body.segment[{place}]");
        match &segment.magnet {
            Some(magnet) => with_magnet(&path, segment, magnet),
            None => without_magnet(&path, segment),
        }
    })?;
    clamp(body)?;
    (1..count).try_for_each(|place| apart(body, place))?;
    rubber_at_both_ends(body)?;
    counts(body)
}

fn without_magnet(path: &str, segment: &Segment) -> Result<(), Problem> {
    require(!segment.foot, format!("{path}.foot"), "true".into(), || {
        "false without a magnet, which a foot's corners turn with".into()
    })?;
    elements_long_enough(&format!("{path}.elements"), segment.elements, segment.length_m)
}

fn with_magnet(path: &str, segment: &Segment, magnet: &SegmentMagnet) -> Result<(), Problem> {
    let fits = |edge: &str, edge_m, room: &str, room_m| {
        no_longer(&format!("{path}.magnet.{edge}"), edge_m, &format!("{path}.{room}"), room_m)
    };
    fits("length_m", magnet.length_m, "length_m", segment.length_m)?;
    fits("height_m", magnet.height_m, "thickness_m", segment.thickness_m)?;
    fits("width_m", magnet.width_m, "width_m", segment.width_m)?;
    let rooms = [
        ("along_m", magnet.along_m, segment.length_m - magnet.length_m),
        ("up_m", magnet.up_m, segment.thickness_m - magnet.height_m),
        ("aside_m", magnet.aside_m, segment.width_m - magnet.width_m),
    ];
    rooms.into_iter().try_for_each(|(axis, offset_m, room_m)| {
        within(&format!("{path}.magnet.{axis}"), offset_m, 0.5 * room_m)
    })?;
    let ends_m = segment.ends_m(magnet).into_iter().filter(|end_m| *end_m > 0.0);
    let field = format!("{path}.elements");
    ends_m.into_iter().try_for_each(|end_m| elements_long_enough(&field, segment.elements, end_m))
}

/// An offset that leaves a magnet in its segment, rounding aside.
fn within(field: &str, offset_m: f64, reach_m: f64) -> Result<(), Problem> {
    let holds = offset_m.abs() <= reach_m + 1e-9 * SHORTEST_ELEMENT_M;
    require(holds, field, quantity(offset_m, "m"), || {
        let reach = rounded(reach_m);
        format!("{} to {}, within its segment", number(-reach), quantity(reach, "m"))
    })
}

/// The clamp holds the first element: alone it would leave nothing to move, and a magnet must not begin within it.
fn clamp(body: &Segments) -> Result<(), Problem> {
    let Some(first) = body.segment.first().filter(|_| body.clamp == Clamp::Head) else {
        return Ok(());
    };
    let held = "where body.clamp is \"head\"";
    require(first.magnet.is_none(), "body.segment[0].magnet", "a table".into(), || {
        format!("none {held}")
    })?;
    require(first.elements > 1, "body.segment[0].elements", "1".into(), || {
        format!("2 or more {held}")
    })
}

/// Two magnets never share a node.
fn apart(body: &Segments, place: usize) -> Result<(), Problem> {
    let ends_m = |place: usize| {
        let segment = &body.segment[place];
        segment.magnet.as_ref().map(|magnet| segment.ends_m(magnet))
    };
    let (Some([_, before_m]), Some([behind_m, _])) = (ends_m(place - 1), ends_m(place)) else {
        return Ok(());
    };
    let magnet = body.segment[place].magnet.as_ref().map_or(0.0, |magnet| magnet.length_m);
    require(
        before_m > 0.0 || behind_m > 0.0,
        format!("body.segment[{place}].magnet.length_m"),
        quantity(magnet, "m"),
        || {
            format!(
                "less than its segment's length, or rubber between it and the magnet of body.segment[{}]",
                place - 1
            )
        },
    )
}

/// The last node at an end needs rubber for its mass.
fn rubber_at_both_ends(body: &Segments) -> Result<(), Problem> {
    let last = body.segment.len() - 1;
    [(0, 0), (last, 1)].into_iter().try_for_each(|(place, side)| {
        let segment = &body.segment[place];
        let Some(magnet) = &segment.magnet else { return Ok(()) };
        let section_m2 = segment.thickness_m * segment.width_m;
        let filled = magnet.height_m * magnet.width_m <= FULLEST_END * section_m2;
        let field = format!("body.segment[{place}].magnet.height_m");
        let holds = filled || segment.ends_m(magnet)[side] > 0.0;
        require(holds, field, quantity(magnet.height_m, "m"), || {
            "less than the segment's thickness where the body ends with a magnet as wide".into()
        })
    })
}

fn counts(body: &Segments) -> Result<(), Problem> {
    let magnets = body.segment.iter().filter(|segment| segment.magnet.is_some()).count();
    require(
        magnets <= MAX_MAGNETS as usize,
        "body.segment",
        format!("a list with {magnets} magnets"),
        || format!("at most {MAX_MAGNETS} magnets"),
    )?;
    let elements = |segment: &Segment| match &segment.magnet {
        Some(magnet) => {
            let ends = segment.ends_m(magnet).into_iter().filter(|end_m| *end_m > 0.0).count();
            1 + ends * segment.elements
        }
        None => segment.elements,
    };
    let nodes = 1 + body.segment.iter().map(elements).sum::<usize>();
    require(nodes <= MAX_NODES, "body.segment", format!("a list of {}", body.segment.len()), || {
        format!("at most {MAX_NODES} nodes in the body, here {nodes}")
    })
}
