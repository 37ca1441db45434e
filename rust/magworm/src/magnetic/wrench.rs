//! Force and torque between two cuboid magnets in space.

use super::cuboid::unit_field_outside;
use super::{GaussLegendre, MU_0};
use crate::lanes::Real;
use nalgebra::{UnitQuaternion, Vector3};

/// A cuboid magnet in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnet {
    /// Edge lengths [m].
    pub size_m: Vector3<f64>,
    /// Remanence with its direction [T].
    pub remanence_t: Vector3<f64>,
}

/// Force and torque on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force [N].
    pub force_n: Vector3<f64>,
    /// Torque about the body's centre [N·m].
    pub torque_n_m: Vector3<f64>,
}

/// Wrench on `body` in the field of `drive`, in the drive's frame.
///
/// `position_m`: centre of the body; `drive_from_body`: its orientation; `order`: quadrature
/// points per panel and direction, 1..=[`MAX_ORDER`](super::MAX_ORDER). The magnets must not
/// overlap. A face is one panel; where the drive is nearer than the face is long, the face is cut
/// into panels about as long as the distance, because the rate at which quadrature converges
/// depends on that ratio.
pub fn wrench(
    drive: &Magnet,
    body: &Magnet,
    position_m: Vector3<f64>,
    drive_from_body: UnitQuaternion<f64>,
    order: usize,
) -> Wrench {
    let axes = drive_from_body.to_rotation_matrix();
    let axes = [0, 1, 2].map(|k| axes.matrix().column(k).into_owned().into());
    let distance = corner_distance(drive, body, position_m, drive_from_body);
    let panels = [0, 1, 2].map(|k| (body.size_m[k] / distance).ceil().clamp(1.0, 8.0) as usize);
    let pair = SpatialPair::with_panels(drive, body, order, panels);
    let [fx, fy, fz, tx, ty, tz] = pair.wrench(position_m.into(), axes);
    Wrench { force_n: Vector3::new(fx, fy, fz), torque_n_m: Vector3::new(tx, ty, tz) }
}

/// Smallest distance of a corner of the body from the drive [m].
fn corner_distance(
    drive: &Magnet,
    body: &Magnet,
    position_m: Vector3<f64>,
    drive_from_body: UnitQuaternion<f64>,
) -> f64 {
    let distance = |corner: usize| {
        let side = |k: usize| if corner >> k & 1 == 0 { -0.5 } else { 0.5 };
        let corner = body.size_m.component_mul(&Vector3::new(side(0), side(1), side(2)));
        let at = position_m + drive_from_body * corner;
        (at.abs() - 0.5 * drive.size_m).sup(&Vector3::zeros()).norm()
    };
    (0..8).map(distance).fold(f64::INFINITY, f64::min)
}

/// Two magnets prepared for [`wrench`](Self::wrench) in lanes.
///
/// The faces of the body carry the charge σ = J·n/μ0 and feel F = ∬ σ B dS, T = ∬ σ r × B dS,
/// by Gauss–Legendre quadrature on each face that carries charge.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialPair {
    drive_half: [f64; 3],
    drive_remanence: [f64; 3],
    body_half: [f64; 3],
    body_remanence: [f64; 3],
    /// Nodes and weights along each axis of the body, relative to its half size.
    points: [Vec<[f64; 2]>; 3],
}

impl SpatialPair {
    /// A pair with `order` points per face and direction.
    ///
    /// # Panics
    /// If `order` is not in 1..=[`MAX_ORDER`](super::MAX_ORDER).
    pub fn new(drive: &Magnet, body: &Magnet, order: usize) -> Self {
        Self::with_panels(drive, body, order, [1; 3])
    }

    /// A pair whose faces are cut into `panels` along each axis, with `order` points per panel
    /// and direction.
    ///
    /// # Panics
    /// If `order` is not in 1..=[`MAX_ORDER`](super::MAX_ORDER).
    pub fn with_panels(drive: &Magnet, body: &Magnet, order: usize, panels: [usize; 3]) -> Self {
        let rule = GaussLegendre::new(order);
        SpatialPair {
            drive_half: (0.5 * drive.size_m).into(),
            drive_remanence: drive.remanence_t.into(),
            body_half: (0.5 * body.size_m).into(),
            body_remanence: body.remanence_t.into(),
            points: panels.map(|count| rule.composite(count)),
        }
    }

    /// Force [N] and torque about the body's centre [N·m] on the body, in the drive's frame.
    ///
    /// `offset` [m]: centre of the body; `axes`: the body's three unit axes. Each point costs
    /// one [`unit_field_outside`] per axis along which the drive is magnetised.
    #[inline(always)]
    pub fn wrench<F: Real>(&self, offset: [F; 3], axes: [[F; 3]; 3]) -> [F; 6] {
        let mut total = [offset[0].splat(0.0); 6];
        for n in 0..3 {
            if self.body_remanence[n] != 0.0 {
                self.add_faces(n, offset, axes, &mut total);
            }
        }
        total
    }

    /// Adds both faces across axis `n` of the body.
    #[inline(always)]
    fn add_faces<F: Real>(&self, n: usize, offset: [F; 3], axes: [[F; 3]; 3], total: &mut [F; 6]) {
        let (s, t) = ((n + 1) % 3, (n + 2) % 3);
        let h = self.body_half;
        let scale = self.body_remanence[n] * h[s] * h[t] / MU_0;
        for [xs, ws] in &self.points[s] {
            for [xt, wt] in &self.points[t] {
                for side in [1.0, -1.0] {
                    let mut r = offset;
                    let mut at = offset;
                    for i in 0..3 {
                        r[i] = axes[n][i] * (side * h[n])
                            + axes[s][i] * (xs * h[s])
                            + axes[t][i] * (xt * h[t]);
                        at[i] = offset[i] + r[i];
                    }
                    add_charge(r, self.drive_field(at), side * scale * ws * wt, total);
                }
            }
        }
    }

    /// B of the drive [T] at a point outside it.
    #[inline(always)]
    fn drive_field<F: Real>(&self, at: [F; 3]) -> [F; 3] {
        let mut field = [at[0].splat(0.0); 3];
        for n in 0..3 {
            let (s, t) = ((n + 1) % 3, (n + 2) % 3);
            let (h, j) = (self.drive_half, self.drive_remanence[n]);
            if j != 0.0 {
                let b = unit_field_outside([h[s], h[t], h[n]], [at[s], at[t], at[n]]);
                field[s] = field[s] + b[0] * j;
                field[t] = field[t] + b[1] * j;
                field[n] = field[n] + b[2] * j;
            }
        }
        field
    }
}

/// Adds the force q B and the torque r × q B.
#[inline(always)]
fn add_charge<F: Real>(r: [F; 3], b: [F; 3], charge: f64, total: &mut [F; 6]) {
    let f = [b[0] * charge, b[1] * charge, b[2] * charge];
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        total[i] = total[i] + f[i];
        total[3 + i] = total[3 + i] + (r[j] * f[k] - r[k] * f[j]);
    }
}
