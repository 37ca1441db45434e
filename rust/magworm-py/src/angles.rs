//! Angles with equal bits on every platform, for what a task decides.

use crate::arrays::array;
use crate::errors::value_error;
use magworm::internals::lanes::math;
use numpy::ndarray::Zip;
use numpy::{IntoPyArray, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

/// Sines and cosines of angles of up to 1000 rad in magnitude.
#[pyfunction]
pub fn sin_cos<'py>(angle_rad: &Bound<'py, PyAny>) -> PyResult<(Array<'py>, Array<'py>)> {
    let py = angle_rad.py();
    let angles = array::<f64>("angle_rad", angle_rad)?.try_readonly()?;
    let sine = angles.as_array().mapv(|angle| math::sin_cos(angle).0);
    let cosine = angles.as_array().mapv(|angle| math::sin_cos(angle).1);
    Ok((sine.into_pyarray(py), cosine.into_pyarray(py)))
}

/// Angles of the vectors (x, y) from −π to π [rad].
#[pyfunction]
pub fn atan2<'py>(y: &Bound<'py, PyAny>, x: &Bound<'py, PyAny>) -> PyResult<Array<'py>> {
    let py = y.py();
    let (y, x) = (array::<f64>("y", y)?.try_readonly()?, array::<f64>("x", x)?.try_readonly()?);
    let (y, x) = (y.as_array(), x.as_array());
    if y.shape() != x.shape() {
        let (y, x) = (y.shape(), x.shape());
        return Err(value_error(format!("y has shape {y:?} and x {x:?}; expected one shape")));
    }
    Ok(Zip::from(&y).and(&x).map_collect(|&y, &x| math::atan2(y, x)).into_pyarray(py))
}
