//! Rules of the third dimension: in the plane nothing stands beside it or turns out of it.

use super::super::error::Problem;
use super::super::schema::quantity;
use super::super::{Body, Motion, Scene};
use super::require;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    if scene.dimensions > 2 {
        return Ok(());
    }
    flat("start.z_m", scene.start.z_m, "m")?;
    flat("start.yaw_deg", scene.start.yaw_deg, "°")?;
    all_flat("start.bends_aside_deg", &scene.start.bends_aside_deg, "°")?;
    all_flat("start.twists_deg", &scene.start.twists_deg, "°")?;
    if let Body::Segments(body) = &scene.body {
        body.segment.iter().enumerate().try_for_each(|(place, segment)| {
            let magnet = segment.magnet.as_ref();
            let path = format!("body.segment[{place}].magnet");
            flat(&format!("{path}.aside_deg"), magnet.map_or(0.0, |m| m.aside_deg), "°")?;
            flat(&format!("{path}.aside_m"), magnet.map_or(0.0, |m| m.aside_m), "m")
        })?;
    }
    flat("field.z_t", scene.field.as_ref().map_or(0.0, |field| field.z_t), "T")?;
    scene.drive.as_ref().map_or(Ok(()), |drive| motion(&drive.motion))
}

fn motion(motion: &Motion) -> Result<(), Problem> {
    match motion {
        Motion::Controlled(limits) => {
            flat("drive.motion.lateral_reach_m", limits.lateral_reach_m, "m")?;
            flat("drive.motion.yaw_reach_deg", limits.yaw_reach_deg, "°")
        }
        Motion::Constant { z_m, yaw_deg, .. } => {
            flat("drive.motion.z_m", *z_m, "m")?;
            flat("drive.motion.yaw_deg", *yaw_deg, "°")
        }
        Motion::Waypoints { z_m, yaw_deg, .. } => {
            all_flat("drive.motion.z_m", z_m, "m")?;
            all_flat("drive.motion.yaw_deg", yaw_deg, "°")
        }
    }
}

fn all_flat(field: &str, values: &[f64], unit: &str) -> Result<(), Problem> {
    let mut places = values.iter().enumerate();
    places.try_for_each(|(place, value)| flat(&format!("{field}[{place}]"), *value, unit))
}

/// A problem of a field unless it is 0.
fn flat(field: &str, value: f64, unit: &str) -> Result<(), Problem> {
    require(value == 0.0, field, quantity(value, unit), || "0 where dimensions = 2".into())
}
