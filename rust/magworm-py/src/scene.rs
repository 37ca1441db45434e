//! `Scene` for Python.

use crate::errors::{scene_error, value_error};
use magworm::internals::share;
use magworm::scene::Motion;
use magworm::{Model, scene};
use pyo3::prelude::*;
use pyo3::types::{
    PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PySequence, PyString, PyTuple,
};
use std::sync::Arc;
use toml::Value;

/// A validated scene.
#[pyclass(module = "magworm_gym._magworm", frozen)]
#[derive(Clone)]
pub struct Scene {
    pub model: Arc<Model>,
}

impl Scene {
    fn compile(scene: &scene::Scene) -> PyResult<Self> {
        Ok(Self { model: Arc::new(Model::compile(scene).map_err(scene_error)?) })
    }

    fn inner(&self) -> &scene::Scene {
        &self.model.scene
    }
}

#[pymethods]
impl Scene {
    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        Self::compile(&scene::Scene::from_toml(text).map_err(scene_error)?)
    }

    #[staticmethod]
    fn preset(name: &str) -> PyResult<Self> {
        Self::compile(&scene::Scene::preset(name).map_err(scene_error)?)
    }

    fn with_values(&self, values: &Bound<'_, PyMapping>) -> PyResult<Self> {
        let mut changes = Vec::new();
        for item in values.items()?.iter() {
            let (path, value): (String, Bound<'_, PyAny>) = item.extract()?;
            changes.push((path.clone(), toml_value(&path, &value)?));
        }
        Self::compile(&self.inner().with_values(&changes).map_err(scene_error)?)
    }

    fn in_segments(&self) -> PyResult<Self> {
        Self::compile(&self.inner().in_segments())
    }

    fn to_toml(&self) -> String {
        self.inner().to_toml()
    }

    #[pyo3(signature = (*, measure = false))]
    fn explain(&self, py: Python<'_>, measure: bool) -> String {
        if measure { py.detach(|| share::explain(&self.model)) } else { self.model.explain() }
    }

    fn shares<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let shares = py.detach(|| share::shares(&self.model));
        let dict = PyDict::new(py);
        for (phase, share) in shares {
            dict.set_item(phase.name(), share)?;
        }
        Ok(dict)
    }

    fn explicit_limit(&self) -> (f64, String) {
        let limit = self.model.explicit_limit();
        (limit.step_s, limit.reason())
    }

    #[getter]
    fn name(&self) -> &str {
        &self.inner().name
    }

    #[getter]
    fn dimensions(&self) -> usize {
        self.model.dimensions()
    }

    #[getter]
    fn magnets(&self) -> usize {
        self.model.magnets()
    }

    #[getter]
    fn removed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let magnets = self.model.mesh.magnets.iter().enumerate();
        PyTuple::new(py, magnets.filter(|(_, m)| !m.present).map(|(j, _)| j).collect::<Vec<_>>())
    }

    #[getter]
    fn body_length_m(&self) -> f64 {
        self.model.mesh.length_m()
    }

    #[getter]
    fn control_step_s(&self) -> f64 {
        self.inner().control.step_s
    }

    #[getter]
    fn episode_s(&self) -> f64 {
        self.inner().control.episode_s
    }

    #[getter]
    fn controlled(&self) -> bool {
        self.model.program.is_controlled()
    }

    #[getter]
    fn stage_limits<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(Motion::Controlled(limits)) = self.inner().drive.as_ref().map(|d| &d.motion)
        else {
            return Ok(None);
        };
        let dict = PyDict::new(py);
        dict.set_item("reach_m", limits.reach_m)?;
        dict.set_item("lowest_m", limits.lowest_m)?;
        dict.set_item("highest_m", limits.highest_m)?;
        dict.set_item("speed_m_s", limits.speed_m_s)?;
        dict.set_item("acceleration_m_s2", limits.acceleration_m_s2)?;
        if self.model.dimensions() == 3 {
            dict.set_item("lateral_reach_m", limits.lateral_reach_m)?;
            dict.set_item("yaw_reach_deg", limits.yaw_reach_deg)?;
            dict.set_item("yaw_speed_deg_s", limits.yaw_speed_deg_s)?;
            dict.set_item("yaw_acceleration_deg_s2", limits.yaw_acceleration_deg_s2)?;
        }
        Ok(Some(dict))
    }

    #[getter]
    fn geometry<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (mesh, scene) = (&self.model.mesh, self.inner());
        let last = mesh.elements.len() - 1;
        let thickness = |node: usize| {
            let before = mesh.elements[node.saturating_sub(1)].thickness_m;
            before.max(mesh.elements[node.min(last)].thickness_m)
        };
        let dict = PyDict::new(py);
        let nodes: Vec<f64> = (0..self.model.nodes()).map(thickness).collect();
        dict.set_item("node_thickness_m", nodes)?;
        let elements: Vec<f64> = mesh.elements.iter().map(|e| e.thickness_m).collect();
        dict.set_item("element_thickness_m", elements)?;
        let widths: Vec<f64> = mesh.elements.iter().map(|e| e.width_m).collect();
        dict.set_item("element_width_m", widths)?;
        let sizes: Vec<[f64; 3]> = mesh.magnets.iter().map(|m| m.size_m).collect();
        dict.set_item("magnet_size_m", sizes)?;
        let offsets: Vec<[f64; 3]> = mesh.magnets.iter().map(|m| m.offset_m).collect();
        dict.set_item("magnet_offset_m", offsets)?;
        let directions: Vec<[f64; 3]> =
            mesh.magnets.iter().map(|m| m.direction.map(|part| part * m.polarity)).collect();
        dict.set_item("magnet_direction", directions)?;
        let polarity: Vec<f64> = mesh.magnets.iter().map(|m| m.polarity).collect();
        dict.set_item("polarity", polarity)?;
        let drive = scene.drive.as_ref().map_or((0.0, 0.0), |d| (d.length_m, d.height_m));
        dict.set_item("drive_size_m", drive)?;
        dict.set_item("drive_width_m", scene.drive.as_ref().map_or(0.0, |d| d.width_m))?;
        dict.set_item("ground", scene.ground.is_some())?;
        dict.set_item("incline_deg", scene.ground.as_ref().map_or(0.0, |g| g.incline_deg))?;
        Ok(dict)
    }

    fn __repr__(&self) -> String {
        format!("Scene({:?}, {} magnets)", self.inner().name, self.model.magnets())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.inner() == other.inner()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let rebuild = py.get_type::<Self>().getattr("from_toml")?;
        Ok((rebuild, (self.to_toml(),)))
    }
}

/// A Python value as a TOML one; `None` stays none.
fn toml_value(path: &str, value: &Bound<'_, PyAny>) -> PyResult<Option<Value>> {
    if value.is_none() {
        return Ok(None);
    }
    let required = |value: &Bound<'_, PyAny>, inner: &str| -> PyResult<Value> {
        toml_value(inner, value)?
            .ok_or_else(|| value_error(format!("{inner} is None; leave it out")))
    };
    let converted = if value.is_instance_of::<PyBool>() {
        Value::Boolean(value.extract()?)
    } else if value.is_instance_of::<PyInt>() {
        Value::Integer(value.extract()?)
    } else if value.is_instance_of::<PyFloat>() {
        Value::Float(value.extract()?)
    } else if value.is_instance_of::<PyString>() {
        Value::String(value.extract()?)
    } else if value.is_instance_of::<PyDict>() || value.cast::<PyMapping>().is_ok() {
        let mut table = toml::Table::new();
        for item in value.cast::<PyMapping>()?.items()?.iter() {
            let (key, value): (String, Bound<'_, PyAny>) = item.extract()?;
            let inner = required(&value, &format!("{path}.{key}"))?;
            table.insert(key, inner);
        }
        Value::Table(table)
    } else if value.is_instance_of::<PyList>() || value.cast::<PySequence>().is_ok() {
        let items =
            value.try_iter()?.map(|item| required(&item?, path)).collect::<PyResult<_>>()?;
        Value::Array(items)
    } else if let Ok(number) = value.extract::<f64>() {
        Value::Float(number)
    } else {
        let kind = value.get_type().name()?.to_string();
        return Err(value_error(format!(
            "{path} is of type {kind}; allowed: bool, int, float, str, list, dict, None"
        )));
    };
    Ok(Some(converted))
}
