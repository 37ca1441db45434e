//! Magnets as points: enough far away, wrong near.
//!
//! The moment of a magnet is m = Br V/μ0. [`PlanarDipole::relative_error`] tells what the choice
//! of this model costs for given magnets and distance.

use super::{Cuboid, MAX_ORDER, MU_0, PlanarPair};
use crate::lanes::Real;
use crate::lanes::math::sin_cos;
use nalgebra::Vector3;

/// Drive and body magnet as two point dipoles in the simulator's plane, each magnetised along its
/// own height.
///
/// B = Br V/(4π r³) (3 (m̂·r̂) r̂ − m̂), F = ∇(m·B), T = m × B.
///
/// Cost of one [`wrench`](Self::wrench) per lane: 1 square root, 1 division, about 35 additions
/// and multiplications.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarDipole {
    /// Product of both volumes over 4π μ0 [m⁶·A²/N].
    scale: f64,
}

impl PlanarDipole {
    /// The dipoles of two cuboids.
    pub fn new(drive: Cuboid, body: Cuboid) -> Self {
        let volumes = drive.volume_m3() * body.volume_m3();
        PlanarDipole { scale: volumes / (4.0 * std::f64::consts::PI * MU_0) }
    }

    /// Force (F_x, F_y) [N] and torque T_z about the body's centre [N·m] on the body.
    ///
    /// `dx`, `dy` [m]: from the drive's centre to the body's; `cos`, `sin`: of the body's angle;
    /// `strength` [T²]: product of both remanences, negative where they oppose.
    #[inline(always)]
    pub fn wrench<F: Real>(&self, dx: F, dy: F, cos: F, sin: F, strength: F) -> [F; 3] {
        let inverse_square = dx.splat(1.0) / (dx * dx + dy * dy);
        let inverse = inverse_square.sqrt();
        let (ex, ey) = (dx * inverse, dy * inverse);
        // Moments: the drive's along (0, 1), the body's along (−sin, cos).
        let body_along = ey * cos - ex * sin;
        let cubed = strength * self.scale * (inverse * inverse_square);
        let fourth = cubed * inverse * 3.0;
        let radial = cos - ey * body_along * 5.0;
        let fx = fourth * (ex * radial - ey * sin);
        let fy = fourth * (ey * radial + body_along + ey * cos);
        let (bx, by) = (ey * ex * 3.0, ey * ey * 3.0 - 1.0);
        [fx, fy, -cubed * (sin * by + cos * bx)]
    }

    /// Error of the dipoles relative to the cuboids they stand for, with the body at
    /// (`dx_m`, `dy_m`) from the drive's centre and turned by `angle_rad`.
    ///
    /// The larger of |ΔF|/|F| and |ΔT|/(|T| + |F| r), r the distance of the centres: a torque that
    /// passes through zero is measured against the moment of the force.
    pub fn relative_error(
        drive: Cuboid,
        body: Cuboid,
        dx_m: f64,
        dy_m: f64,
        angle_rad: f64,
    ) -> f64 {
        let (sin, cos) = sin_cos(angle_rad);
        let point = PlanarDipole::new(drive, body).wrench(dx_m, dy_m, cos, sin, 1.0);
        let exact = PlanarPair::new(drive, body, MAX_ORDER).wrench(dx_m, dy_m, cos, sin, 1.0);
        let force = exact[0].hypot(exact[1]);
        let arm = dx_m.hypot(dy_m);
        let force_error = (point[0] - exact[0]).hypot(point[1] - exact[1]) / force;
        let torque_error = (point[2] - exact[2]).abs() / (exact[2].abs() + force * arm);
        force_error.max(torque_error)
    }
}

/// Flux density B [T] of a dipole at the origin, at `position_m` from it.
///
/// `moment_t_m3`: remanence times volume, that is μ0 m [T·m³].
pub fn dipole_field_t(moment_t_m3: Vector3<f64>, position_m: Vector3<f64>) -> Vector3<f64> {
    let r = position_m.norm();
    let e = position_m / r;
    (e * (3.0 * moment_t_m3.dot(&e)) - moment_t_m3) / (4.0 * std::f64::consts::PI * r.powi(3))
}

/// Wrench of one dipole on another (Yung, Landecker & Villani 1998), with the moments `drive` and `body`
/// [T·m³] (remanence times volume), `position_m` from the drive to the body.
pub fn dipole_wrench(
    drive: Vector3<f64>,
    body: Vector3<f64>,
    position_m: Vector3<f64>,
) -> super::Wrench {
    let r = position_m.norm();
    let e = position_m / r;
    let (along_drive, along_body) = (drive.dot(&e), body.dot(&e));
    let bracket = drive * along_body + body * along_drive + e * drive.dot(&body)
        - e * (5.0 * along_drive * along_body);
    let scale = 3.0 / (4.0 * std::f64::consts::PI * super::MU_0 * r.powi(4));
    super::Wrench {
        force_n: bracket * scale,
        torque_n_m: body.cross(&dipole_field_t(drive, position_m)) / super::MU_0,
    }
}
