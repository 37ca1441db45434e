//! Places of the drive magnets relative to their stage.

use crate::lanes::Real;
use crate::lanes::math::round;
use crate::scene::Arrangement;

/// Offsets of the magnets along x, and the distance after which a belt comes round.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Offset of each magnet from the stage along x [m].
    pub offset_m: Vec<f64>,
    /// 1, or −1 where a magnet is opposed to the first.
    pub polarity: Vec<f64>,
    /// Length of the belt; none where there is no belt [m].
    pub circumference_m: Option<f64>,
}

impl Layout {
    /// The places of an arrangement. On a belt the first magnet leads a motion in +x.
    pub fn new(arrangement: &Arrangement) -> Self {
        match *arrangement {
            Arrangement::Single => {
                Self { offset_m: vec![0.0], polarity: vec![1.0], circumference_m: None }
            }
            Arrangement::Pair { spacing_m, second_polarity } => Self {
                offset_m: vec![-0.5 * spacing_m, 0.5 * spacing_m],
                polarity: vec![1.0, f64::from(second_polarity)],
                circumference_m: None,
            },
            Arrangement::Belt { pitch_m, count } => Self {
                offset_m: (0..count).map(|k| -(k as f64) * pitch_m).collect(),
                polarity: vec![1.0; count],
                circumference_m: Some(count as f64 * pitch_m),
            },
        }
    }

    /// Where magnet `k` is along x, given the stage and the robot's centre: on a belt the image
    /// nearest to the robot, since the belt comes round beneath it again and again.
    #[inline(always)]
    pub fn position<F: Real>(&self, k: usize, stage: F, robot: F) -> F {
        let x = stage + self.offset_m[k];
        match self.circumference_m {
            None => x,
            Some(length) => {
                let turns = round((x - robot) / length);
                x - turns * length
            }
        }
    }

    /// Where magnet `k` is in space along x and z, given the stage, the robot's centre along x, and sine and
    /// cosine of the stage's yaw. A pair turns with the stage; a belt keeps its direction along x, and its
    /// magnets turn where they are.
    #[inline(always)]
    pub fn place<F: Real>(
        &self,
        k: usize,
        stage_x: F,
        stage_z: F,
        robot: F,
        sin: F,
        cos: F,
    ) -> [F; 2] {
        if self.circumference_m.is_some() {
            return [self.position(k, stage_x, robot), stage_z];
        }
        [stage_x + cos * self.offset_m[k], stage_z - sin * self.offset_m[k]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn belt_images_stay_within_half_a_round_of_the_robot() {
        let belt = Layout::new(&Arrangement::Belt { pitch_m: 0.125, count: 3 });
        for step in -40..40 {
            let stage = 0.031 * f64::from(step);
            let mut places: Vec<f64> = (0..3).map(|k| belt.position(k, stage, 0.4)).collect();
            places.sort_by(f64::total_cmp);
            assert!(places.iter().all(|x| (x - 0.4).abs() <= 0.1875 + 1e-12));
            assert!((places[1] - places[0] - 0.125).abs() < 1e-12);
            assert!((places[2] - places[1] - 0.125).abs() < 1e-12);
        }
    }
}
