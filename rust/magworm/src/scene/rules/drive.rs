//! Rules of the drive magnets and their motion.

use super::super::error::Problem;
use super::super::fields::GREATEST_DRIVE_SPEED_M_S;
use super::super::schema::{number, quantity};
use super::super::{Arrangement, Drive, Motion, Reference, Scene, StageLimits};
use super::{require, rounded};

/// Shortest time between waypoints [s].
const SHORTEST_MOVE_S: f64 = 1e-6;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    let Some(drive) = &scene.drive else { return Ok(()) };
    arrangement(drive)?;
    match &drive.motion {
        Motion::Controlled(limits) => stage(drive, limits),
        Motion::Constant { .. } => Ok(()),
        Motion::Waypoints { time_s, x_m, y_m } => waypoints(time_s, x_m, y_m),
    }
}

fn arrangement(drive: &Drive) -> Result<(), Problem> {
    let (field, distance_m) = match drive.arrangement {
        Arrangement::Single => return Ok(()),
        Arrangement::Pair { spacing_m, .. } => ("drive.arrangement.spacing_m", spacing_m),
        Arrangement::Belt { pitch_m, .. } => ("drive.arrangement.pitch_m", pitch_m),
    };
    require(distance_m >= drive.length_m, field, quantity(distance_m, "m"), || {
        format!("at least drive.length_m = {}", quantity(drive.length_m, "m"))
    })
}

fn stage(drive: &Drive, limits: &StageLimits) -> Result<(), Problem> {
    let StageLimits { lowest_m, highest_m, .. } = *limits;
    require(lowest_m < highest_m, "drive.motion.lowest_m", quantity(lowest_m, "m"), || {
        format!("less than drive.motion.highest_m = {}", quantity(highest_m, "m"))
    })?;
    let above_m = match drive.reference {
        Reference::Centre => 0.5 * drive.height_m,
        Reference::Top => 0.0,
    };
    require(highest_m + above_m < 0.0, "drive.motion.highest_m", quantity(highest_m, "m"), || {
        format!("less than {}: top faces stay beneath y = 0", quantity(-above_m, "m"))
    })
}

fn waypoints(time_s: &[f64], x_m: &[f64], y_m: &[f64]) -> Result<(), Problem> {
    let first = time_s.first().map_or("an empty list".into(), |first| quantity(*first, "s"));
    require(time_s.first() == Some(&0.0), "drive.motion.time_s[0]", first, || "0 s".into())?;
    for (field, length) in [("drive.motion.x_m", x_m.len()), ("drive.motion.y_m", y_m.len())] {
        require(length == time_s.len(), field, format!("a list of {length}"), || {
            format!("a list of {}, as drive.motion.time_s", time_s.len())
        })?;
    }
    for (place, pair) in time_s.windows(2).enumerate() {
        let (field, later) =
            (format!("drive.motion.time_s[{}]", place + 1), quantity(pair[1], "s"));
        require(pair[1] - pair[0] >= SHORTEST_MOVE_S, field, later, || {
            let earliest_s = pair[0] + SHORTEST_MOVE_S;
            format!("{} or more: times rise", quantity(rounded(earliest_s), "s"))
        })?;
    }
    slow_enough("drive.motion.x_m", time_s, x_m)?;
    slow_enough("drive.motion.y_m", time_s, y_m)
}

fn slow_enough(field: &str, time_s: &[f64], position_m: &[f64]) -> Result<(), Problem> {
    for (place, (time, position)) in time_s.windows(2).zip(position_m.windows(2)).enumerate() {
        let reach_m = GREATEST_DRIVE_SPEED_M_S * (time[1] - time[0]);
        require(
            (position[1] - position[0]).abs() <= reach_m,
            format!("{field}[{}]", place + 1),
            quantity(position[1], "m"),
            || {
                let low = number(rounded(position[0] - reach_m));
                let high = quantity(rounded(position[0] + reach_m), "m");
                format!("{low} to {high}: at most {GREATEST_DRIVE_SPEED_M_S} m/s")
            },
        )?;
    }
    Ok(())
}
