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
        let length = |x: f64, y: f64| (x * x + y * y).sqrt();
        let (force, arm) = (length(exact[0], exact[1]), length(dx_m, dy_m));
        let force_error = length(point[0] - exact[0], point[1] - exact[1]) / force;
        let torque_error = (point[2] - exact[2]).abs() / (exact[2].abs() + force * arm);
        force_error.max(torque_error)
    }
}

/// Drive and body magnet as two point dipoles in space, the drive's moment along y, both of 1 T.
///
/// F = 3/(4πμ0 r⁴) [a (b·e) + b (a·e) + e (a·b) − 5 e (a·e)(b·e)] (Yung, Landecker & Villani 1998) with the
/// moments a of the drive and b of the body and e from the drive to the body; T = b × B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialDipole {
    /// Product of both volumes over 4π μ0 [m⁶·A²/N].
    scale: f64,
}

impl SpatialDipole {
    /// The dipoles of two cuboids.
    pub fn new(drive: Cuboid, body: Cuboid) -> Self {
        let volumes = drive.volume_m3() * body.volume_m3();
        SpatialDipole { scale: volumes / (4.0 * std::f64::consts::PI * MU_0) }
    }

    /// Force [N] and torque [N·m] on a body at `offset` [m] from the drive, with its moment along `up`.
    #[inline(always)]
    pub fn wrench<F: Real>(&self, offset: &[F; 3], up: &[F; 3]) -> [F; 6] {
        let [x, y, z] = *offset;
        let inverse_square = x.splat(1.0) / (x * x + y * y + z * z);
        let inverse = inverse_square.sqrt();
        let e = [x * inverse, y * inverse, z * inverse];
        let along = up[0] * e[0] + up[1] * e[1] + up[2] * e[2];
        let cubed = inverse * inverse_square * self.scale;
        let fourth = cubed * inverse * 3.0;
        let radial = up[1] - e[1] * along * 5.0;
        let force = [
            fourth * (up[0] * e[1] + e[0] * radial),
            fourth * (along + up[1] * e[1] + e[1] * radial),
            fourth * (up[2] * e[1] + e[2] * radial),
        ];
        let b = [e[0] * e[1] * 3.0, e[1] * e[1] * 3.0 - 1.0, e[2] * e[1] * 3.0];
        let torque = [
            cubed * (up[1] * b[2] - up[2] * b[1]),
            cubed * (up[2] * b[0] - up[0] * b[2]),
            cubed * (up[0] * b[1] - up[1] * b[0]),
        ];
        [force[0], force[1], force[2], torque[0], torque[1], torque[2]]
    }
}

/// Flux density B [T] of a dipole at the origin, at `position_m` from it.
///
/// `moment_t_m3`: remanence times volume, that is μ0 m [T·m³].
pub fn dipole_field_t(moment_t_m3: Vector3<f64>, position_m: Vector3<f64>) -> Vector3<f64> {
    let r = position_m.norm();
    let e = position_m / r;
    (e * (3.0 * moment_t_m3.dot(&e)) - moment_t_m3) / (4.0 * std::f64::consts::PI * (r * r * r))
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
    let scale = 3.0 / (4.0 * std::f64::consts::PI * super::MU_0 * (r * r * r * r));
    super::Wrench {
        force_n: bracket * scale,
        torque_n_m: body.cross(&dipole_field_t(drive, position_m)) / super::MU_0,
    }
}
