//! Direction of a magnet's remanence in the frame of its body: along it, up and to its side.

use super::SegmentMagnet;
use crate::lanes::math::{radians, sin_cos};
use crate::lanes::{Real, Vec3, Vector};

/// A direction; most magnets point up or, with a negative remanence, down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// Up.
    Up,
    /// Any other, as a unit vector.
    Oblique([f64; 3]),
}

impl Direction {
    /// The direction of a magnet's remanence, and its sign along it: straight down is against up.
    pub(crate) fn of(magnet: &SegmentMagnet) -> (Self, f64) {
        match unit_vector(magnet.angle_deg, magnet.aside_deg) {
            [_, 1.0, _] => (Self::Up, 1.0),
            [_, -1.0, _] => (Self::Up, -1.0),
            vector => (Self::Oblique(vector), 1.0),
        }
    }

    /// As a unit vector along the body, up and to its side.
    pub fn vector(&self) -> [f64; 3] {
        match *self {
            Self::Up => [0.0, 1.0, 0.0],
            Self::Oblique(vector) => vector,
        }
    }

    /// Cosine and sine of the angle in the plane of a frame whose up is the direction, from those of the body.
    #[inline(always)]
    pub fn frame<F: Real>(&self, cos: F, sin: F) -> [F; 2] {
        match *self {
            Self::Up => [cos, sin],
            Self::Oblique([along, up, _]) => [cos * up + sin * along, sin * up - cos * along],
        }
    }

    /// The direction in space of a body with these axes.
    #[inline(always)]
    pub fn in_space<F: Real>(&self, axes: &[Vec3<F>; 3]) -> Vec3<F> {
        match *self {
            Self::Up => axes[1],
            Self::Oblique(part) => Vector(
                [0, 1, 2]
                    .map(|k| axes[0][k] * part[0] + axes[1][k] * part[1] + axes[2][k] * part[2]),
            ),
        }
    }
}

/// Along the body, up and to the side: `angle_deg` from up towards the head, then `aside_deg` out of that plane [°].
/// Quarter turns are exact.
fn unit_vector(angle_deg: f64, aside_deg: f64) -> [f64; 3] {
    let (sin, cos) = sin_cos_deg(angle_deg);
    let (aside, flat) = sin_cos_deg(aside_deg);
    // Adding 0 turns −0 into 0.
    [-sin * flat + 0.0, cos * flat + 0.0, aside + 0.0]
}

/// Sine and cosine of an angle in degrees, by quarter turns and the rest.
fn sin_cos_deg(angle_deg: f64) -> (f64, f64) {
    let quarters = (angle_deg / 90.0).round();
    let (sin, cos) = sin_cos(radians(angle_deg - 90.0 * quarters));
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::unit_vector;

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(unit_vector(0.0, 0.0), [0.0, 1.0, 0.0]);
        assert_eq!(unit_vector(90.0, 0.0), [-1.0, 0.0, 0.0]);
        assert_eq!(unit_vector(-90.0, 0.0), [1.0, 0.0, 0.0]);
        assert_eq!(unit_vector(-180.0, 0.0), [0.0, -1.0, 0.0]);
        assert_eq!(unit_vector(30.0, 90.0), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn other_angles_lean_towards_the_head_and_aside() {
        let [along, up, side] = unit_vector(30.0, -20.0);
        let (flat, root) = (0.939_692_620_785_908_4, 0.866_025_403_784_438_6);
        assert!((along + 0.5 * flat).abs() < 1e-15 && (up - root * flat).abs() < 1e-15);
        assert!((side + 0.342_020_143_325_668_7).abs() < 1e-15);
    }
}
