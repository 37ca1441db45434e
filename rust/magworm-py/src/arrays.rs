//! NumPy arrays in and out.

use crate::arguments::{shown, type_error};
use crate::errors::value_error;
use crate::memory;
use numpy::{
    Element, IntoPyArray, PyArray, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;

/// Loads NumPy's interface now: where Ctrl-C interrupts that in a later call, it ends in a panic.
pub fn load_numpy(py: Python<'_>) -> PyResult<()> {
    py.import("numpy")?;
    PyArrayDyn::<f64>::zeros(py, [0].as_slice(), false).try_readonly()?;
    Ok(())
}

/// What an array may hold: of other types, what converts without loss.
pub trait Entry: Element + Copy + Default {
    /// For messages.
    const ALLOWED: &'static str;
    /// For NumPy.
    const NAME: &'static str;
    /// Whether all values of an array of another type can be held.
    fn holds(array: &Bound<'_, PyUntypedArray>) -> PyResult<bool> {
        let safely = array.py().import("numpy")?.getattr("can_cast")?;
        safely.call1((array.dtype(), Self::NAME, "safe"))?.extract()
    }
}

impl Entry for f64 {
    const ALLOWED: &'static str = "numbers";
    const NAME: &'static str = "float64";
}

impl Entry for bool {
    const ALLOWED: &'static str = "True or False";
    const NAME: &'static str = "bool";
}

impl Entry for u64 {
    const ALLOWED: &'static str = "whole numbers from 0 to 2^64 - 1";
    const NAME: &'static str = "uint64";
    /// Also signed ones where none is negative.
    fn holds(array: &Bound<'_, PyUntypedArray>) -> PyResult<bool> {
        Ok(match array.dtype().kind() {
            b'u' => true,
            b'i' => array.len() == 0 || array.call_method0("min")?.ge(0)?,
            _ => false,
        })
    }
}

impl Entry for i64 {
    const ALLOWED: &'static str = "whole numbers from -2^63 to 2^63 - 1";
    const NAME: &'static str = "int64";
}

/// An argument that is an array, a list or a number, as NumPy sees it.
pub fn array<'py, T: Entry>(
    name: &str,
    value: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    if let Ok(array) = value.cast::<PyArrayDyn<T>>() {
        return Ok(array.clone());
    }
    let refused = |_| type_error(name, value, &format!("an array of {}", T::ALLOWED));
    let numpy = value.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (value,)).map_err(refused)?;
    let untyped = array.cast::<PyUntypedArray>()?;
    if untyped.len() > 0 && !T::holds(untyped)? {
        return Err(not_held::<T>(name, untyped));
    }
    Ok(array.call_method1("astype", (T::NAME,))?.cast_into()?)
}

fn not_held<T: Entry>(name: &str, array: &Bound<'_, PyUntypedArray>) -> PyErr {
    let least = array.call_method0("min").ok().filter(|_| array.dtype().kind() == b'i');
    let told = least.map_or(String::new(), |least| format!(" with a {}", shown(&least)));
    let kind = array.dtype().str().map_or_else(|_| "?".into(), |kind| kind.to_string());
    value_error(format!("{name} is an array of {kind}{told}; allowed: {}", T::ALLOWED))
}

/// The numbers of an array of exactly this shape, in C order.
pub fn read<T: Entry>(name: &str, value: &Bound<'_, PyAny>, shape: &[usize]) -> PyResult<Vec<T>> {
    let array = array::<T>(name, value)?;
    if array.shape() != shape {
        return Err(value_error(format!(
            "{name} has shape {:?}; expected {shape:?}",
            array.shape()
        )));
    }
    let mut numbers = memory::reserved(name, array.len())?;
    let readonly = array.try_readonly()?;
    let view = readonly.as_array();
    // NumPy calls columns in a row contiguous, too; a view counts rows alone.
    match view.as_slice() {
        Some(rows) => numbers.extend_from_slice(rows),
        None => numbers.extend(view.iter()),
    }
    Ok(numbers)
}

/// A list of indices.
pub fn indices(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<i64>> {
    let array = array::<i64>(name, value)?;
    read(name, &array, &[array.len()])
}

/// Numbers as an array of a shape that fits them.
pub fn shaped<'py, T: Element, D: numpy::ndarray::Dimension>(
    py: Python<'py>,
    numbers: Vec<T>,
    shape: impl numpy::ndarray::IntoDimension<Dim = D>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    numbers.into_pyarray(py).reshape(shape)
}
