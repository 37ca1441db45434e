//! Wrench between two cuboids in space: the kernel of every step there.

use super::cuboid::unit_field_outside;
use super::{GaussLegendre, MU_0, Magnet};
use crate::lanes::Real;

/// Two magnets far enough apart that a face is one panel, prepared for [`wrench`](Self::wrench) in lanes.
///
/// The faces of the body carry the charge σ = J·n/μ0 and feel F = ∬ σ B dS, T = ∬ σ r × B dS,
/// by Gauss–Legendre quadrature on each face that carries charge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialPair {
    drive_half: [f64; 3],
    drive_remanence: [f64; 3],
    body_half: [f64; 3],
    body_remanence: [f64; 3],
    rule: GaussLegendre,
}

impl SpatialPair {
    /// A pair with `order` points per face and direction.
    ///
    /// # Panics
    /// If `order` is not in 1..=[`MAX_ORDER`](super::MAX_ORDER).
    pub fn new(drive: &Magnet, body: &Magnet, order: usize) -> Self {
        SpatialPair {
            drive_half: (0.5 * drive.size_m).into(),
            drive_remanence: drive.remanence_t.into(),
            body_half: (0.5 * body.size_m).into(),
            body_remanence: body.remanence_t.into(),
            rule: GaussLegendre::new(order),
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
        for (xs, ws) in self.rule.points() {
            for (xt, wt) in self.rule.points() {
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
