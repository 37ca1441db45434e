//! What a body does to its drive: every force has an equal and opposite one.
//!
//! With d from the drive's centre to the body's, F and T on the body, the drive feels −F and, about its own centre,
//! −(T + d × F). Both momenta are then kept to rounding, whatever the quadrature.

use crate::lanes::Real;

/// In the plane: (F_x, F_y, T_z) on the drive from those on a body at `offset`.
#[inline(always)]
pub fn planar_reaction<F: Real>(offset: [F; 2], [fx, fy, torque]: [F; 3]) -> [F; 3] {
    let [x, y] = offset;
    [-fx, -fy, -(torque + (x * fy - y * fx))]
}

/// In space: force and torque on the drive from those on a body at `offset`.
#[inline(always)]
pub fn spatial_reaction<F: Real>(offset: [F; 3], wrench: [F; 6]) -> [F; 6] {
    let [x, y, z] = offset;
    let [fx, fy, fz, tx, ty, tz] = wrench;
    [-fx, -fy, -fz, -(tx + (y * fz - z * fy)), -(ty + (z * fx - x * fz)), -(tz + (x * fy - y * fx))]
}
