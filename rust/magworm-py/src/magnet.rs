//! Fields and wrenches of cuboid magnets for Python.

use crate::arguments::{whole, word};
use crate::arrays::{array, read, shaped};
use crate::errors::value_error;
use crate::interruption::interruptible;
use crate::memory::{product, zeros};
use magworm::internals::Pool;
use magworm::internals::magnetic::{MAX_ORDER, Magnet, Wrench, dipole_wrench, field_t, wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numpy::{PyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

type Table<'py> = Bound<'py, PyArrayDyn<f64>>;

/// Points for which no threads are started.
const FEW: usize = 256;

/// Flux density [T] of a cuboid at the origin. `magnetisation_t`, `points_m`: (…, 3).
#[pyfunction]
pub fn cuboid_field<'py>(
    size_m: &Bound<'py, PyAny>,
    magnetisation_t: &Bound<'py, PyAny>,
    points_m: &Bound<'py, PyAny>,
) -> PyResult<Table<'py>> {
    let py = points_m.py();
    let size = size("size_m", size_m)?;
    let leading = leading("points_m", points_m)?;
    let shape = [&leading[..], &[3]].concat();
    let magnetisation = read::<f64>("magnetisation_t", magnetisation_t, &shape)?;
    let points = read::<f64>("points_m", points_m, &shape)?;
    let flux = |k: usize, row: &mut [f64]| {
        let flux = field_t(size, vector(&magnetisation, k), vector(&points, k));
        row.copy_from_slice(flux.as_slice());
    };
    shaped(py, filled::<3>(py, product(&leading), flux)?, shape)
}

/// Force [N] and torque [N·m] of a drive at the origin on bodies. Positions and magnetisations: (…, 3),
/// quaternions w, x, y, z: (…, 4).
#[pyfunction]
pub fn cuboid_wrench<'py>(
    drive_size_m: &Bound<'py, PyAny>,
    body_size_m: &Bound<'py, PyAny>,
    position_m: &Bound<'py, PyAny>,
    quaternion: &Bound<'py, PyAny>,
    drive_magnetisation_t: &Bound<'py, PyAny>,
    body_magnetisation_t: &Bound<'py, PyAny>,
    order: &Bound<'py, PyAny>,
    model: &Bound<'py, PyAny>,
) -> PyResult<(Table<'py>, Table<'py>)> {
    let py = position_m.py();
    let (drive_size, body_size) =
        (size("drive_size_m", drive_size_m)?, size("body_size_m", body_size_m)?);
    let order = whole("order", order, 1..=MAX_ORDER)?;
    let dipole = word("model", Some(model), [("cuboid", false), ("dipole", true)])?;
    let leading = leading("position_m", position_m)?;
    let shape = [&leading[..], &[3]].concat();
    let positions = read::<f64>("position_m", position_m, &shape)?;
    let quaternions = read::<f64>("quaternion_wxyz", quaternion, &[&leading[..], &[4]].concat())?;
    let drives = read::<f64>("drive_magnetisation_t", drive_magnetisation_t, &shape)?;
    let bodies = read::<f64>("body_magnetisation_t", body_magnetisation_t, &shape)?;
    let one = |k: usize| -> Result<Wrench, String> {
        let drive = Magnet { size_m: drive_size, remanence_t: vector(&drives, k) };
        let body = Magnet { size_m: body_size, remanence_t: vector(&bodies, k) };
        let (at, quaternion) = (vector(&positions, k), &quaternions[4 * k..][..4]);
        let turn = rotation(quaternion).ok_or_else(|| {
            let place = place("quaternion_wxyz", &leading, k);
            format!("{place} is {quaternion:?}; allowed: any rotation, of any length but 0")
        })?;
        between(&drive, &body, at, turn, (!dipole).then_some(order)).map_err(|reason| {
            format!("{} is {:?} m: {reason}", place("position_m", &leading, k), at.as_slice())
        })
    };
    let (count, refused) = (product(&leading), AtomicUsize::new(usize::MAX));
    let wrenches = filled::<6>(py, count, |k, row| match one(k) {
        Ok(Wrench { force_n, torque_n_m }) => {
            row[..3].copy_from_slice(force_n.as_slice());
            row[3..].copy_from_slice(torque_n_m.as_slice());
        }
        Err(_) => _ = refused.fetch_min(k, Ordering::Relaxed),
    })?;
    let refused = refused.into_inner();
    if refused < count {
        one(refused).map_err(value_error)?;
    }
    let half = |first: usize| {
        let mut half = zeros("the wrenches", product(&[count, 3]))?;
        let rows = half.chunks_exact_mut(3).zip(wrenches.chunks_exact(6));
        rows.for_each(|(half, row)| half.copy_from_slice(&row[first..][..3]));
        shaped(py, half, shape.clone())
    };
    Ok((half(0)?, half(3)?))
}

/// Wrench of cuboids of an order, or of dipoles; or why there is none.
fn between(
    drive: &Magnet,
    body: &Magnet,
    position_m: Vector3<f64>,
    turn: UnitQuaternion<f64>,
    order: Option<usize>,
) -> Result<Wrench, String> {
    if let Some(order) = order {
        return wrench(drive, body, position_m, turn, order)
            .map_err(|overlap| format!("{overlap}; allowed: magnets that touch or stand apart"));
    }
    let moment = |magnet: &Magnet| magnet.remanence_t * magnet.size_m.product();
    let found = dipole_wrench(moment(drive), turn * moment(body), position_m);
    let is_finite = |vector: Vector3<f64>| vector.iter().all(|number| number.is_finite());
    if is_finite(found.force_n) && is_finite(found.torque_n_m) {
        return Ok(found);
    }
    Err("the wrench of dipoles in one place is infinite; allowed: dipoles that stand apart".into())
}

/// The rotation of a quaternion w, x, y, z of any length but 0.
fn rotation(numbers: &[f64]) -> Option<UnitQuaternion<f64>> {
    let greatest = numbers.iter().fold(0.0_f64, |greatest, number| greatest.max(number.abs()));
    // Squares of tiny and of huge numbers are not numbers.
    let [w, x, y, z] = [0, 1, 2, 3].map(|k| numbers[k] / greatest);
    (greatest > 0.0).then(|| UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)))
}

/// An argument's k-th element by its index in the leading axes.
fn place(name: &str, leading: &[usize], k: usize) -> String {
    if leading.is_empty() {
        return name.into();
    }
    let (mut rest, mut index) = (k, Vec::new());
    for length in leading.iter().rev() {
        index.push(rest % length);
        rest /= length;
    }
    index.reverse();
    format!("{name}{index:?}")
}

/// A row of N numbers for each of so many points, on all cores where they are many.
fn filled<const N: usize>(
    py: Python<'_>,
    count: usize,
    write: impl Fn(usize, &mut [f64]) + Sync,
) -> PyResult<Vec<f64>> {
    let mut rows = zeros("the result", product(&[count, N]))?;
    let pool = Pool::new((count < FEW).then_some(1));
    interruptible(py, |interruption| pool.fill(interruption, &mut rows, N, &write))?;
    Ok(rows)
}

fn size(name: &str, edges: &Bound<'_, PyAny>) -> PyResult<Vector3<f64>> {
    Ok(Vector3::from_vec(read(name, edges, &[3])?))
}

/// All axes of an array of vectors but the last.
fn leading(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    match array::<f64>(name, value)?.shape() {
        [leading @ .., 3] => Ok(leading.to_vec()),
        other => Err(value_error(format!("{name} has shape {other:?}; expected (…, 3)"))),
    }
}

/// A row of a table.
fn vector(table: &[f64], row: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&table[3 * row..][..3])
}
