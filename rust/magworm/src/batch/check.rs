//! Whether a column of a snapshot is a state that a robot of this scene can have.

use super::column::Column;
use crate::model::{Allowed, GREATEST, Model, ROWS, Role, RowGroup};
use crate::scene::Parameter;

/// Most solver steps of a robot: more are not told apart as times in `f64`.
const MAX_STEPS: u64 = 1 << 53;
/// By how much a frame may miss unit lengths and right angles: far more than rounding does.
const SKEW: f64 = 1e-2;

/// A snapshot that does not fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SnapshotError {
    /// Not a snapshot, or cut short.
    #[error("state is not a MagWorm snapshot, or it was cut short ({0} bytes)")]
    Malformed(usize),
    /// Of an older version.
    #[error(
        "state has the layout {found}, which an older version of MagWorm saved; allowed: {expected}"
    )]
    Layout {
        /// In the snapshot.
        found: String,
        /// That of this version.
        expected: String,
    },
    /// Some of its bytes are not those that were saved.
    #[error("state is damaged: its checksum does not fit its {0} bytes")]
    Checksum(usize),
    /// Of another number of environments.
    #[error("state holds {found} environments; this batch has {expected}")]
    Count {
        /// In the snapshot.
        found: u64,
        /// In the batch.
        expected: u64,
    },
    /// Of another scene.
    #[error(
        "state of environment {environment} was saved from another scene than {name:?}, which it has here; compare the scenes' TOML"
    )]
    Scene {
        /// Which environment.
        environment: usize,
        /// Name of the scene that it has in the batch.
        name: String,
    },
    /// A number that no robot of this scene has.
    #[error("{row} of environment {environment} in the state is {value}; allowed: {allowed}")]
    Value {
        /// Name of the row.
        row: String,
        /// Which environment.
        environment: usize,
        /// What it holds.
        value: f64,
        /// What it may hold.
        allowed: String,
    },
}

/// Checks everything that a column of this scene holds.
///
/// # Errors
/// The first number that is not allowed.
pub(super) fn check(
    model: &Model,
    environment: usize,
    column: &Column<'_>,
) -> Result<(), SnapshotError> {
    let refuse = |row: String, value: f64, allowed: String| {
        Err(SnapshotError::Value { row, environment, value, allowed })
    };
    let numbers: Vec<f64> = column.state().collect();
    let mut rest = &numbers[..];
    for group in ROWS.iter().filter(|group| group.role == Role::State) {
        let (rows, others) = rest.split_at((group.rows)(model));
        rest = others;
        if let Some((place, allowed)) = misfit(group, rows) {
            return refuse(format!("{}[{place}]", group.name), rows[place], allowed);
        }
    }
    if column.step_count() > MAX_STEPS {
        let allowed = format!("0 to {MAX_STEPS}");
        return refuse("step_count".into(), column.step_count() as f64, allowed);
    }
    if column.status().is_none() {
        let allowed = "the code of a status".into();
        return refuse("status".into(), column.status_code() as f64, allowed);
    }
    if let Some((place, allowed)) = misfit_of_factors(&column.next_factors().collect::<Vec<_>>()) {
        let value = column.next_factors().nth(place).unwrap_or(f64::NAN);
        return refuse(format!("factors[{place}] for the next reset"), value, allowed);
    }
    if let Some((place, value)) = column.next_present().enumerate().find(|(_, word)| *word > 1) {
        return refuse(format!("present[{place}] for the next reset"), value as f64, "0, 1".into());
    }
    Ok(())
}

/// The first number of a group of rows that is not allowed, and what is.
fn misfit(group: &RowGroup, rows: &[f64]) -> Option<(usize, String)> {
    match group.allowed {
        Allowed::Range(low, high) => {
            let place = rows.iter().position(|value| !(low..=high).contains(value))?;
            Some((place, format!("{low} to {high}")))
        }
        Allowed::Whole(most) => {
            let whole = |value: &f64| (0..=most).any(|code| *value == f64::from(code));
            let place = rows.iter().position(|value| !whole(value))?;
            Some((place, format!("a whole number from 0 to {most}")))
        }
        Allowed::Factors => misfit_of_factors(rows),
        Allowed::Frames => {
            let frame = rows.chunks(6).position(|frame| !is_frame(frame))?;
            let allowed = "up direction and tangent of unit length at right angles";
            Some((6 * frame, allowed.into()))
        }
    }
}

fn misfit_of_factors(factors: &[f64]) -> Option<(usize, String)> {
    // A drive may move either way.
    let low = |parameter| if parameter == Parameter::DriveSpeed { -GREATEST } else { 0.0 };
    let lows = Model::PARAMETERS.map(low);
    let place = factors.iter().zip(lows).position(|(f, low)| !(low..=GREATEST).contains(f))?;
    Some((place, format!("{} to {GREATEST}", lows[place])))
}

fn is_frame(frame: &[f64]) -> bool {
    let (up, tangent) = frame.split_at(3);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let near = |value: f64, expected: f64| (value - expected).abs() <= SKEW;
    near(dot(up, up), 1.0) && near(dot(tangent, tangent), 1.0) && near(dot(up, tangent), 0.0)
}
