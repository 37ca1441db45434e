//! Arguments of `Batch.reset`: which environments start where.

use crate::arrays::read;
use crate::errors::value_error;
use magworm::{Batch, Start, StartPose};
use pyo3::prelude::*;

/// Columns of a start pose: name, greatest magnitude, unit.
type Limit = (&'static str, f64, &'static str);

const LIMITS: [Limit; 5] = [
    ("x", 1e3, "m"),
    ("height", 10.0, "m"),
    ("angle", 1e3, "rad"),
    ("z", 1e3, "m"),
    ("yaw", 1e3, "rad"),
];

/// What each environment starts with; none for those that go on.
pub fn starts(
    batch: &Batch,
    mask: &Bound<'_, PyAny>,
    seeds: &Bound<'_, PyAny>,
    episodes: &Bound<'_, PyAny>,
    poses: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<Option<Start>>> {
    let count = batch.count();
    let limits = if batch.model().dimensions() == 2 { &LIMITS[..3] } else { &LIMITS };
    let mask = read::<bool>("mask", mask, &[count])?;
    let seeds = read::<u64>("seeds", seeds, &[count])?;
    let episodes = read::<u64>("episodes", episodes, &[count])?;
    let poses =
        poses.map(|poses| read::<f64>("start", poses, &[count, limits.len()])).transpose()?;
    let pose = |environment: usize| {
        let row = &poses.as_deref()?[limits.len() * environment..][..limits.len()];
        let scenes = row.iter().all(|value| value.is_nan());
        (!scenes).then(|| pose(environment, row, limits))
    };
    let start = |environment: usize| {
        let pose = pose(environment).transpose()?;
        Ok(Start { seed: seeds[environment], episode: episodes[environment], pose })
    };
    (0..count)
        .map(|environment| mask[environment].then(|| start(environment)).transpose())
        .collect()
}

/// A pose must be finite and near.
fn pose(environment: usize, row: &[f64], limits: &[Limit]) -> PyResult<StartPose> {
    for (value, (name, most, unit)) in row.iter().zip(limits) {
        if value.is_nan() || value.abs() > *most {
            return Err(value_error(format!(
                "start {name} of environment {environment} is {value} {unit}; allowed: -{most} to {most} {unit}"
            )));
        }
    }
    let (z_m, yaw_rad) = if let [.., z, yaw] = row[3..] { (z, yaw) } else { (0.0, 0.0) };
    Ok(StartPose { x_m: row[0], height_m: row[1], angle_rad: row[2], z_m, yaw_rad })
}
