//! Angles with equal bits on every platform, for what a task decides.

use crate::errors::value_error;
use magworm::internals::lanes::math;
use numpy::ndarray::Zip;
use numpy::{IntoPyArray, PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::prelude::*;

type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

/// Sines and cosines of angles of up to 1000 rad in magnitude.
#[pyfunction]
pub fn sin_cos<'py>(
    py: Python<'py>,
    angle_rad: PyReadonlyArrayDyn<'py, f64>,
) -> (Array<'py>, Array<'py>) {
    let angle_rad = angle_rad.as_array();
    let sine = angle_rad.mapv(|angle| math::sin_cos(angle).0);
    let cosine = angle_rad.mapv(|angle| math::sin_cos(angle).1);
    (sine.into_pyarray(py), cosine.into_pyarray(py))
}

/// Angles of the vectors (x, y) from −π to π [rad].
#[pyfunction]
pub fn atan2<'py>(
    py: Python<'py>,
    y: PyReadonlyArrayDyn<'py, f64>,
    x: PyReadonlyArrayDyn<'py, f64>,
) -> PyResult<Array<'py>> {
    let (y, x) = (y.as_array(), x.as_array());
    if y.shape() != x.shape() {
        let (y, x) = (y.shape(), x.shape());
        return Err(value_error(format!("y has shape {y:?} and x {x:?}; expected one shape")));
    }
    Ok(Zip::from(&y).and(&x).map_collect(|&y, &x| math::atan2(y, x)).into_pyarray(py))
}
