//! Parameters of a scene that an environment may have a factor of its own for.

use crate::arguments::text;
use crate::errors::value_error;
use magworm::scene::Parameter;
use magworm::{Ensemble, Model};
use pyo3::prelude::*;
use std::ops::RangeInclusive;

/// Names of those that act in every scene.
pub fn parameter_names(ensemble: &Ensemble) -> Vec<&'static str> {
    let acts = |&parameter: &Parameter| {
        ensemble.models().iter().all(|model| model.scene.magnetic_terms.has(parameter))
    };
    Model::PARAMETERS.into_iter().filter(acts).map(Parameter::name).collect()
}

/// A parameter and its column.
pub fn parameter(name: &Bound<'_, PyAny>) -> PyResult<(Parameter, usize)> {
    let allowed = Model::PARAMETERS.map(Parameter::name).join(", ");
    let given = text("name", name, &allowed)?;
    let column = Model::PARAMETERS.iter().position(|parameter| parameter.name() == given);
    match column {
        Some(column) => Ok((Model::PARAMETERS[column], column)),
        None => Err(value_error(format!("parameter {given:?} is unknown; allowed: {allowed}"))),
    }
}

/// Factors, one for each environment of a batch, must be finite, of most parameters not negative, and 1 of a term that the
/// environment's scene leaves out.
pub fn check_factors(
    batch: &magworm::Batch,
    parameter: Parameter,
    factors: &[f64],
) -> PyResult<()> {
    let allowed = |environment: usize| match parameter {
        _ if !batch.model_of(environment).scene.magnetic_terms.has(parameter) => 1.0..=1.0,
        Parameter::DriveSpeed => -1e3..=1e3,
        _ => 0.0..=1e3,
    };
    let wrong = (0..factors.len()).find(|&k| !allowed(k).contains(&factors[k]));
    wrong.map_or(Ok(()), |k| Err(refused(parameter.name(), k, factors[k], &allowed(k))))
}

fn refused(name: &str, environment: usize, factor: f64, allowed: &RangeInclusive<f64>) -> PyErr {
    let allowed = match (allowed.start(), allowed.end()) {
        (1.0, 1.0) => format!("1, as magnetic_terms.{name} of the scene is false"),
        (low, high) => format!("{low:e} to {high:e}").replace("0e0", "0"),
    };
    value_error(format!(
        "factor of {name} in environment {environment} is {factor}; allowed: {allowed}"
    ))
}
