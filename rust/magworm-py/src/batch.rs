//! `Batch` for Python.

use crate::arguments::{self, bytes, ensemble, number, whole};
use crate::arrays::{indices, read, shaped};
use crate::errors::{in_use, value_error};
use crate::interruption::interruptible;
use crate::memory::{self, check_room, product};
use crate::parameters::{check_factors, parameter, parameter_names};
use crate::rollout::{Trajectories, rollout};
use crate::scene::Scene;
use crate::specification::specifications;
use crate::start::starts;
use magworm::internals::Pool;
use magworm::{Ensemble, LaneChoice, Model, Status, StepOutput, View, observe};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use std::sync::{Arc, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// Most environments of a batch.
const MAX_ENVIRONMENTS: usize = 1 << 24;

/// N environments of one scene or several, advanced together.
#[pyclass(module = "magworm_gym._magworm", frozen)]
pub struct Batch {
    ensemble: Ensemble,
    /// The first scene, whose shape all have.
    model: Arc<Model>,
    count: usize,
    lanes: LaneChoice,
    threads: Option<usize>,
    batch: RwLock<magworm::Batch>,
}

type Array1<'py, T> = Bound<'py, PyArray1<T>>;
type Array2<'py, T> = Bound<'py, PyArray2<T>>;
type Array3<'py> = Bound<'py, PyArray3<f64>>;
type StepArrays<'py> = (Array2<'py, f32>, Array1<'py, f64>, Array1<'py, u8>);

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(
        signature = (scene, num_envs, *, lanes = None, threads = None),
        text_signature = "(scene, num_envs, *, lanes='wide', threads=None)"
    )]
    fn new(
        scene: &Bound<'_, PyAny>,
        num_envs: &Bound<'_, PyAny>,
        lanes: Option<&Bound<'_, PyAny>>,
        threads: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let ensemble = ensemble("scene", scene)?;
        let count = whole("num_envs", num_envs, 1..=MAX_ENVIRONMENTS)?;
        let scenes = ensemble.models().len();
        if count < scenes {
            let allowed = format!("{scenes} or more, one for each scene");
            return Err(value_error(format!("num_envs is {count}; allowed: {allowed}")));
        }
        let (lanes, threads) = (arguments::lanes(lanes)?, arguments::threads(threads)?);
        // First of all, so that what threads take is gone when the room is measured.
        let pool = scene.py().detach(|| Pool::started(threads));
        check_room(
            &format!("num_envs is {count}, which"),
            magworm::Batch::bytes(&ensemble, count, lanes),
        )?;
        let batch = interruptible(scene.py(), |interruption| {
            magworm::Batch::new_unless(interruption, ensemble, count, lanes, pool)
        })?;
        Ok(Self::around(batch, threads))
    }

    #[getter]
    fn scene(&self) -> Scene {
        Scene { model: self.model.clone() }
    }

    #[getter]
    fn scenes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let models = self.ensemble.models().iter();
        PyTuple::new(py, models.map(|model| Scene { model: model.clone() }))
    }

    #[getter]
    fn scene_indices<'py>(&self, py: Python<'py>) -> PyResult<Array1<'py, i64>> {
        let batch = self.reading()?;
        let mut indices = memory::reserved("scene_indices", self.count)?;
        indices.extend((0..self.count).map(|environment| batch.scene_of(environment) as i64));
        Ok(indices.into_pyarray(py))
    }

    #[getter]
    fn num_envs(&self) -> usize {
        self.count
    }

    #[getter]
    fn observation_specification<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        specifications(py, observe::observation(&self.model))
    }

    #[getter]
    fn action_specification<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        specifications(py, observe::action(&self.model))
    }

    #[getter]
    fn parameter_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, parameter_names(&self.ensemble))
    }

    fn set_parameter(&self, name: &Bound<'_, PyAny>, factors: &Bound<'_, PyAny>) -> PyResult<()> {
        let (parameter, column) = parameter(name)?;
        let factors = read::<f64>("factors", factors, &[self.count])?;
        let mut batch = self.writing()?;
        check_factors(&batch, parameter, &factors)?;
        let rows = batch.factors_mut().chunks_mut(Model::PARAMETERS.len());
        rows.zip(factors).for_each(|(row, factor)| row[column] = factor);
        Ok(())
    }

    fn parameter<'py>(&self, name: &Bound<'py, PyAny>) -> PyResult<Array1<'py, f64>> {
        let (_, column) = parameter(name)?;
        let batch = self.reading()?;
        let rows = batch.factors().chunks(Model::PARAMETERS.len());
        let mut factors = memory::reserved("parameter", self.count)?;
        factors.extend(rows.map(|row| row[column]));
        Ok(factors.into_pyarray(name.py()))
    }

    fn set_magnets_present(&self, present: &Bound<'_, PyAny>) -> PyResult<()> {
        let values = read::<bool>("present", present, &[self.count, self.model.magnets()])?;
        self.writing()?.present_mut().copy_from_slice(&values);
        Ok(())
    }

    fn magnets_present<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, bool>> {
        let batch = self.reading()?;
        let mut present = memory::reserved("magnets_present", batch.present().len())?;
        present.extend_from_slice(batch.present());
        shaped(py, present, [self.count, self.model.magnets()])
    }

    #[pyo3(signature = (mask, seeds, episodes, start = None))]
    fn reset(
        &self,
        mask: &Bound<'_, PyAny>,
        seeds: &Bound<'_, PyAny>,
        episodes: &Bound<'_, PyAny>,
        start: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let mut batch = self.writing()?;
        let starts = starts(&batch, mask, seeds, episodes, start)?;
        let batch = &mut *batch;
        interruptible(mask.py(), |interruption| batch.reset_unless(interruption, &starts))
    }

    fn step<'py>(&self, actions: &Bound<'py, PyAny>) -> PyResult<StepArrays<'py>> {
        let (py, size) = (actions.py(), observe::action_size(&self.model));
        let actions = read::<f64>("actions", actions, &[self.count, size])?;
        if let Some(k) = actions.iter().position(|a| !a.is_finite()) {
            let (environment, component) = (k / size, k % size);
            return Err(value_error(format!(
                "action of environment {environment}, component {component}, is {}; allowed: finite numbers, clipped to [-1, 1]",
                actions[k]
            )));
        }
        let width = observe::size(&self.model);
        let mut observation = memory::zeros("observations", product(&[self.count, width]))?;
        let mut progress_m = memory::zeros("progress_m", self.count)?;
        let mut status = memory::zeros("status", self.count)?;
        let mut batch = self.writing()?;
        let batch = &mut *batch;
        interruptible(py, |interruption| {
            let output = StepOutput {
                observation: &mut observation,
                progress_m: &mut progress_m,
                status: &mut status,
            };
            batch.step_unless(interruption, &actions, output)
        })?;
        let observation = shaped(py, observation, [self.count, width])?;
        Ok((observation, progress_m.into_pyarray(py), status.into_pyarray(py)))
    }

    #[pyo3(
        signature = (actions, *, observations = None, magnet_poses = None),
        text_signature = "($self, actions, *, observations=False, magnet_poses=False)"
    )]
    fn rollout(
        &self,
        actions: &Bound<'_, PyAny>,
        observations: Option<&Bound<'_, PyAny>>,
        magnet_poses: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Trajectories> {
        let observations = arguments::flag("observations", observations)?;
        let magnet_poses = arguments::flag("magnet_poses", magnet_poses)?;
        rollout(&mut *self.writing()?, actions, observations, magnet_poses)
    }

    fn copies(&self, environments: &Bound<'_, PyAny>) -> PyResult<Self> {
        let chosen = self.environments(environments)?;
        let batch = self.reading()?;
        let batch = &*batch;
        let what = format!("environments names {}, whose copies", chosen.len());
        check_room(&what, batch.copies_bytes(&chosen))?;
        let copies = interruptible(environments.py(), |interruption| {
            batch.copies_unless(interruption, &chosen)
        })?;
        Ok(Self::around(copies, self.threads))
    }

    fn advance(&self, duration_s: &Bound<'_, PyAny>) -> PyResult<()> {
        let step_s = self.model.step_s;
        let allowed = format!("a whole number of solver steps of {step_s} s");
        let steps = number("duration_s", duration_s, &allowed)? / step_s;
        let whole = steps.round();
        if !(whole >= 0.0 && whole <= f64::from(u32::MAX)) || (steps - whole).abs() > 1e-6 {
            let given = arguments::shown(duration_s);
            return Err(value_error(format!("duration_s is {given} s; allowed: {allowed}")));
        }
        let mut batch = self.writing()?;
        let batch = &mut *batch;
        interruptible(duration_s.py(), |interruption| {
            batch.advance_unless(interruption, whole as u32)
        })
    }

    fn observe<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, f32>> {
        let width = observe::size(&self.model);
        let rows = self.seen(py, "observations", width, |view, row| view.observe(row))?;
        shaped(py, rows, [self.count, width])
    }

    fn status<'py>(&self, py: Python<'py>) -> PyResult<Array1<'py, u8>> {
        let codes = self.seen(py, "status", 1, |view, code| code[0] = view.status() as u8)?;
        Ok(codes.into_pyarray(py))
    }

    #[staticmethod]
    fn status_text(code: &Bound<'_, PyAny>) -> PyResult<&'static str> {
        let code = whole("code", code, 0..=usize::from(u8::MAX))?;
        let status = Status::from_code(code as u8);
        status
            .map(Status::text)
            .ok_or_else(|| value_error(format!("status code {code} is unknown")))
    }

    fn time_s<'py>(&self, py: Python<'py>) -> PyResult<Array1<'py, f64>> {
        let times = self.seen(py, "time_s", 1, |view, time| time[0] = view.time_s())?;
        Ok(times.into_pyarray(py))
    }

    fn magnet_poses<'py>(&self, py: Python<'py>) -> PyResult<Array3<'py>> {
        let shape = [self.count, self.model.magnets(), self.model.sizes().pose()];
        self.table(py, "magnet_poses", shape, |view, k, row| view.write_magnet_pose(k, row))
    }

    fn magnet_velocities<'py>(&self, py: Python<'py>) -> PyResult<Array3<'py>> {
        let shape = [self.count, self.model.magnets(), self.model.sizes().body()];
        self.table(py, "magnet_velocities", shape, |view, k, row| {
            view.write_magnet_velocity(k, row)
        })
    }

    fn magnet_wrenches<'py>(&self, py: Python<'py>) -> PyResult<Array3<'py>> {
        let shape = [self.count, self.model.magnets(), self.model.sizes().body()];
        let rows = self.seen(py, "magnet_wrenches", product(&shape[1..]), |view, row| {
            row.copy_from_slice(&view.magnet_wrenches());
        })?;
        shaped(py, rows, shape)
    }

    fn node_positions<'py>(&self, py: Python<'py>) -> PyResult<Array3<'py>> {
        let shape = [self.count, self.model.nodes(), self.model.dimensions()];
        self.table(py, "node_positions", shape, |view, k, row| view.write_node(k, row))
    }

    fn drive_positions<'py>(&self, py: Python<'py>) -> PyResult<Array3<'py>> {
        let magnets = self.model.program.drive_magnets();
        let shape = [self.count, magnets, self.model.sizes().stage];
        self.table(py, "drive_positions", shape, |view, k, row| view.write_drive_place(k, row))
    }

    fn drive_velocities<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, f64>> {
        let width = self.model.sizes().stage;
        let rows = self.seen(py, "drive_velocities", width, |view, row| {
            row.copy_from_slice(&view.drive_velocity());
        })?;
        shaped(py, rows, [self.count, width])
    }

    fn robot_poses<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, f64>> {
        let pose = |view: &View<'_>, row: &mut [f64]| row.copy_from_slice(&view.robot_pose());
        shaped(py, self.seen(py, "robot_poses", 3, pose)?, [self.count, 3])
    }

    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let counters = self.reading()?.counters();
        let dict = PyDict::new(py);
        dict.set_item("steps", counters.steps)?;
        dict.set_item("trials", counters.trials)?;
        dict.set_item("factorisations", counters.factorisations)?;
        dict.set_item("wrenches", counters.wrenches)?;
        Ok(dict)
    }

    fn get_state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let batch = self.reading()?;
        let batch = &*batch;
        let size = batch.snapshot_bytes();
        check_room("the state", size)?;
        PyBytes::new_with(py, size, |state| {
            interruptible(py, |interruption| batch.snapshot_unless(interruption, state))
        })
    }

    pub(crate) fn set_state(&self, state: &Bound<'_, PyAny>) -> PyResult<()> {
        let bytes = bytes("state", state)?;
        let mut batch = self.writing()?;
        let batch = &mut *batch;
        let restored =
            interruptible(state.py(), |interruption| batch.restore_unless(interruption, &bytes))?;
        restored.map_err(value_error)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let rebuild = py.import("magworm_gym._magworm")?.getattr("_rebuild_batch")?;
        let lanes = match self.lanes {
            LaneChoice::Wide => "wide",
            LaneChoice::Scalar => "scalar",
        };
        let (scenes, indices) = (self.scenes(py)?, self.scene_indices(py)?);
        let arguments = (scenes, indices, lanes, self.threads, self.get_state(py)?);
        (rebuild, arguments).into_pyobject(py).map(Bound::into_any)
    }
}

impl Batch {
    /// A batch that was made for so many threads.
    pub(crate) fn around(batch: magworm::Batch, threads: Option<usize>) -> Self {
        let (ensemble, model) = (batch.ensemble().clone(), batch.model().clone());
        let (count, lanes) = (batch.count(), batch.lanes());
        Self { ensemble, model, count, lanes, threads, batch: RwLock::new(batch) }
    }

    fn reading(&self) -> PyResult<RwLockReadGuard<'_, magworm::Batch>> {
        self.batch.try_read().map_err(|error| in_use("this batch", &error))
    }

    fn writing(&self) -> PyResult<RwLockWriteGuard<'_, magworm::Batch>> {
        self.batch.try_write().map_err(|error| in_use("this batch", &error))
    }

    /// So many numbers of each environment.
    fn seen<T: Clone + Default + Send>(
        &self,
        py: Python<'_>,
        what: &str,
        each: usize,
        look: impl Fn(&View<'_>, &mut [T]) + Sync,
    ) -> PyResult<Vec<T>> {
        let batch = self.reading()?;
        let batch = &*batch;
        let mut rows = memory::zeros(what, product(&[self.count, each]))?;
        interruptible(py, |interruption| batch.look_unless(interruption, &mut rows, &look))?;
        Ok(rows)
    }

    /// Numbers of each of several things of an environment.
    fn table<'py>(
        &self,
        py: Python<'py>,
        what: &str,
        shape: [usize; 3],
        write: impl Fn(&View<'_>, usize, &mut [f64]) + Sync,
    ) -> PyResult<Array3<'py>> {
        let [_, things, width] = shape;
        let rows = self.seen(py, what, product(&[things, width]), |view, rows| {
            rows.chunks_mut(width).enumerate().for_each(|(k, row)| write(view, k, row));
        })?;
        shaped(py, rows, shape)
    }

    /// Indices of environments, one at least.
    fn environments(&self, given: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
        let indices = indices("environments", given)?;
        if indices.is_empty() {
            return Err(value_error("environments is empty; allowed: one index or more"));
        }
        let inside = |(copy, index): (usize, &i64)| {
            let chosen = usize::try_from(*index).ok().filter(|&chosen| chosen < self.count);
            let last = self.count - 1;
            chosen.ok_or_else(|| {
                value_error(format!("environment of copy {copy} is {index}; allowed: 0 to {last}"))
            })
        };
        indices.iter().enumerate().map(inside).collect()
    }
}
