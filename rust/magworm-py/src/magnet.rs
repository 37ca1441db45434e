//! Fields and wrenches of cuboid magnets for Python.

use crate::arguments::{whole, word};
use crate::arrays::{array, read, shaped};
use crate::errors::value_error;
use crate::interruption::interruptible;
use crate::memory::{product, zeros};
use magworm::internals::Pool;
use magworm::internals::magnetic::{MAX_ORDER, Magnet, Wrench, dipole_wrench, field_t, wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numpy::{PyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

type Table<'py> = Bound<'py, PyArray2<f64>>;

/// Points for which no threads are started.
const FEW: usize = 256;

/// Flux density [T] of a cuboid at the origin. `magnetisation_t`, `points_m`: (P, 3).
#[pyfunction]
pub fn cuboid_field<'py>(
    size_m: &Bound<'py, PyAny>,
    magnetisation_t: &Bound<'py, PyAny>,
    points_m: &Bound<'py, PyAny>,
) -> PyResult<Table<'py>> {
    let py = points_m.py();
    let size = size("size_m", size_m)?;
    let count = rows("points_m", points_m)?;
    let magnetisation = read::<f64>("magnetisation_t", magnetisation_t, &[count, 3])?;
    let points = read::<f64>("points_m", points_m, &[count, 3])?;
    let flux = |k: usize, row: &mut [f64]| {
        let flux = field_t(size, vector(&magnetisation, k), vector(&points, k));
        row.copy_from_slice(flux.as_slice());
    };
    shaped(py, filled::<3>(py, count, flux)?, [count, 3])
}

/// Force [N] and torque [N·m] of a drive at the origin on bodies. Positions and magnetisations: (P, 3),
/// quaternions w, x, y, z: (P, 4).
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
    let count = rows("position_m", position_m)?;
    let positions = read::<f64>("position_m", position_m, &[count, 3])?;
    let quaternions = read::<f64>("quaternion", quaternion, &[count, 4])?;
    let drives = read::<f64>("drive_magnetisation_t", drive_magnetisation_t, &[count, 3])?;
    let bodies = read::<f64>("body_magnetisation_t", body_magnetisation_t, &[count, 3])?;
    let one = |k: usize| -> Wrench {
        let q = &quaternions[4 * k..][..4];
        let pose = UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]));
        let drive = Magnet { size_m: drive_size, remanence_t: vector(&drives, k) };
        let body = Magnet { size_m: body_size, remanence_t: vector(&bodies, k) };
        if dipole {
            let moment = |m: &Magnet| m.remanence_t * m.size_m.product();
            dipole_wrench(moment(&drive), pose * moment(&body), vector(&positions, k))
        } else {
            wrench(&drive, &body, vector(&positions, k), pose, order)
        }
    };
    let wrenches = filled::<6>(py, count, |k, row| {
        let Wrench { force_n, torque_n_m } = one(k);
        row[..3].copy_from_slice(force_n.as_slice());
        row[3..].copy_from_slice(torque_n_m.as_slice());
    })?;
    let half = |first: usize| {
        let mut half = zeros("the wrenches", product(&[count, 3]))?;
        let rows = half.chunks_exact_mut(3).zip(wrenches.chunks_exact(6));
        rows.for_each(|(half, row)| half.copy_from_slice(&row[first..][..3]));
        shaped(py, half, [count, 3])
    };
    Ok((half(0)?, half(3)?))
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

fn rows(name: &str, value: &Bound<'_, PyAny>) -> PyResult<usize> {
    match array::<f64>(name, value)?.shape() {
        [count, 3] => Ok(*count),
        other => Err(value_error(format!("{name} has shape {other:?}; expected (P, 3)"))),
    }
}

/// A row of a table.
fn vector(table: &[f64], row: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&table[3 * row..][..3])
}
