//! Recordings for Python.

use crate::arguments::{flag, number, scene, type_error};
use crate::arrays::{array, read, shaped};
use crate::errors::value_error;
use crate::interruption::interruptible;
use crate::memory::check_room;
use magworm::Model;
use magworm::internals::{Recording, Watch, record};
use numpy::{PyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use std::sync::Arc;

type Array3<'py> = Bound<'py, PyArray3<f64>>;
type Arrays<'py> = (Array3<'py>, Array3<'py>, Array3<'py>, u8);

/// Runs each scene once and keeps what it saw: magnet poses, drive positions, nodes, status.
#[pyfunction]
#[pyo3(
    signature = (scenes, duration_s, sample_s, *, nodes = None, threads = None),
    text_signature = "(scenes, duration_s, sample_s, *, nodes=False, threads=None)"
)]
pub fn record_scenes<'py>(
    scenes: &Bound<'py, PyAny>,
    duration_s: &Bound<'py, PyAny>,
    sample_s: &Bound<'py, PyAny>,
    nodes: Option<&Bound<'py, PyAny>>,
    threads: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<Arrays<'py>>> {
    let py = scenes.py();
    let models = models(scenes)?;
    let durations = durations(duration_s, models.len())?;
    let sample_s = number("sample_s", sample_s, "a time in seconds")?;
    let nodes = flag("nodes", nodes)?;
    let threads = crate::arguments::threads(threads)?;
    let planned = models.into_iter().zip(durations).map(|(model, duration_s)| {
        let watch = watch(&model, duration_s, sample_s, nodes)?;
        Ok((model, watch))
    });
    let planned: Vec<(Arc<Model>, Watch)> = planned.collect::<PyResult<_>>()?;
    let bytes = planned.iter().map(|(model, watch)| Recording::bytes(model, *watch));
    check_room("the recording", bytes.fold(0, usize::saturating_add))?;
    let recordings = interruptible(py, |interruption| record(&planned, threads, interruption))?;
    let made = planned.iter().zip(recordings);
    made.map(|((model, watch), one)| arrays(py, model, *watch, one)).collect()
}

fn models(scenes: &Bound<'_, PyAny>) -> PyResult<Vec<Arc<Model>>> {
    let items = scenes.try_iter().map_err(|_| type_error("scenes", scenes, "a list of scenes"))?;
    let model = |(k, item): (usize, PyResult<Bound<'_, PyAny>>)| {
        Ok(scene(&format!("scenes[{k}]"), &item?)?.get().model.clone())
    };
    items.enumerate().map(model).collect()
}

/// A time for each scene, from one for all or as many.
fn durations(duration_s: &Bound<'_, PyAny>, scenes: usize) -> PyResult<Vec<f64>> {
    let given = array::<f64>("duration_s", duration_s)?;
    if given.ndim() > 0 {
        return read("duration_s", &given, &[scenes]);
    }
    Ok(vec![number("duration_s", duration_s, "a time in seconds")?; scenes])
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
    let sizes = model.sizes();
    let table = |numbers: Vec<f64>, width: usize| {
        let each = numbers.len() / (instants * width);
        shaped(py, numbers, [instants, each, width])
    };
    let (poses, places) = (table(magnet_poses, sizes.pose())?, table(drive, sizes.stage)?);
    Ok((poses, places, table(node_m, sizes.axes)?, status as u8))
}
