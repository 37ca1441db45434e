//! `Batch` for Python.

use crate::arrays::read;
use crate::errors::value_error;
use crate::rollout::{Trajectories, rollout};
use crate::scene::Scene;
use crate::specification::specifications;
use magworm::scene::Parameter;
use magworm::{LaneChoice, Model, StartPose, Status, StepOutput, View, observe};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

/// N environments of one scene, advanced together.
#[pyclass(module = "magworm_gym._magworm")]
pub struct Batch {
    batch: magworm::Batch,
    threads: Option<usize>,
}

type Arrays1<'py, T> = Bound<'py, PyArray1<T>>;
type StepArrays<'py> = (Bound<'py, PyArray2<f32>>, Arrays1<'py, f64>, Arrays1<'py, u8>);

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (scene, num_envs, *, lanes = "wide", threads = None))]
    fn new(scene: &Scene, num_envs: usize, lanes: &str, threads: Option<usize>) -> PyResult<Self> {
        let lanes = match lanes {
            "wide" => LaneChoice::Wide,
            "scalar" => LaneChoice::Scalar,
            other => {
                return Err(value_error(format!(
                    "lanes is {other:?}; allowed: \"wide\", \"scalar\""
                )));
            }
        };
        if num_envs == 0 || num_envs > 1 << 24 {
            return Err(value_error(format!("num_envs is {num_envs}; allowed: 1 to {}", 1 << 24)));
        }
        if threads == Some(0) || threads.is_some_and(|t| t > 4096) {
            return Err(value_error("threads is out of range; allowed: None, or 1 to 4096"));
        }
        Ok(Self {
            batch: magworm::Batch::new(scene.model.clone(), num_envs, lanes, threads),
            threads,
        })
    }

    #[getter]
    fn scene(&self) -> Scene {
        Scene { model: self.batch.model().clone() }
    }

    #[getter]
    fn num_envs(&self) -> usize {
        self.batch.count()
    }

    #[getter]
    fn observation_specification<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        specifications(py, observe::observation(self.batch.model()))
    }

    #[getter]
    fn action_specification<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        specifications(py, observe::action(self.batch.model()))
    }

    #[getter]
    fn parameter_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let names: Vec<&str> = Model::PARAMETERS.iter().map(|p| p.name()).collect();
        Ok(pyo3::types::PyTuple::new(py, names)?.into_any())
    }

    fn set_parameter(&mut self, name: &str, factors: PyReadonlyArrayDyn<'_, f64>) -> PyResult<()> {
        let column = parameter_column(name)?;
        let values = read("factors", &factors, &[self.batch.count()])?;
        let drive_speed = name == Parameter::DriveSpeed.name();
        if let Some((k, bad)) =
            values.iter().enumerate().find(|(_, f)| !factor_allowed(**f, drive_speed))
        {
            let allowed = if drive_speed { "-1e3 to 1e3" } else { "0 to 1e3" };
            let message =
                format!("factor of {name} in environment {k} is {bad}; allowed: {allowed}");
            return Err(value_error(message));
        }
        let rows = self.batch.factors_mut().chunks_mut(Model::PARAMETERS.len());
        rows.zip(values).for_each(|(row, factor)| row[column] = factor);
        Ok(())
    }

    fn parameter<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Arrays1<'py, f64>> {
        let column = parameter_column(name)?;
        let rows = self.batch.factors().chunks(Model::PARAMETERS.len());
        Ok(rows.map(|row| row[column]).collect::<Vec<_>>().into_pyarray(py))
    }

    fn set_magnets_present(&mut self, present: PyReadonlyArrayDyn<'_, bool>) -> PyResult<()> {
        let shape = [self.batch.count(), self.batch.model().magnets()];
        let values = read("present", &present, &shape)?;
        self.batch.present_mut().copy_from_slice(&values);
        Ok(())
    }

    fn magnets_present<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        let shape = [self.batch.count(), self.batch.model().magnets()];
        PyArray1::from_slice(py, self.batch.present()).reshape(shape)
    }

    #[pyo3(signature = (mask, seeds, episodes, start = None))]
    fn reset(
        &mut self,
        mask: PyReadonlyArrayDyn<'_, bool>,
        seeds: PyReadonlyArrayDyn<'_, u64>,
        episodes: PyReadonlyArrayDyn<'_, u64>,
        start: Option<PyReadonlyArrayDyn<'_, f64>>,
    ) -> PyResult<()> {
        let count = self.batch.count();
        let mask = read("mask", &mask, &[count])?;
        let seeds = read("seeds", &seeds, &[count])?;
        let episodes = read("episodes", &episodes, &[count])?;
        let columns = self.start_limits().len();
        let start = start.map(|array| read("start", &array, &[count, columns])).transpose()?;
        check_start(start.as_deref(), &mask, self.start_limits())?;
        for environment in (0..count).filter(|&k| mask[k]) {
            let pose = start.as_deref().map(|rows| {
                let row = &rows[columns * environment..][..columns];
                let (z_m, yaw_rad) =
                    if let [.., z, yaw] = row[3..] { (z, yaw) } else { (0.0, 0.0) };
                StartPose { x_m: row[0], height_m: row[1], angle_rad: row[2], z_m, yaw_rad }
            });
            self.batch.reset(environment, seeds[environment], episodes[environment], pose);
        }
        Ok(())
    }

    fn step<'py>(
        &mut self,
        py: Python<'py>,
        actions: PyReadonlyArrayDyn<'py, f64>,
    ) -> PyResult<StepArrays<'py>> {
        let count = self.batch.count();
        let size = observe::action_size(self.batch.model());
        let actions = read("actions", &actions, &[count, size])?;
        if let Some(k) = actions.iter().position(|a| !a.is_finite()) {
            let (environment, component) = (k / size, k % size);
            return Err(value_error(format!(
                "action of environment {environment}, component {component}, is {}; allowed: finite numbers, clipped to [-1, 1]",
                actions[k]
            )));
        }
        let width = observe::size(self.batch.model());
        let mut observation = vec![0.0f32; count * width];
        let mut progress_m = vec![0.0; count];
        let mut status = vec![0u8; count];
        let batch = &mut self.batch;
        py.detach(|| {
            let output = StepOutput {
                observation: &mut observation,
                progress_m: &mut progress_m,
                status: &mut status,
            };
            batch.step(&actions, output);
        });
        let observation = observation.into_pyarray(py).reshape([count, width])?;
        Ok((observation, progress_m.into_pyarray(py), status.into_pyarray(py)))
    }

    #[pyo3(signature = (actions, *, observations = false, magnet_poses = false))]
    fn rollout<'py>(
        &mut self,
        py: Python<'py>,
        actions: PyReadonlyArrayDyn<'py, f64>,
        observations: bool,
        magnet_poses: bool,
    ) -> PyResult<Trajectories> {
        rollout(py, &mut self.batch, &actions, observations, magnet_poses)
    }

    fn copies(&self, py: Python<'_>, environments: Vec<i64>) -> PyResult<Self> {
        let count = self.batch.count();
        if environments.is_empty() {
            return Err(value_error("environments is empty; allowed: one index or more"));
        }
        let inside = |&environment: &i64| usize::try_from(environment).ok().filter(|&e| e < count);
        let chosen: Option<Vec<usize>> = environments.iter().map(inside).collect();
        let Some(chosen) = chosen else {
            let (k, bad) =
                (0..).zip(&environments).find(|(_, e)| inside(e).is_none()).unwrap_or((0, &0));
            return Err(value_error(format!(
                "environment of copy {k} is {bad}; allowed: 0 to {}",
                count - 1
            )));
        };
        Ok(Self { batch: py.detach(|| self.batch.copies(&chosen)), threads: self.threads })
    }

    fn advance(&mut self, py: Python<'_>, duration_s: f64) -> PyResult<()> {
        let steps = duration_s / self.batch.model().step_s;
        let whole = steps.round();
        if !(whole >= 0.0 && whole <= f64::from(u32::MAX)) || (steps - whole).abs() > 1e-6 {
            let step_s = self.batch.model().step_s;
            return Err(value_error(format!(
                "duration_s is {duration_s} s; allowed: a whole number of solver steps of {step_s} s"
            )));
        }
        let batch = &mut self.batch;
        py.detach(|| batch.advance(whole as u32));
        Ok(())
    }

    fn observe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let shape = [self.batch.count(), observe::size(self.batch.model())];
        let mut rows = vec![0.0f32; shape[0] * shape[1]];
        self.batch.observe(&mut rows);
        rows.into_pyarray(py).reshape(shape)
    }

    fn status<'py>(&self, py: Python<'py>) -> Arrays1<'py, u8> {
        let codes: Vec<u8> = (0..self.batch.count()).map(|k| self.batch.status(k) as u8).collect();
        codes.into_pyarray(py)
    }

    #[staticmethod]
    fn status_text(code: u8) -> PyResult<&'static str> {
        let status = Status::from_code(code);
        status
            .map(Status::text)
            .ok_or_else(|| value_error(format!("status code {code} is unknown")))
    }

    fn time_s<'py>(&self, py: Python<'py>) -> Arrays1<'py, f64> {
        self.gather(|view, out| out.push(view.time_s())).into_pyarray(py)
    }

    fn magnet_poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let magnets = self.batch.model().magnets();
        self.per_item(py, magnets, [3, 7], |view, k| view.magnet_pose(k))
    }

    fn magnet_velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let magnets = self.batch.model().magnets();
        self.per_item(py, magnets, [3, 6], |view, k| view.magnet_velocity(k))
    }

    fn node_positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let nodes = self.batch.model().nodes();
        self.per_item(py, nodes, [2, 3], |view, k| view.node_m(k))
    }

    fn drive_positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let magnets = self.batch.model().program.drive_magnets();
        self.per_item(py, magnets, [2, 4], |view, k| view.drive_place(k).unwrap_or_default())
    }

    fn drive_velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = self.gather(|view, out| out.extend(view.drive_velocity()));
        rows.into_pyarray(py).reshape([self.batch.count(), self.of_dimensions([2, 4])])
    }

    fn robot_poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = self.gather(|view, out| out.extend(view.robot_pose()));
        rows.into_pyarray(py).reshape([self.batch.count(), 3])
    }

    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let counters = self.batch.counters();
        let dict = PyDict::new(py);
        dict.set_item("steps", counters.steps)?;
        dict.set_item("trials", counters.trials)?;
        dict.set_item("factorisations", counters.factorisations)?;
        dict.set_item("wrenches", counters.wrenches)?;
        Ok(dict)
    }

    fn get_state<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.batch.snapshot())
    }

    fn set_state(&mut self, state: &[u8]) -> PyResult<()> {
        self.batch.restore(state).map_err(value_error)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let module = py.import("magworm_gym._magworm")?;
        let rebuild = module.getattr("_rebuild_batch")?;
        let lanes = match self.batch.lanes() {
            LaneChoice::Wide => "wide",
            LaneChoice::Scalar => "scalar",
        };
        let arguments = (
            self.scene().into_pyobject(py)?,
            self.batch.count(),
            lanes,
            self.threads,
            self.get_state(py),
        );
        (rebuild, arguments).into_pyobject(py).map(Bound::into_any)
    }
}

impl Batch {
    fn gather<T>(&self, look: impl Fn(View<'_>, &mut Vec<T>)) -> Vec<T> {
        let mut out = Vec::new();
        (0..self.batch.count()).for_each(|k| self.batch.view(k, |view| look(view, &mut out)));
        out
    }

    /// What a scene in the plane and one in space have.
    fn of_dimensions<T>(&self, [plane, space]: [T; 2]) -> T {
        if self.batch.model().dimensions() == 2 { plane } else { space }
    }

    /// Numbers of each of `count` things of an environment; `width` in the plane and in space.
    fn per_item<'py>(
        &self,
        py: Python<'py>,
        count: usize,
        width: [usize; 2],
        look: impl Fn(&View<'_>, usize) -> Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let rows = self.gather(|view, out| (0..count).for_each(|k| out.extend(look(&view, k))));
        let shape = [self.batch.count(), count, self.of_dimensions(width)];
        rows.into_pyarray(py).reshape(shape)
    }

    /// Columns of a start pose: name, greatest magnitude, unit.
    fn start_limits(&self) -> &'static [StartLimit] {
        self.of_dimensions([&START[..3], &START])
    }
}

type StartLimit = (&'static str, f64, &'static str);

const START: [StartLimit; 5] = [
    ("x", 1e3, "m"),
    ("height", 10.0, "m"),
    ("angle", 1e3, "rad"),
    ("z", 1e3, "m"),
    ("yaw", 1e3, "rad"),
];

/// Makes a batch again from what `Batch.__reduce__` kept.
#[pyfunction]
pub fn _rebuild_batch(
    scene: &Scene,
    num_envs: usize,
    lanes: &str,
    threads: Option<usize>,
    state: &[u8],
) -> PyResult<Batch> {
    let mut batch = Batch::new(scene, num_envs, lanes, threads)?;
    batch.set_state(state)?;
    Ok(batch)
}

fn parameter_column(name: &str) -> PyResult<usize> {
    Model::PARAMETERS.iter().position(|p| p.name() == name).ok_or_else(|| {
        let names: Vec<&str> = Model::PARAMETERS.iter().map(|p| p.name()).collect();
        value_error(format!("parameter {name:?} is unknown; allowed: {}", names.join(", ")))
    })
}

fn factor_allowed(factor: f64, signed: bool) -> bool {
    factor.abs() <= 1e3 && (signed || factor >= 0.0)
}

/// Start poses of the masked environments must be finite and near.
fn check_start(start: Option<&[f64]>, mask: &[bool], limits: &[StartLimit]) -> PyResult<()> {
    let rows = start.unwrap_or_default().chunks(limits.len()).enumerate().filter(|(k, _)| mask[*k]);
    for (environment, row) in rows {
        for (value, (name, most, unit)) in row.iter().zip(limits) {
            if value.is_nan() || value.abs() > *most {
                return Err(value_error(format!(
                    "start {name} of environment {environment} is {value} {unit}; allowed: -{most} to {most} {unit}"
                )));
            }
        }
    }
    Ok(())
}
