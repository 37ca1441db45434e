//! NumPy arrays in and out.

use numpy::{Element, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::PyResult;

use crate::errors::value_error;

/// The numbers of an array of exactly this shape, in C order.
pub fn read<T: Element + Copy>(
    name: &str,
    array: &PyReadonlyArrayDyn<'_, T>,
    shape: &[usize],
) -> PyResult<Vec<T>> {
    if array.shape() != shape {
        return Err(value_error(format!(
            "{name} has shape {:?}; expected {shape:?}",
            array.shape()
        )));
    }
    Ok(array.as_array().iter().copied().collect())
}
