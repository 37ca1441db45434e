//! One axis that moves to a target as fast as its speed and acceleration allow.

use crate::lanes::Real;

/// One step of one axis towards `target`, no faster than `limit`: (position, velocity) after it.
///
/// Braking by a Δt every step, an axis that moves at v covers at most v²/2a + v Δt/2 + a Δt²/8 until it
/// stands (the last term where v is no multiple of a Δt). Solved for v that is √(2ad) − a Δt/2; from
/// no more than a Δt it stops at once and may land on the target.
#[inline(always)]
pub fn advance<F: Real>(
    acceleration: f64,
    position: F,
    velocity: F,
    target: F,
    limit: F,
    dt: f64,
) -> (F, F) {
    let distance = target - position;
    let away = distance.abs();
    let gain = acceleration * dt;
    let braking = (away * (2.0 * acceleration)).sqrt() - 0.5 * gain;
    let landing = (away / dt).min(away.splat(gain));
    let speed = braking.max(landing).min(limit);
    let aim = speed.copysign(distance);
    let change = (aim - velocity).clamp(aim.splat(-gain), aim.splat(gain));
    let velocity = velocity + change;
    (position + velocity * dt, velocity)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn reaches_its_target_without_overshoot_within_its_limits(
            target in -0.1..0.1f64, limit in 0.01..0.21f64, dt in 1e-4..5e-3f64,
        ) {
            let (mut x, mut v) = (0.0, 0.0);
            for _ in 0..(15.0 / dt) as usize {
                let (next, speed) = advance(5.0, x, v, target, limit, dt);
                prop_assert!(speed.abs() <= limit * (1.0 + 1e-12));
                prop_assert!((speed - v).abs() <= 5.0 * dt * (1.0 + 1e-12));
                prop_assert!((next - target) * target.signum() <= 1e-12);
                (x, v) = (next, speed);
            }
            prop_assert!((x - target).abs() < 1e-9);
        }
    }
}
