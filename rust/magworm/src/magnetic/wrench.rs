//! Force and torque between two cuboid magnets anywhere in space, whatever their distance.
//!
//! | distance | how |
//! |---|---|
//! | beyond [`FAR`] sizes | both magnets as clouds of dipoles ([`far`](super::far)): the closed form cancels there |
//! | the body's longest edge or more between them | charged faces of one panel each ([`SpatialPair`]) |
//! | less, down to touching | panels cut where the field is steep ([`near`](super::near)) |

use super::far::{self, FAR};
use super::near::Near;
use super::separation::Separation;
use super::{GaussLegendre, Magnet, SpatialPair, Wrench};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// Depth up to which magnets count as touching, in parts of the longest edge: places are rounded.
const ROUNDING: f64 = 1e-9;

/// Two magnets share a part of space.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the magnets overlap by {depth_m:.3e} m")]
pub struct Overlap {
    /// The shortest way that would part them [m].
    pub depth_m: f64,
}

/// Wrench on `body` in the field of `drive`, in the drive's frame.
///
/// `position_m`: centre of the body; `drive_from_body`: its orientation; `order`: quadrature points per panel and
/// direction, 1..=[`MAX_ORDER`](super::MAX_ORDER). Magnets that are nearer than the body's longest edge, or touch, are
/// integrated until the force and the torque over half the body's diagonal change by less than 10^−(`order` + 1) of
/// their sum.
///
/// # Errors
/// The magnets overlap.
///
/// # Panics
/// If `order` is not in 1..=[`MAX_ORDER`](super::MAX_ORDER).
pub fn wrench(
    drive: &Magnet,
    body: &Magnet,
    position_m: Vector3<f64>,
    drive_from_body: UnitQuaternion<f64>,
    order: usize,
) -> Result<Wrench, Overlap> {
    let axes = drive_from_body.to_rotation_matrix().into_inner();
    let size_m = drive.size_m.max().max(body.size_m.max());
    if position_m.norm() > FAR * size_m {
        return Ok(far::wrench(drive, body, position_m, &axes));
    }
    let separation = Separation::new(drive.size_m, body.size_m, position_m, &axes);
    if separation.gap_m < -ROUNDING * size_m {
        return Err(Overlap { depth_m: -separation.gap_m });
    }
    if separation.gap_m < body.size_m.max() {
        let across = (axes.transpose() * separation.direction).iamax();
        let rule = GaussLegendre::new(order);
        let tolerance = (0..=order).fold(1.0, |tolerance, _| 0.1 * tolerance);
        return Ok(Near { drive, body, position_m, axes, across, rule, tolerance }.wrench());
    }
    Ok(apart(drive, body, position_m, &axes, order))
}

fn apart(
    drive: &Magnet,
    body: &Magnet,
    position_m: Vector3<f64>,
    axes: &Matrix3<f64>,
    order: usize,
) -> Wrench {
    let axes = [0, 1, 2].map(|k| axes.column(k).into_owned().into());
    let pair = SpatialPair::new(drive, body, order);
    let [fx, fy, fz, tx, ty, tz] = pair.wrench(position_m.into(), axes);
    Wrench { force_n: Vector3::new(fx, fy, fz), torque_n_m: Vector3::new(tx, ty, tz) }
}
