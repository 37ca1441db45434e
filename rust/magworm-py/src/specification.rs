//! What an agent sees and does, for Python.

use magworm::observe;
use pyo3::prelude::*;

/// One named slice of an observation or action row.
#[pyclass(module = "magworm_gym._magworm", frozen, get_all)]
#[derive(Clone)]
pub struct Specification {
    name: &'static str,
    unit: String,
    size: usize,
    low: f64,
    high: f64,
    description: &'static str,
}

impl From<observe::Specification> for Specification {
    fn from(s: observe::Specification) -> Self {
        let observe::Specification { name, unit, size, low, high, description } = s;
        Self { name, unit, size, low, high, description }
    }
}

#[pymethods]
impl Specification {
    fn __repr__(&self) -> String {
        format!("Specification({}: {} × {}, {})", self.name, self.size, self.unit, self.description)
    }
}

/// A tuple of them.
pub fn specifications(
    py: Python<'_>,
    slices: Vec<observe::Specification>,
) -> PyResult<Bound<'_, PyAny>> {
    let slices = slices.into_iter().map(|s| Py::new(py, Specification::from(s)));
    let slices = slices.collect::<PyResult<Vec<_>>>()?;
    Ok(pyo3::types::PyTuple::new(py, slices)?.into_any())
}
