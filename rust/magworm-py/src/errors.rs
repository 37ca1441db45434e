//! Errors of the simulator as Python exceptions.

use pyo3::exceptions::PyValueError;
use pyo3::{PyErr, create_exception};

create_exception!(
    magworm_gym._magworm,
    SceneError,
    PyValueError,
    "A scene that cannot be simulated: names the field, the value, the unit and what is allowed."
);

/// A scene error as a Python exception.
pub fn scene_error(error: magworm::scene::SceneError) -> PyErr {
    SceneError::new_err(error.to_string())
}

/// Any other error as a `ValueError`.
pub fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
