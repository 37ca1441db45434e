//! Whole trajectories for Python.

use crate::arrays::{array, read, shaped};
use crate::errors::value_error;
use crate::interruption::interruptible;
use crate::memory::{check_room, product, zeros};
use magworm::{Batch, Plan, RolloutOutput, observe};
use numpy::{PyArray2, PyArray3, PyArray4, PyUntypedArrayMethods};
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

/// Runs T control steps of a batch with actions (T, N, A).
pub fn rollout(
    batch: &mut Batch,
    actions: &Bound<'_, PyAny>,
    observations: bool,
    magnet_poses: bool,
) -> PyResult<Trajectories> {
    let py = actions.py();
    let (steps, actions) = planned(batch, actions)?;
    let (count, magnets) = (batch.count(), batch.model().magnets());
    let pose = batch.model().sizes().pose();
    let width = observe::size(batch.model());
    let plan = Plan { control_steps: steps, actions: &actions };
    let wanted = |wanted: bool, size: usize| if wanted { size } else { 0 };
    let (posed, observed) = (wanted(magnet_poses, magnets * pose), wanted(observations, width));
    let what = format!("a plan of {steps} control steps of {count} environments");
    let numbers = product(&[steps, count, 8 * (4 + posed) + 4 * observed + 1]);
    check_room(&what, numbers.saturating_add(batch.plan_bytes(&plan)))?;
    let rows = |each: usize| product(&[steps, count, each]);
    let mut progress_m = zeros(&what, rows(1))?;
    let mut status = zeros(&what, rows(1))?;
    let mut robot_pose = zeros(&what, rows(3))?;
    let mut magnet_pose = zeros(&what, rows(posed))?;
    let mut observation = zeros(&what, rows(observed))?;
    interruptible(py, |interruption| {
        let output = RolloutOutput {
            progress_m: &mut progress_m,
            status: &mut status,
            robot_pose: &mut robot_pose,
            magnet_pose: &mut magnet_pose,
            observation: &mut observation,
        };
        batch.rollout(plan, output, interruption)
    })?;
    let magnet_pose = magnet_poses.then(|| shaped(py, magnet_pose, [steps, count, magnets, pose]));
    let observation = observations.then(|| shaped(py, observation, [steps, count, width]));
    Ok(Trajectories {
        progress_m: shaped(py, progress_m, [steps, count])?.unbind(),
        status: shaped(py, status, [steps, count])?.unbind(),
        robot_poses: shaped(py, robot_pose, [steps, count, 3])?.unbind(),
        magnet_poses: magnet_pose.transpose()?.map(Bound::unbind),
        observations: observation.transpose()?.map(Bound::unbind),
    })
}

/// The number T of control steps and the actions of all of them.
fn planned(batch: &Batch, actions: &Bound<'_, PyAny>) -> PyResult<(usize, Vec<f64>)> {
    let (count, size) = (batch.count(), observe::action_size(batch.model()));
    let actions = array::<f64>("actions", actions)?;
    let steps = actions.shape().first().copied().unwrap_or(0);
    if actions.shape() != [steps, count, size] || steps == 0 {
        return Err(value_error(format!(
            "actions have shape {:?}; expected [T, {count}, {size}] with T of 1 or more",
            actions.shape()
        )));
    }
    let actions = read::<f64>("actions", &actions, &[steps, count, size])?;
    if let Some(k) = actions.iter().position(|a| !a.is_finite()) {
        let (step, environment, component) = (k / (count * size), k / size % count, k % size);
        return Err(value_error(format!(
            "action of control step {step}, environment {environment}, component {component}, is {}; allowed: finite numbers, clipped to [-1, 1]",
            actions[k]
        )));
    }
    Ok((steps, actions))
}
