//! Motion of the drive magnets.

mod belt;
mod stage;

pub use belt::Layout;
pub use stage::StageModel;

use crate::lanes::math::radians;
use crate::scene::{Drive, Motion, Reference};

/// How the drive's magnets stand and move; heights are of their centres.
#[derive(Clone, Debug)]
pub struct DriveModel {
    /// Places of the magnets around the stage.
    pub layout: Layout,
    /// Motion of the stage.
    pub path: Path,
}

/// Axes of a stage: x, y in the plane; x, y, z and yaw in space.
pub const fn stage_axes(dimensions: usize) -> usize {
    if dimensions == 2 { 2 } else { 4 }
}

/// Motion of the stage. Places are x, y, z [m] and yaw [rad]; in the plane the last two are 0.
#[derive(Clone, Debug)]
pub enum Path {
    /// Follows actions.
    Controlled(StageModel),
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

impl DriveModel {
    /// The motion that a scene asks for.
    pub fn new(drive: &Drive) -> Self {
        let centre_m = match drive.reference {
            Reference::Centre => 0.0,
            Reference::Top => -0.5 * drive.height_m,
        };
        let path = match &drive.motion {
            Motion::Controlled(limits) => Path::Controlled(StageModel {
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
            Motion::Constant { x_m, y_m, speed_m_s, z_m, yaw_deg } => Path::Constant {
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
                Path::Waypoints { time_s: time_s.clone(), point }
            }
        };
        Self { layout: Layout::new(&drive.arrangement), path }
    }

    /// Whether the drive follows actions.
    pub fn is_controlled(&self) -> bool {
        matches!(self.path, Path::Controlled(_))
    }
}

/// Place and velocity on straight lines between points in time.
pub fn on_waypoints(time_s: &[f64], point: &[[f64; 4]], now_s: f64) -> ([f64; 4], [f64; 4]) {
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
