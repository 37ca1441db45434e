//! Batches out of pickles.

use crate::arguments::{self, ensemble};
use crate::arrays::indices;
use crate::batch::Batch;
use crate::errors::value_error;
use crate::interruption::interruptible;
use crate::memory::check_room;
use magworm::internals::Pool;
use pyo3::prelude::*;

/// Makes a batch again from what `Batch.__reduce__` kept.
#[pyfunction]
#[pyo3(signature = (scenes, scene_indices, lanes, threads, state))]
pub fn _rebuild_batch(
    scenes: &Bound<'_, PyAny>,
    scene_indices: &Bound<'_, PyAny>,
    lanes: &Bound<'_, PyAny>,
    threads: Option<&Bound<'_, PyAny>>,
    state: &Bound<'_, PyAny>,
) -> PyResult<Batch> {
    let ensemble = ensemble("scenes", scenes)?;
    let count = ensemble.models().len();
    let known = |index| usize::try_from(index).ok().filter(|&index| index < count);
    let given = indices("scene_indices", scene_indices)?.into_iter().map(known);
    let given: Vec<usize> = given.collect::<Option<_>>().ok_or_else(|| {
        value_error(format!(
            "scene_indices names a scene that is not there; allowed: 0 to {}",
            count - 1
        ))
    })?;
    let (lanes, threads) = (arguments::lanes(Some(lanes))?, arguments::threads(threads)?);
    let pool = state.py().detach(|| Pool::started(threads));
    let bytes = magworm::Batch::bytes(&ensemble, given.len(), lanes);
    check_room(&format!("a batch of {}", given.len()), bytes)?;
    let batch = interruptible(state.py(), |interruption| {
        magworm::Batch::assigned_unless(interruption, ensemble, &given, lanes, pool)
    })?;
    let batch = Batch::around(batch, threads);
    batch.set_state(state)?;
    Ok(batch)
}
