//! Arguments from Python: each is taken where nothing is lost, or refused by name with what is allowed.

use crate::errors::{scene_error, value_error};
use crate::scene::Scene;
use magworm::{Ensemble, LaneChoice};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// Most threads of a pool.
const THREADS: RangeInclusive<usize> = 1..=4096;

/// An argument of the wrong type.
pub fn type_error(name: &str, value: &Bound<'_, PyAny>, allowed: &str) -> PyErr {
    PyTypeError::new_err(format!("{name} is {}; allowed: {allowed}", shown(value)))
}

/// What stands in a message for a value: cut where it is long or deep.
pub fn shown(value: &Bound<'_, PyAny>) -> String {
    let short = || value.py().import("reprlib")?.call_method1("repr", (value,))?.extract();
    let text: PyResult<String> = short();
    text.unwrap_or_else(|_| format!("of type {}", type_name(value)))
}

/// Name of a value's type.
pub fn type_name(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "?".into(), |name| name.to_string())
}

/// A whole number, of Python or NumPy, within a range.
pub fn whole(
    name: &str,
    value: &Bound<'_, PyAny>,
    range: RangeInclusive<usize>,
) -> PyResult<usize> {
    let allowed = format!("a whole number from {} to {}", range.start(), range.end());
    let Ok(number) = index(value) else { return Err(type_error(name, value, &allowed)) };
    let inside = number.extract::<usize>().ok().filter(|number| range.contains(number));
    inside.ok_or_else(|| value_error(format!("{name} is {}; allowed: {allowed}", shown(value))))
}

/// `value` as an `int`, where it is a whole number: no flag, and no number with a fraction.
pub fn index<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    value.py().import("operator")?.call_method1("index", (value,))
}

/// Number of threads; none for all cores.
pub fn threads(value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<usize>> {
    value.map(|value| whole("threads", value, THREADS)).transpose()
}

/// How environments are laid out.
pub fn lanes(value: Option<&Bound<'_, PyAny>>) -> PyResult<LaneChoice> {
    word("lanes", value, [("wide", LaneChoice::Wide), ("scalar", LaneChoice::Scalar)])
}

/// A number.
pub fn number(name: &str, value: &Bound<'_, PyAny>, allowed: &str) -> PyResult<f64> {
    value.extract().map_err(|_| type_error(name, value, allowed))
}

/// `True` or `False`, which an argument that was left out is.
pub fn flag(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<bool> {
    let read = |value: &Bound<'_, PyAny>| {
        value.extract().map_err(|_| type_error(name, value, "True or False"))
    };
    value.map_or(Ok(false), read)
}

/// A text.
pub fn text(name: &str, value: &Bound<'_, PyAny>, allowed: &str) -> PyResult<String> {
    value.extract().map_err(|_| type_error(name, value, allowed))
}

/// What one of a few words stands for; the first where the argument was left out.
pub fn word<T: Copy, const N: usize>(
    name: &str,
    value: Option<&Bound<'_, PyAny>>,
    words: [(&str, T); N],
) -> PyResult<T> {
    let Some(value) = value else { return Ok(words[0].1) };
    let given: Option<String> = value.extract().ok();
    let found = words.iter().find(|(word, _)| given.as_deref() == Some(*word));
    found.map(|(_, meaning)| *meaning).ok_or_else(|| {
        let allowed = words.map(|(word, _)| format!("{word:?}"));
        value_error(format!("{name} is {}; allowed: {}", shown(value), allowed.join(", ")))
    })
}

/// Bytes.
pub fn bytes<'a>(name: &str, value: &'a Bound<'_, PyAny>) -> PyResult<Cow<'a, [u8]>> {
    value.extract().map_err(|_| type_error(name, value, "bytes, such as get_state returns"))
}

/// Scenes of one shape: one, or a list of some.
pub fn ensemble(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Ensemble> {
    if let Ok(one) = value.cast::<Scene>() {
        return Ok(one.get().model.clone().into());
    }
    let allowed = "a Scene, such as load_scene returns, or a list of scenes";
    // A text is iterable, too.
    let items = value.try_iter().ok().filter(|_| !value.is_instance_of::<PyString>());
    let items = items.ok_or_else(|| type_error(name, value, allowed))?;
    let model = |(k, item): (usize, PyResult<Bound<'_, PyAny>>)| {
        Ok(scene(&format!("{name}[{k}]"), &item?)?.get().model.clone())
    };
    let models = items.enumerate().map(model).collect::<PyResult<_>>()?;
    Ensemble::new(models).map_err(|error| scene_error(value.py(), &error))
}

/// A scene.
pub fn scene<'a, 'py>(name: &str, value: &'a Bound<'py, PyAny>) -> PyResult<&'a Bound<'py, Scene>> {
    value.cast().map_err(|_| type_error(name, value, "a Scene, such as load_scene returns"))
}
