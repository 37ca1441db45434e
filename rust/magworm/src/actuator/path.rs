//! Motion that the scene prescribes, or a controller within limits.

use super::axis;
use super::rows::{ActuatorRows, Clock};
use crate::lanes::math::radians;
use crate::lanes::{Dim, Isa, Number, Row};
use crate::scene::{Drive, Motion, Reference};

/// Motion of a stage. Places are x, y, z [m] and yaw [rad]; in the plane the last two are 0.
#[derive(Clone, Debug)]
pub enum Path {
    /// Follows commands.
    Controlled(Limits),
    /// x = start + speed · t.
    Constant {
        /// Start.
        start: [f64; 4],
        /// Velocity along x [m/s].
        speed_m_s: f64,
    },
    /// Straight lines in time.
    Waypoints {
        /// Times [s].
        time_s: Vec<f64>,
        /// Places.
        point: Vec<[f64; 4]>,
    },
}

/// Limits of a stage that follows commands; heights are of the magnets' centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Furthest target ahead of or behind the robot's centre [m].
    pub reach_m: f64,
    /// Furthest target to either side of it, in space [m].
    pub lateral_reach_m: f64,
    /// Furthest turn from the robot's heading, in space [rad].
    pub yaw_reach_rad: f64,
    /// Lowest height [m].
    pub lowest_m: f64,
    /// Greatest height [m].
    pub highest_m: f64,
    /// Greatest speed of each straight axis [m/s].
    pub speed_m_s: f64,
    /// Greatest acceleration of each straight axis [m/s²].
    pub acceleration_m_s2: f64,
    /// Greatest speed of the yaw [rad/s].
    pub yaw_speed_rad_s: f64,
    /// Greatest acceleration of the yaw [rad/s²].
    pub yaw_acceleration_rad_s2: f64,
}

impl Limits {
    /// Greatest acceleration of an axis: x, y, z [m/s²] or yaw [rad/s²].
    fn acceleration(&self, axis: usize) -> f64 {
        if axis == YAW { self.yaw_acceleration_rad_s2 } else { self.acceleration_m_s2 }
    }
}

/// The axis of yaw, after x, y and z.
pub(super) const YAW: usize = 3;

/// Places and velocities of the axes of a stage.
type Motions<F> = ([F; 4], [F; 4]);

impl Path {
    /// The motion that a scene asks for.
    pub fn new(drive: &Drive) -> Self {
        let centre_m = match drive.reference {
            Reference::Centre => 0.0,
            Reference::Top => -0.5 * drive.height_m,
        };
        match &drive.motion {
            Motion::Controlled(limits) => Self::Controlled(Limits {
                reach_m: limits.reach_m,
                lateral_reach_m: limits.lateral_reach_m,
                yaw_reach_rad: radians(limits.yaw_reach_deg),
                lowest_m: limits.lowest_m + centre_m,
                highest_m: limits.highest_m + centre_m,
                speed_m_s: limits.speed_m_s,
                acceleration_m_s2: limits.acceleration_m_s2,
                yaw_speed_rad_s: radians(limits.yaw_speed_deg_s),
                yaw_acceleration_rad_s2: radians(limits.yaw_acceleration_deg_s2),
            }),
            Motion::Constant { x_m, y_m, speed_m_s, z_m, yaw_deg } => Self::Constant {
                start: [*x_m, y_m + centre_m, *z_m, radians(*yaw_deg)],
                speed_m_s: *speed_m_s,
            },
            Motion::Waypoints { time_s, x_m, y_m, z_m, yaw_deg } => {
                // An axis that is left out stays at 0.
                let at = |axis: &[f64], k: usize| axis.get(k).copied().unwrap_or(0.0);
                let point = |k: usize| {
                    let yaw = radians(at(yaw_deg, k));
                    [x_m[k], y_m[k] + centre_m, at(z_m, k), yaw]
                };
                let point = (0..time_s.len()).map(point).collect();
                Self::Waypoints { time_s: time_s.clone(), point }
            }
        }
    }

    /// Where the stage is at the end of a step, and how fast it moves.
    #[inline(always)]
    pub fn advance<D: Dim, I: Isa>(
        &self,
        isa: I,
        rows: &ActuatorRows<'_, I::Row>,
        clock: Clock<'_, I>,
    ) -> Motions<I::F> {
        match self {
            Self::Controlled(limits) => follow::<D, I>(isa, limits, rows, clock.step_s),
            Self::Constant { start, speed_m_s } => on_lanes(isa, clock, |lane, time_s| {
                let speed = clock.speed_factor[lane].f64() * speed_m_s;
                let [x, y, z, yaw] = *start;
                ([speed * time_s + x, y, z, yaw], [speed, 0.0, 0.0, 0.0])
            }),
            Self::Waypoints { time_s, point } => {
                on_lanes(isa, clock, |_, now_s| on_waypoints(time_s, point, now_s))
            }
        }
    }
}

/// Each axis on its own towards its target; yaw is as much slower as its limit is.
#[inline(always)]
fn follow<D: Dim, I: Isa>(
    isa: I,
    limits: &Limits,
    rows: &ActuatorRows<'_, I::Row>,
    step_s: f64,
) -> Motions<I::F> {
    let zero = isa.splat(0.0);
    let (mut place, mut speed) = ([zero; 4], [zero; 4]);
    let greatest = isa.load(&rows.target[D::STAGE]);
    for axis in 0..D::STAGE {
        let limit = if axis == YAW {
            greatest * (limits.yaw_speed_rad_s / limits.speed_m_s)
        } else {
            greatest
        };
        (place[axis], speed[axis]) = axis::advance(
            limits.acceleration(axis),
            isa.load(&rows.state[axis]),
            isa.load(&rows.state[D::STAGE + axis]),
            isa.load(&rows.target[axis]),
            limit,
            step_s,
        );
    }
    (place, speed)
}

/// A motion in time, lane by lane: environments may have been reset at different times. In `f64` whatever the precision of a
/// step, in which times are soon longer than their differences can be told.
#[inline(always)]
fn on_lanes<I: Isa>(
    isa: I,
    clock: Clock<'_, I>,
    motion: impl Fn(usize, f64) -> ([f64; 4], [f64; 4]),
) -> Motions<I::F> {
    let (mut places, mut speeds) = ([I::Row::zeros(); 4], [I::Row::zeros(); 4]);
    for lane in 0..I::Row::LANES {
        let (place, speed) = motion(lane, clock.steps[lane] as f64 * clock.step_s);
        for axis in 0..4 {
            places[axis][lane] = Number::of(place[axis]);
            speeds[axis][lane] = Number::of(speed[axis]);
        }
    }
    (places.map(|row| isa.load(&row)), speeds.map(|row| isa.load(&row)))
}

/// Place and velocity on straight lines between points in time.
fn on_waypoints(time_s: &[f64], point: &[[f64; 4]], now_s: f64) -> ([f64; 4], [f64; 4]) {
    let next = time_s.partition_point(|&t| t <= now_s);
    if next == 0 || next == time_s.len() {
        return (point[next.min(time_s.len() - 1)], [0.0; 4]);
    }
    let (start_s, end_s) = (time_s[next - 1], time_s[next]);
    let (a, b) = (point[next - 1], point[next]);
    let velocity = std::array::from_fn(|k| (b[k] - a[k]) / (end_s - start_s));
    let position = std::array::from_fn(|k| a[k] + velocity[k] * (now_s - start_s));
    (position, velocity)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waypoints_hold_still_before_and_after() {
        let (time, points) = (
            [0.0, 0.5, 0.8],
            [[0.0, -0.052, 0.0, 0.0], [0.0, -0.022, 0.0, 0.0], [0.01, -0.022, 0.0, 0.0]],
        );
        assert_eq!(on_waypoints(&time, &points, -1.0).0, points[0]);
        assert_eq!(on_waypoints(&time, &points, 9.0), (points[2], [0.0; 4]));
        let (position, velocity) = on_waypoints(&time, &points, 0.25);
        assert!((position[1] + 0.037).abs() < 1e-15 && (velocity[1] - 0.06).abs() < 1e-15);
    }
}
