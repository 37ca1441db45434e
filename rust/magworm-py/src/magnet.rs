//! Fields and wrenches of cuboid magnets for Python.

use crate::arrays::read;
use crate::errors::value_error;
use magworm::internals::magnetic::{MAX_ORDER, Magnet, Wrench, dipole_wrench, field_t, wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numpy::{IntoPyArray, PyArray2, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

type Table<'py> = Bound<'py, PyArray2<f64>>;

/// Flux density [T] of a cuboid at the origin. `magnetisation_t`, `points_m`: (P, 3).
#[pyfunction]
pub fn cuboid_field<'py>(
    py: Python<'py>,
    size_m: [f64; 3],
    magnetisation_t: PyReadonlyArrayDyn<'py, f64>,
    points_m: PyReadonlyArrayDyn<'py, f64>,
) -> PyResult<Table<'py>> {
    let count = rows(&points_m)?;
    let magnetisation = vectors("magnetisation_t", &magnetisation_t, count)?;
    let points = vectors("points_m", &points_m, count)?;
    let flux = py.detach(|| {
        let pairs = points.iter().zip(&magnetisation);
        pairs
            .map(|(&point, &remanence)| field_t(Vector3::from(size_m), remanence, point))
            .collect::<Vec<_>>()
    });
    table(py, &flux)
}

/// Force [N] and torque [N·m] of a drive at the origin on bodies. Positions and magnetisations: (P, 3),
/// quaternions w, x, y, z: (P, 4).
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the signature is the Python one")]
pub fn cuboid_wrench<'py>(
    py: Python<'py>,
    drive_size_m: [f64; 3],
    body_size_m: [f64; 3],
    position_m: PyReadonlyArrayDyn<'py, f64>,
    quaternion: PyReadonlyArrayDyn<'py, f64>,
    drive_magnetisation_t: PyReadonlyArrayDyn<'py, f64>,
    body_magnetisation_t: PyReadonlyArrayDyn<'py, f64>,
    order: usize,
    model: &str,
) -> PyResult<(Table<'py>, Table<'py>)> {
    if order == 0 || order > MAX_ORDER {
        return Err(value_error(format!("order is {order}; allowed: 1 to {MAX_ORDER}")));
    }
    let dipole = match model {
        "cuboid" => false,
        "dipole" => true,
        other => {
            return Err(value_error(format!(
                "model is {other:?}; allowed: \"cuboid\", \"dipole\""
            )));
        }
    };
    let count = rows(&position_m)?;
    let positions = vectors("position_m", &position_m, count)?;
    let quaternions = read("quaternion", &quaternion, &[count, 4])?;
    let drives = vectors("drive_magnetisation_t", &drive_magnetisation_t, count)?;
    let bodies = vectors("body_magnetisation_t", &body_magnetisation_t, count)?;
    let wrenches = py.detach(|| {
        let pose = |k: usize| {
            let q = &quaternions[4 * k..][..4];
            UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]))
        };
        let one = |k: usize| -> Wrench {
            let drive = Magnet { size_m: drive_size_m.into(), remanence_t: drives[k] };
            let body = Magnet { size_m: body_size_m.into(), remanence_t: bodies[k] };
            if dipole {
                let moment = |m: &Magnet| m.remanence_t * m.size_m.product();
                dipole_wrench(moment(&drive), pose(k) * moment(&body), positions[k])
            } else {
                wrench(&drive, &body, positions[k], pose(k), order)
            }
        };
        (0..count).map(one).collect::<Vec<_>>()
    });
    let forces: Vec<_> = wrenches.iter().map(|w| w.force_n).collect();
    let torques: Vec<_> = wrenches.iter().map(|w| w.torque_n_m).collect();
    Ok((table(py, &forces)?, table(py, &torques)?))
}

fn rows(array: &PyReadonlyArrayDyn<'_, f64>) -> PyResult<usize> {
    match array.shape() {
        [count, 3] => Ok(*count),
        other => Err(value_error(format!("points have shape {other:?}; expected (P, 3)"))),
    }
}

fn vectors(
    name: &str,
    array: &PyReadonlyArrayDyn<'_, f64>,
    count: usize,
) -> PyResult<Vec<Vector3<f64>>> {
    let numbers = read(name, array, &[count, 3])?;
    Ok(numbers.chunks_exact(3).map(|v| Vector3::new(v[0], v[1], v[2])).collect())
}

fn table<'py>(py: Python<'py>, vectors: &[Vector3<f64>]) -> PyResult<Table<'py>> {
    let numbers: Vec<f64> = vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    numbers.into_pyarray(py).reshape([vectors.len(), 3])
}
