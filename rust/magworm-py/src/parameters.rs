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

/// A parameter's name and column.
pub fn parameter(name: &Bound<'_, PyAny>) -> PyResult<(String, usize)> {
    let allowed = parameter_names().join(", ");
    let given = text("name", name, &allowed)?;
    let column = Model::PARAMETERS.iter().position(|parameter| parameter.name() == given);
    match column {
        Some(column) => Ok((given, column)),
        None => Err(value_error(format!("parameter {given:?} is unknown; allowed: {allowed}"))),
    }
}

/// Factors must be finite, and of most parameters not negative.
pub fn check_factors(name: &str, factors: &[f64]) -> PyResult<()> {
    let signed = name == Parameter::DriveSpeed.name();
    let (least, allowed) = if signed { (-1e3, "-1e3 to 1e3") } else { (0.0, "0 to 1e3") };
    match factors.iter().position(|factor| !(least..=1e3).contains(factor)) {
        None => Ok(()),
        Some(k) => Err(value_error(format!(
            "factor of {name} in environment {k} is {}; allowed: {allowed}",
            factors[k]
        ))),
    }
}
