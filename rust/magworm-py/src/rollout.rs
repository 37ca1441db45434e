//! Whole trajectories for Python.

use crate::arrays::read;
use crate::errors::value_error;
use magworm::{Batch, Plan, RolloutOutput, observe};
use numpy::{IntoPyArray, PyArray2, PyArray3, PyArray4, PyArrayMethods};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// What a rollout saw after each of its control steps.
#[pyclass(module = "magworm_gym._magworm", frozen, get_all)]
pub struct Trajectories {
    progress_m: Py<PyArray2<f64>>,
    status: Py<PyArray2<u8>>,
    robot_poses: Py<PyArray3<f64>>,
    magnet_poses: Option<Py<PyArray4<f64>>>,
    observations: Option<Py<PyArray3<f32>>>,
}

/// Runs T control steps of a batch with actions (T, N, A); stops at a signal such as Ctrl-C.
pub fn rollout(
    py: Python<'_>,
    batch: &mut Batch,
    actions: &PyReadonlyArrayDyn<'_, f64>,
    observations: bool,
    magnet_poses: bool,
) -> PyResult<Trajectories> {
    let (steps, actions) = planned(batch, actions)?;
    let (count, magnets) = (batch.count(), batch.model().magnets());
    let pose = if batch.model().dimensions() == 2 { 3 } else { 7 };
    let width = observe::size(batch.model());
    let rows = |wanted: bool, size: usize| if wanted { steps * count * size } else { 0 };
    let mut progress_m = vec![0.0; rows(true, 1)];
    let mut status = vec![0; rows(true, 1)];
    let mut robot_pose = vec![0.0; rows(true, 3)];
    let mut magnet_pose = vec![0.0; rows(magnet_poses, magnets * pose)];
    let mut observation = vec![0.0; rows(observations, width)];
    let mut signal = Ok(());
    py.detach(|| {
        let plan = Plan { control_steps: steps, actions: &actions };
        let output = RolloutOutput {
            progress_m: &mut progress_m,
            status: &mut status,
            robot_pose: &mut robot_pose,
            magnet_pose: &mut magnet_pose,
            observation: &mut observation,
        };
        batch.rollout(plan, output, &mut || {
            if signal.is_ok() {
                signal = Python::attach(|py| py.check_signals());
            }
            signal.is_err()
        })
    });
    signal?;
    Ok(Trajectories {
        progress_m: progress_m.into_pyarray(py).reshape([steps, count])?.unbind(),
        status: status.into_pyarray(py).reshape([steps, count])?.unbind(),
        robot_poses: robot_pose.into_pyarray(py).reshape([steps, count, 3])?.unbind(),
        magnet_poses: magnet_poses
            .then(|| magnet_pose.into_pyarray(py).reshape([steps, count, magnets, pose]))
            .transpose()?
            .map(Bound::unbind),
        observations: observations
            .then(|| observation.into_pyarray(py).reshape([steps, count, width]))
            .transpose()?
            .map(Bound::unbind),
    })
}

/// The number T of control steps and the actions of all of them.
fn planned(batch: &Batch, actions: &PyReadonlyArrayDyn<'_, f64>) -> PyResult<(usize, Vec<f64>)> {
    let (count, size) = (batch.count(), observe::action_size(batch.model()));
    let &[steps, ..] = actions.shape() else {
        return Err(value_error(format!(
            "actions are one number; expected shape [T, {count}, {size}]"
        )));
    };
    if actions.shape() != [steps, count, size] || steps == 0 {
        return Err(value_error(format!(
            "actions have shape {:?}; expected [T, {count}, {size}] with T of 1 or more",
            actions.shape()
        )));
    }
    let actions = read("actions", actions, &[steps, count, size])?;
    if let Some(k) = actions.iter().position(|a| !a.is_finite()) {
        let (step, environment, component) = (k / (count * size), k / size % count, k % size);
        return Err(value_error(format!(
            "action of control step {step}, environment {environment}, component {component}, is {}; allowed: finite numbers, clipped to [-1, 1]",
            actions[k]
        )));
    }
    Ok((steps, actions))
}
