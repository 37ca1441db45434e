//! Rules of the drive magnets and their motion.

use super::super::error::Problem;
use super::super::fields::{GREATEST_DRIVE_SPEED_M_S, GREATEST_DRIVE_YAW_SPEED_DEG_S};
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
        Motion::Waypoints { time_s, x_m, y_m, z_m, yaw_deg } => {
            let [x, y, z] = [("x_m", x_m), ("y_m", y_m), ("z_m", z_m)].map(|(name, at)| Axis {
                field: format!("drive.motion.{name}"),
                at,
                unit: "m",
                fastest: GREATEST_DRIVE_SPEED_M_S,
            });
            let yaw = Axis {
                field: "drive.motion.yaw_deg".into(),
                at: yaw_deg,
                unit: "°",
                fastest: GREATEST_DRIVE_YAW_SPEED_DEG_S,
            };
            waypoints(time_s, &[x, y], &[z, yaw])
        }
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

/// One axis of a drive that moves between waypoints.
struct Axis<'a> {
    /// Path of its field.
    field: String,
    /// Its place at each time [unit].
    at: &'a [f64],
    unit: &'static str,
    /// Greatest speed [unit/s].
    fastest: f64,
}

/// `spatial` axes may also have empty lists.
fn waypoints(time_s: &[f64], planar: &[Axis<'_>], spatial: &[Axis<'_>]) -> Result<(), Problem> {
    let first = time_s.first().map_or("an empty list".into(), |first| quantity(*first, "s"));
    require(time_s.first() == Some(&0.0), "drive.motion.time_s[0]", first, || "0 s".into())?;
    planar.iter().try_for_each(|axis| as_long(axis, time_s, ""))?;
    let written = spatial.iter().filter(|axis| !axis.at.is_empty());
    written.clone().try_for_each(|axis| as_long(axis, time_s, ", or an empty one"))?;
    for (place, pair) in time_s.windows(2).enumerate() {
        let (field, later) =
            (format!("drive.motion.time_s[{}]", place + 1), quantity(pair[1], "s"));
        require(pair[1] - pair[0] >= SHORTEST_MOVE_S, field, later, || {
            let earliest_s = pair[0] + SHORTEST_MOVE_S;
            format!("{} or more: times rise", quantity(rounded(earliest_s), "s"))
        })?;
    }
    planar.iter().chain(written).try_for_each(|axis| slow_enough(axis, time_s))
}

fn as_long(axis: &Axis<'_>, time_s: &[f64], or_else: &str) -> Result<(), Problem> {
    let length = axis.at.len();
    require(length == time_s.len(), axis.field.as_str(), format!("a list of {length}"), || {
        format!("a list of {}, as drive.motion.time_s{or_else}", time_s.len())
    })
}

fn slow_enough(axis: &Axis<'_>, time_s: &[f64]) -> Result<(), Problem> {
    let Axis { field, at, unit, fastest } = axis;
    for (place, (time, at)) in time_s.windows(2).zip(at.windows(2)).enumerate() {
        let reach = fastest * (time[1] - time[0]);
        require(
            (at[1] - at[0]).abs() <= reach,
            format!("{field}[{}]", place + 1),
            quantity(at[1], unit),
            || {
                let low = number(rounded(at[0] - reach));
                let high = quantity(rounded(at[0] + reach), unit);
                let fastest = quantity(*fastest, &format!("{unit}/s"));
                format!("{low} to {high}: at most {fastest}")
            },
        )?;
    }
    Ok(())
}
