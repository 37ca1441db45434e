//! Rules between fields, checked once each field by itself is in range.

mod body;
mod contact;
mod drive;
mod elements;
mod rod;
mod segments;
mod space;
mod start;
mod time;

use super::Scene;
use super::error::Problem;
use super::schema::quantity;

/// Checks every rule.
pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    body::check(scene)?;
    surroundings(scene)?;
    contact::check(scene)?;
    drive::check(scene)?;
    space::check(scene)?;
    start::check(scene)?;
    time::check(scene)
}

fn surroundings(scene: &Scene) -> Result<(), Problem> {
    let Some(ground) = &scene.ground else { return Ok(()) };
    require(
        ground.dynamic_friction <= ground.static_friction,
        "ground.dynamic_friction",
        quantity(ground.dynamic_friction, ""),
        || format!("at most ground.static_friction = {}", quantity(ground.static_friction, "")),
    )?;
    require(
        scene.start.height_m >= 0.0,
        "start.height_m",
        quantity(scene.start.height_m, "m"),
        || "0 m or more where there is ground".into(),
    )
}

/// A problem of a field unless `holds`.
fn require(
    holds: bool,
    field: impl Into<String>,
    value: String,
    allowed: impl FnOnce() -> String,
) -> Result<(), Problem> {
    if holds {
        return Ok(());
    }
    Err(Problem::Value { field: field.into(), value, allowed: allowed() })
}

/// A problem of a length unless it is at most another field's.
fn no_longer(field: &str, length_m: f64, limit: &str, limit_m: f64) -> Result<(), Problem> {
    require(length_m <= limit_m, field, quantity(length_m, "m"), || {
        format!("at most {limit} = {}", quantity(limit_m, "m"))
    })
}

/// A sum or difference as a message shows it, without the digits that rounding brings in.
fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
