//! Errors of the simulator as Python exceptions.

use magworm::scene;
use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::sync::TryLockError;

create_exception!(
    magworm_gym._magworm,
    SceneError,
    PyValueError,
    "A scene that cannot be simulated: names the field, the value, the unit and what is allowed.\n\n\
     `field` is the dotted path of the field and `line` the line of the TOML text, from 1; None where there is none."
);

/// Gives the class what its instances have where a scene error says nothing of it.
pub fn declare_scene_error(py: Python<'_>) -> PyResult<()> {
    let class = py.get_type::<SceneError>();
    class.setattr("field", py.None())?;
    class.setattr("line", py.None())
}

/// A scene error as a Python exception.
pub fn scene_error(py: Python<'_>, error: &scene::SceneError) -> PyErr {
    let raised = SceneError::new_err(error.to_string());
    let value = raised.value(py);
    // The attributes stand in the instance, whose dictionary a pickle keeps.
    let told = value
        .setattr("field", error.problem.field())
        .and_then(|()| value.setattr("line", error.line));
    told.err().unwrap_or(raised)
}

/// Any other error as a `ValueError`.
pub fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// An object whose lock was not to be had, for another thread or a handler of signals uses it.
pub fn in_use<T>(name: &str, error: &TryLockError<T>) -> PyErr {
    PyRuntimeError::new_err(match error {
        TryLockError::WouldBlock => {
            format!("{name} is in use by another call; allowed: one call that changes it at a time")
        }
        TryLockError::Poisoned(_) => {
            format!("{name} was left unfinished by an error of the simulator; make a new one")
        }
    })
}
