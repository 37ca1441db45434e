//! Rules of the body and its magnets: feet and bridges.

use super::super::error::Problem;
use super::super::schema::quantity;
use super::super::segments::NOTHING;
use super::super::{Body, Magnet, Scene, Worm};
use super::elements::{MAX_NODES, elements_long_enough, rubber_at_the_end};
use super::rod::check_rod;
use super::segments::check_segments;
use super::{no_longer, require};

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    match (&scene.body, &scene.magnet) {
        (Body::Worm(worm), Some(magnet)) => check_worm(worm, magnet),
        (Body::Rod(rod), magnet) if rod.magnets.is_empty() => check_rod(rod, magnet.as_ref()),
        (Body::Rod(rod), Some(magnet)) => check_rod(rod, Some(magnet)),
        (Body::Segments(body), None) => check_segments(body),
        (Body::Segments(_), Some(_)) => Err(Problem::Value {
            field: "magnet".into(),
            value: "a table".into(),
            allowed: "none where body.kind is \"segments\", which hold their own magnets".into(),
        }),
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
    require(nodes <= MAX_NODES, "body.elements_per_bridge", bridges.to_string(), || {
        format!("at most {MAX_NODES} nodes in the body, here {nodes}")
    })
}
