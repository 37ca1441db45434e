//! `Scene` for Python.

use crate::arguments::{flag, text};
use crate::errors::scene_error;
use crate::interruption::interruptible;
use crate::values::changes;
use magworm::internals::share;
use magworm::scene::{Motion, SceneError};
use magworm::{Model, scene};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

/// A validated scene.
#[pyclass(module = "magworm_gym._magworm", frozen)]
#[derive(Clone)]
pub struct Scene {
    pub model: Arc<Model>,
}

impl Scene {
    fn compiled(py: Python<'_>, scene: Result<scene::Scene, SceneError>) -> PyResult<Self> {
        let model = scene.and_then(|scene| Model::compile(&scene));
        Ok(Self { model: Arc::new(model.map_err(|error| scene_error(py, &error))?) })
    }

    fn inner(&self) -> &scene::Scene {
        &self.model.scene
    }
}

#[pymethods]
impl Scene {
    #[staticmethod]
    fn from_toml(text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let toml = self::text("text", text, "TOML as text; load_scene reads files")?;
        Self::compiled(text.py(), scene::Scene::from_toml(&toml))
    }

    #[staticmethod]
    fn preset(name: &Bound<'_, PyAny>) -> PyResult<Self> {
        let given = text("name", name, "the name of a preset; load_scene reads files")?;
        Self::compiled(name.py(), scene::Scene::preset(&given))
    }

    #[staticmethod]
    fn ensemble(name: &Bound<'_, PyAny>) -> PyResult<Vec<Self>> {
        let given = text("name", name, "the name of an ensemble")?;
        let scenes =
            scene::Scene::ensemble(&given).map_err(|error| scene_error(name.py(), &error))?;
        scenes.into_iter().map(|scene| Self::compiled(name.py(), Ok(scene))).collect()
    }

    fn with_values(&self, values: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::compiled(values.py(), self.inner().with_values(&changes(values)?))
    }

    fn in_segments(&self, py: Python<'_>) -> PyResult<Self> {
        Self::compiled(py, Ok(self.inner().in_segments()))
    }

    fn to_toml(&self) -> String {
        self.inner().to_toml()
    }

    #[pyo3(signature = (*, measure = None), text_signature = "($self, *, measure=False)")]
    fn explain(&self, py: Python<'_>, measure: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        if flag("measure", measure)? {
            interruptible(py, |interruption| share::explain(&self.model, interruption))
        } else {
            Ok(self.model.explain())
        }
    }

    fn shares<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let shares = interruptible(py, |interruption| share::shares(&self.model, interruption))?;
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
        let magnets = self.model.present().into_iter().enumerate();
        PyTuple::new(py, magnets.filter(|(_, is_in)| !is_in).map(|(j, _)| j).collect::<Vec<_>>())
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
        let magnets = &self.model.magnets[..self.model.magnets()];
        let sizes: Vec<[f64; 3]> = magnets.iter().map(|m| m.size_m).collect();
        dict.set_item("magnet_size_m", sizes)?;
        let offsets: Vec<[f64; 3]> =
            magnets.iter().map(|m| m.offset_m.unwrap_or_default()).collect();
        dict.set_item("magnet_offset_m", offsets)?;
        let polarity: Vec<f64> = magnets.iter().map(|m| m.remanence_t.signum()).collect();
        let directions: Vec<[f64; 3]> = magnets
            .iter()
            .zip(&polarity)
            .map(|(m, polarity)| m.direction.vector().map(|part| part * polarity))
            .collect();
        dict.set_item("magnet_direction", directions)?;
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

    /// Equal scenes have equal texts: zeros have no sign.
    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.to_toml().hash(&mut hasher);
        hasher.finish()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let rebuild = py.get_type::<Self>().getattr("from_toml")?;
        Ok((rebuild, (self.to_toml(),)))
    }
}
