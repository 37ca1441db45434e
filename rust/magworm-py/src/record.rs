//! Recordings for Python.

use crate::errors::value_error;
use crate::scene::Scene;
use magworm::Model;
use magworm::internals::{Recording, Watch, record};
use numpy::{IntoPyArray, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use std::sync::Arc;

type Array3<'py> = Bound<'py, PyArray3<f64>>;
type Arrays<'py> = (Array3<'py>, Array3<'py>, Array3<'py>, u8);

/// Runs each scene once and keeps what it saw: magnet poses, drive positions, nodes, status.
#[pyfunction]
#[pyo3(signature = (scenes, duration_s, sample_s, *, nodes = false, threads = None))]
pub fn record_scenes<'py>(
    py: Python<'py>,
    scenes: Vec<Bound<'py, Scene>>,
    duration_s: Vec<f64>,
    sample_s: f64,
    nodes: bool,
    threads: Option<usize>,
) -> PyResult<Vec<Arrays<'py>>> {
    if duration_s.len() != scenes.len() {
        return Err(value_error(format!(
            "duration_s has {} entries; expected one per scene, {}",
            duration_s.len(),
            scenes.len()
        )));
    }
    if threads == Some(0) || threads.is_some_and(|t| t > 4096) {
        return Err(value_error("threads is out of range; allowed: None, or 1 to 4096"));
    }
    let planned = scenes.iter().zip(duration_s).map(|(scene, duration_s)| {
        let model = scene.get().model.clone();
        let watch = watch(&model, duration_s, sample_s, nodes)?;
        Ok((model, watch))
    });
    let planned: Vec<(Arc<Model>, Watch)> = planned.collect::<PyResult<_>>()?;
    let recordings = py.detach(|| record(&planned, threads));
    let made = planned.iter().zip(recordings);
    made.map(|((model, watch), one)| arrays(py, model, *watch, one)).collect()
}

fn watch(model: &Model, duration_s: f64, sample_s: f64, nodes: bool) -> PyResult<Watch> {
    let steps = whole("sample_s", sample_s, model.step_s, "solver steps")?;
    let intervals = whole("duration_s", duration_s, sample_s, "sampling intervals")?;
    Ok(Watch { intervals, steps, nodes })
}

/// How many times `unit_s` goes into a time, which must be a whole number from 1 on.
fn whole(name: &str, time_s: f64, unit_s: f64, unit: &str) -> PyResult<u32> {
    let times = (time_s / unit_s).round();
    if (1.0..=f64::from(u32::MAX)).contains(&times) && (time_s / unit_s - times).abs() < 1e-6 {
        return Ok(times as u32);
    }
    Err(value_error(format!(
        "{name} is {time_s} s; allowed: a whole number of {unit} of {unit_s} s"
    )))
}

fn arrays<'py>(
    py: Python<'py>,
    model: &Model,
    watch: Watch,
    recording: Recording,
) -> PyResult<Arrays<'py>> {
    let instants = watch.intervals as usize + 1;
    let Recording { magnet_poses, drive, node_m, status } = recording;
    let (pose, place, axes) = if model.dimensions() == 2 { (3, 2, 2) } else { (7, 4, 3) };
    let shaped = |numbers: Vec<f64>, width: usize| {
        let each = numbers.len() / (instants * width);
        numbers.into_pyarray(py).reshape([instants, each, width])
    };
    Ok((shaped(magnet_poses, pose)?, shaped(drive, place)?, shaped(node_m, axes)?, status as u8))
}
