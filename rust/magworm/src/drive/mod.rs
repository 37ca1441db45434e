//! Motion of the drive magnets.

mod belt;
mod stage;

pub use belt::Layout;
pub use stage::StageModel;

use crate::scene::{Drive, Motion, Reference};

/// How the drive's magnets stand and move; heights are of their centres.
#[derive(Clone, Debug)]
pub struct DriveModel {
    /// Places of the magnets around the stage.
    pub layout: Layout,
    /// Motion of the stage.
    pub path: Path,
}

/// Motion of the stage.
#[derive(Clone, Debug)]
pub enum Path {
    /// Follows actions.
    Controlled(StageModel),
    /// x = start + speed · t.
    Constant {
        /// Start (x, y) [m].
        start_m: [f64; 2],
        /// Velocity along x [m/s].
        speed_m_s: f64,
    },
    /// Straight lines in time.
    Waypoints {
        /// Times [s].
        time_s: Vec<f64>,
        /// Points (x, y) [m].
        point_m: Vec<[f64; 2]>,
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
                lowest_m: limits.lowest_m + centre_m,
                highest_m: limits.highest_m + centre_m,
                speed_m_s: limits.speed_m_s,
                acceleration_m_s2: limits.acceleration_m_s2,
            }),
            Motion::Constant { x_m, y_m, speed_m_s, .. } => {
                Path::Constant { start_m: [*x_m, y_m + centre_m], speed_m_s: *speed_m_s }
            }
            Motion::Waypoints { time_s, x_m, y_m, .. } => Path::Waypoints {
                time_s: time_s.clone(),
                point_m: x_m.iter().zip(y_m).map(|(x, y)| [*x, y + centre_m]).collect(),
            },
        };
        Self { layout: Layout::new(&drive.arrangement), path }
    }

    /// Whether the drive follows actions.
    pub fn is_controlled(&self) -> bool {
        matches!(self.path, Path::Controlled(_))
    }
}

/// Position [m] and velocity [m/s] on straight lines between points in time.
pub fn on_waypoints(time_s: &[f64], point_m: &[[f64; 2]], now_s: f64) -> ([f64; 2], [f64; 2]) {
    let next = time_s.partition_point(|&t| t <= now_s);
    if next == 0 || next == time_s.len() {
        return (point_m[next.min(time_s.len() - 1)], [0.0; 2]);
    }
    let (start_s, end_s) = (time_s[next - 1], time_s[next]);
    let (a, b) = (point_m[next - 1], point_m[next]);
    let velocity = [0, 1].map(|k| (b[k] - a[k]) / (end_s - start_s));
    let position = [0, 1].map(|k| a[k] + velocity[k] * (now_s - start_s));
    (position, velocity)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waypoints_hold_still_before_and_after() {
        let (time, points) = ([0.0, 0.5, 0.8], [[0.0, -0.052], [0.0, -0.022], [0.01, -0.022]]);
        assert_eq!(on_waypoints(&time, &points, -1.0).0, points[0]);
        assert_eq!(on_waypoints(&time, &points, 9.0), (points[2], [0.0; 2]));
        let (position, velocity) = on_waypoints(&time, &points, 0.25);
        assert!((position[1] + 0.037).abs() < 1e-15 && (velocity[1] - 0.06).abs() < 1e-15);
    }
}
