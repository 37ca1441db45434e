//! Magnets that are far away, as clouds of dipoles.
//!
//! Seen from r sizes away, a magnet's closed-form field is a difference of numbers r³ times greater, the force between
//! two of them r⁴ times. A cloud does not cancel: the dipoles stand at the 27 Gauss points of the volume and carry their
//! weights, which is exact for all multipoles up to the fifth. From [`FAR`] sizes on, what is left is below 10⁻¹⁰ of the
//! field, and falls with the sixth power of the distance.

use super::dipole::{dipole_field_t, dipole_wrench};
use super::{Magnet, Wrench};
use nalgebra::{Matrix3, Vector3};

/// Distance in longest edges beyond which magnets are clouds.
pub(super) const FAR: f64 = 30.0;

/// Gauss–Legendre rule of three points on [−1, 1]: ±√(3/5).
const NODES: [f64; 3] = [-0.774_596_669_241_483_4, 0.0, 0.774_596_669_241_483_4];
const WEIGHTS: [f64; 3] = [5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0];

/// B [T] at `position_m` from a magnet in its own frame.
pub(super) fn field_t(
    size_m: Vector3<f64>,
    remanence_t: Vector3<f64>,
    position_m: Vector3<f64>,
) -> Vector3<f64> {
    let dipole = |(place, volume)| dipole_field_t(remanence_t * volume, position_m - place);
    cloud(size_m).map(dipole).iter().sum()
}

/// Wrench on `body` at `position_m`, turned by `axes`, in the field of `drive`.
pub(super) fn wrench(
    drive: &Magnet,
    body: &Magnet,
    position_m: Vector3<f64>,
    axes: &Matrix3<f64>,
) -> Wrench {
    let remanence_t = axes * body.remanence_t;
    let sources = cloud(drive.size_m);
    let mut total = Wrench::default();
    for (arm_m, volume_m3) in cloud(body.size_m).map(|(place, volume)| (axes * place, volume)) {
        for (place_m, source_m3) in sources {
            let offset_m = position_m + arm_m - place_m;
            let Wrench { force_n, torque_n_m } =
                dipole_wrench(drive.remanence_t * source_m3, remanence_t * volume_m3, offset_m);
            total.force_n += force_n;
            total.torque_n_m += torque_n_m + arm_m.cross(&force_n);
        }
    }
    total
}

/// Places and volumes of the dipoles of a cuboid.
fn cloud(size_m: Vector3<f64>) -> [(Vector3<f64>, f64); 27] {
    let eighth_m3 = 0.125 * size_m.product();
    std::array::from_fn(|k| {
        let point = [k % 3, k / 3 % 3, k / 9];
        let node = Vector3::from(point.map(|k| NODES[k]));
        let weight: f64 = point.iter().map(|&k| WEIGHTS[k]).product();
        (0.5 * size_m.component_mul(&node), weight * eighth_m3)
    })
}
