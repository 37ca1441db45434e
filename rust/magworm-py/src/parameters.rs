//! Parameters of a scene that an environment may have a factor of its own for.

use crate::arguments::text;
use crate::errors::value_error;
use magworm::Model;
use magworm::scene::Parameter;
use pyo3::prelude::*;

/// Their names.
pub fn parameter_names() -> Vec<&'static str> {
    Model::PARAMETERS.iter().map(|parameter| parameter.name()).collect()
}

/// A parameter and its column.
pub fn parameter(name: &Bound<'_, PyAny>) -> PyResult<(Parameter, usize)> {
    let allowed = parameter_names().join(", ");
    let given = text("name", name, &allowed)?;
    let column = Model::PARAMETERS.iter().position(|parameter| parameter.name() == given);
    match column {
        Some(column) => Ok((Model::PARAMETERS[column], column)),
        None => Err(value_error(format!("parameter {given:?} is unknown; allowed: {allowed}"))),
    }
}

/// Factors must be finite, of most parameters not negative, and 1 of a term that the scene leaves out.
pub fn check_factors(model: &Model, parameter: Parameter, factors: &[f64]) -> PyResult<()> {
    let name = parameter.name();
    let (least, most, allowed) = match parameter {
        _ if !model.scene.magnetic_terms.has(parameter) => {
            (1.0, 1.0, format!("1, as magnetic_terms.{name} of the scene is false"))
        }
        Parameter::DriveSpeed => (-1e3, 1e3, "-1e3 to 1e3".into()),
        _ => (0.0, 1e3, "0 to 1e3".into()),
    };
    match factors.iter().position(|factor| !(least..=most).contains(factor)) {
        None => Ok(()),
        Some(k) => Err(value_error(format!(
            "factor of {name} in environment {k} is {}; allowed: {allowed}",
            factors[k]
        ))),
    }
}
