//! How many quadrature points two cuboids need at a distance of their centres.
//!
//! The field is analytic up to the nearest point of its source. With c the least distance of that from the middle of a charged
//! face and h half the longest edge, Gauss's rule of n points errs as ρ⁻²ⁿ with ρ + 1/ρ = 2 c/h (L. N. Trefethen, SIAM
//! Review 50, 2008). Measured over shapes and directions the error of the force is 3 to 40 ρ⁻²ⁿ of that of two dipoles in
//! line at the same distance, so a rule is taken from where 10 ρ⁻²ⁿ ≤ 5e-4.

use super::Magnet;

/// Each order with its least c/h, from the fewest points to the most.
const ORDERS: [(usize, f64); 4] = [(2, 5.99), (3, 2.71), (5, 1.54), (10, f64::NEG_INFINITY)];

/// The orders, each with the distance from which on it is enough [m]; the most points at any.
pub fn orders_by_distance(source: &Magnet, target: &Magnet) -> [(usize, f64); 4] {
    let half_m = 0.5 * target.size_m;
    // From the centre of the target to the middle of its furthest charged face.
    let charged = target.remanence_t.map(|part| if part == 0.0 { 0.0 } else { 1.0 });
    let face_m = half_m.component_mul(&charged).max();
    let nearest_m = 0.5 * source.size_m.norm() + face_m;
    ORDERS.map(|(order, ratio)| (order, (nearest_m + ratio * half_m.max()).max(0.0)))
}
