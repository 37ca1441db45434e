//! Python's values as TOML's.

use crate::arguments::{index, shown, type_error, type_name};
use crate::errors::value_error;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyFloat, PyMapping, PySequence, PyString};
use toml::{Table, Value};

/// Containers within containers; the deepest value of a scene has five.
const DEEPEST: usize = 16;

/// Changes of a scene by dotted path; `None` stays none.
pub fn changes(values: &Bound<'_, PyAny>) -> PyResult<Vec<(String, Option<Value>)>> {
    entries("values", values)?
        .into_iter()
        .map(|(path, value)| {
            let value = if value.is_none() { None } else { Some(toml(&path, &value, 0)?) };
            Ok((path, value))
        })
        .collect()
}

/// A value at a path, within so many containers.
fn toml(path: &str, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    if depth > DEEPEST {
        return Err(value_error(format!(
            "{path} stands in more than {DEEPEST} containers; no value of a scene does"
        )));
    }
    let value = &of_python(value)?;
    if let Ok(flag) = value.extract() {
        Ok(Value::Boolean(flag))
    } else if value.is_instance_of::<PyFloat>() {
        value.extract().map(Value::Float)
    } else if let Ok(whole) = index(value) {
        whole.extract().map(Value::Integer).map_err(|_| {
            let shown = shown(value);
            value_error(format!("{path} is {shown}; allowed: whole numbers of 64 bits"))
        })
    } else if value.is_instance_of::<PyString>() {
        value.extract().map(Value::String).map_err(|_| {
            value_error(format!("{path} is {}; allowed: text that UTF-8 can hold", shown(value)))
        })
    } else if value.cast::<PyMapping>().is_ok() {
        table(path, value, depth).map(Value::Table)
    } else if value.cast::<PySequence>().is_ok() && !value.is_instance_of::<PyBytes>() {
        list(path, value, depth).map(Value::Array)
    } else if let Ok(number) = value.extract() {
        Ok(Value::Float(number))
    } else {
        let kind = type_name(value);
        let allowed = "bool, int, float, str, list, dict, arrays of them, None";
        Err(value_error(format!("{path} is of type {kind}; allowed: {allowed}")))
    }
}

/// NumPy's scalars and arrays as Python's numbers and lists.
fn of_python<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let numpy = value.py().import("numpy")?;
    let kinds = (numpy.getattr("generic")?, numpy.getattr("ndarray")?);
    if value.is_instance(kinds.into_pyobject(value.py())?.as_any())? {
        value.call_method0("tolist")
    } else {
        Ok(value.clone())
    }
}

fn table(path: &str, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Table> {
    let entries = entries(path, value)?.into_iter().map(|(key, value)| {
        let inner = required(&format!("{path}.{key}"), &value, depth)?;
        Ok((key, inner))
    });
    entries.collect()
}

fn list(path: &str, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Vec<Value>> {
    let items = value.try_iter()?.enumerate();
    items.map(|(k, item)| required(&format!("{path}[{k}]"), &item?, depth)).collect()
}

/// A value within a container, where `None` has no meaning.
fn required(path: &str, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    if value.is_none() {
        return Err(value_error(format!("{path} is None; leave it out")));
    }
    toml(path, value, depth + 1)
}

/// Keys and values of a mapping whose keys are text.
fn entries<'py>(
    path: &str,
    mapping: &Bound<'py, PyAny>,
) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    let allowed = "a mapping, such as {\"ground.static_friction\": 0.9}";
    let items =
        mapping.cast::<PyMapping>().map_err(|_| type_error(path, mapping, allowed))?.items()?;
    let entry = |item: Bound<'py, PyAny>| {
        let (key, value) = item.extract::<(Bound<'py, PyAny>, Bound<'py, PyAny>)>()?;
        let key =
            key.extract().map_err(|_| type_error(&format!("a key of {path}"), &key, "text"))?;
        Ok((key, value))
    };
    items.iter().map(entry).collect()
}
