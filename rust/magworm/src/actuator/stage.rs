//! A stage that carries magnets beneath the ground: along x and up in the plane, also aside and in yaw in space.

use super::layout::Layout;
use super::path::{Limits, Path};
use super::rows::{ActuatorRows, Clock, Sizes};
use crate::draws::Draws;
use crate::lanes::math::sin_cos;
use crate::lanes::{Dim, Dimensions, Isa, Number, Real, Row};
use crate::scene::{Arrangement, Drive};
use crate::specification::{Observation, Outlook, Scales, Specification};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// A stage. Its state is the place of its axes and their velocities: x, y, in space also z [m] and yaw [rad]. Its
/// targets are those of the axes, then their greatest speed [m/s].
#[derive(Clone, Debug)]
pub struct Stage {
    dimensions: usize,
    /// The robot that its targets and its start lie around and that its belt comes round beneath: a place in the list
    /// of a scene's robots.
    pub robot: usize,
    /// Places of the magnets around the stage.
    pub layout: Layout,
    /// Its motion.
    pub path: Path,
}

/// A component of an action, in [−1, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    Along,
    Aside,
    Height,
    Speed,
    Yaw,
}

impl Component {
    /// Those of a stage, in the order of an action. Yaw is one where the stage can turn.
    const fn of(dimensions: usize, turns: bool) -> &'static [Self] {
        match (dimensions, turns) {
            (2, _) => &[Self::Along, Self::Height, Self::Speed],
            (_, false) => &[Self::Along, Self::Aside, Self::Height, Self::Speed],
            (_, true) => &[Self::Along, Self::Aside, Self::Height, Self::Speed, Self::Yaw],
        }
    }

    fn specification(self) -> Specification {
        let (name, description) = match self {
            Self::Along => (
                "position",
                "target along the robot: −1 and 1 are the stage's reach ahead of and behind its centre",
            ),
            Self::Aside => (
                "lateral",
                "target to the robot's side: −1 and 1 are the stage's lateral reach right and left of it",
            ),
            Self::Height => {
                ("height", "target height: −1 is the lowest, 1 the highest of the stage")
            }
            Self::Speed => ("speed", "travel speed of each axis: −1 is none, 1 the stage's limit"),
            Self::Yaw => (
                "yaw",
                "target yaw from the robot's heading: −1 and 1 are the stage's reach, 1 anticlockwise from above",
            ),
        };
        Specification::within_one(name, 1, description)
    }
}

impl Stage {
    /// The stage of a scene, beneath its first robot.
    pub fn new(drive: &Drive, dimensions: usize) -> Self {
        let (layout, path) = (Layout::new(&drive.arrangement), Path::new(drive));
        Self { dimensions, robot: 0, layout, path }
    }

    /// One that stands still, with a single magnet.
    pub fn standing(dimensions: usize) -> Self {
        let path = Path::Constant { start: [0.0; 4], speed_m_s: 0.0 };
        Self { dimensions, robot: 0, layout: Layout::new(&Arrangement::Single), path }
    }

    /// Its limits, where it follows commands.
    pub fn limits(&self) -> Option<&Limits> {
        match &self.path {
            Path::Controlled(limits) => Some(limits),
            _ => None,
        }
    }

    fn components(&self) -> &'static [Component] {
        let turns = self.limits().is_some_and(|limits| limits.yaw_reach_rad > 0.0);
        Component::of(self.dimensions, turns)
    }

    /// Axes: x, y in the plane; x, y, z and yaw in space.
    pub const fn axes(dimensions: usize) -> usize {
        Dimensions::new(dimensions).stage
    }
}

/// What a person sees, in one lane.
impl Stage {
    /// See [`super::Actuator::magnet_place`].
    pub fn magnet_place(&self, magnet: usize, state: &[f64], robot_x: f64) -> Vec<f64> {
        if self.dimensions == 2 {
            return vec![self.layout.position(magnet, state[0], robot_x), state[1]];
        }
        let (sin, cos) = sin_cos(state[3]);
        let [x, z] = self.layout.place(magnet, state[0], state[2], robot_x, sin, cos);
        vec![x, state[1], z, state[3]]
    }

    /// See [`super::Actuator::velocity`].
    pub fn velocity(&self, state: &[f64]) -> Vec<f64> {
        state[Self::axes(self.dimensions)..].to_vec()
    }
}

/// What an agent sees and does.
impl Stage {
    /// How many rows it needs.
    pub fn sizes(&self) -> Sizes {
        Sizes { action: self.components().len(), ..Self::sizes_without_yaw(self.dimensions) }
    }

    /// How many rows one needs that does not turn by command.
    pub const fn sizes_without_yaw(dimensions: usize) -> Sizes {
        let axes = Self::axes(dimensions);
        Sizes {
            state: 2 * axes,
            target: axes + 1,
            action: Component::of(dimensions, false).len(),
            observation: if dimensions == 2 { 4 } else { 9 },
        }
    }

    /// Its components of an action.
    pub fn action(&self) -> Vec<Specification> {
        self.components().iter().map(|component| component.specification()).collect()
    }

    /// Its components of an observation.
    pub fn observation(&self, scales: &Scales) -> Vec<Specification> {
        let slice = Specification::new;
        let (length, speed) = (scales.length(), scales.speed());
        if self.dimensions == 2 {
            let place = "x of the drive from the robot's centre, and its height";
            return vec![
                slice("drive_position", &length, 2, place),
                slice("drive_velocity", &speed, 2, "velocity of the drive along x and y"),
            ];
        }
        vec![
            slice("drive_position", &length, 3, "x, y, z of the drive"),
            slice("drive_yaw", "1", 2, "cosine and sine of the drive's yaw"),
            slice("drive_velocity", &speed, 3, "velocity of the drive along x, y, z"),
            slice("drive_rate", &scales.rate(), 1, "angular velocity of the drive about y"),
        ]
    }

    /// Writes these components of one lane.
    pub fn observe<R: Row>(
        &self,
        state: &[R],
        lane: usize,
        from: &Outlook,
        scales: &Scales,
        out: &mut Observation<'_>,
    ) {
        let at = |row: usize| state[row][lane].f64();
        let centre = from.robot[0];
        if self.dimensions == 2 {
            let (per_length, per_speed) = (1.0 / scales.length_m, 1.0 / scales.speed_m_s);
            let x = self.layout.position(0, at(0), centre);
            out.numbers(&[(x - centre) * per_length, at(1) * per_length]);
            return out.numbers(&[at(2) * per_speed, at(3) * per_speed]);
        }
        let x = match self.layout.circumference_m {
            Some(_) => self.layout.position(0, at(0), centre),
            None => at(0),
        };
        out.vector(from.place(Vector3::new(x, at(1), at(2))) / scales.length_m);
        let (sin, cos) = sin_cos(at(3) - from.robot[2]);
        out.numbers(&[cos, sin]);
        out.vector(from.vector(Vector3::new(at(4), at(5), at(6))) / scales.speed_m_s);
        out.numbers(&[at(7) / scales.rate_rad_s()]);
    }
}

/// How it starts, is commanded and moves.
impl Stage {
    /// See [`super::Actuator::place`].
    pub fn place<R: Row>(
        &self,
        rows: ActuatorRows<'_, R>,
        lane: usize,
        robot: [f64; 3],
        draws: Option<&mut Draws>,
    ) {
        let place = self.start(robot, draws);
        let axes = Self::axes(self.dimensions);
        for axis in 0..axes {
            rows.state[axis][lane] = Number::of(place[axis]);
            rows.state[axes + axis][lane] = Number::of(0.0);
            rows.target[axis][lane] = Number::of(place[axis]);
        }
        rows.target[axes][lane] = Number::of(0.0);
        rows.action.iter_mut().for_each(|row| row[lane] = Number::of(0.0));
    }

    fn start(&self, robot: [f64; 3], draws: Option<&mut Draws>) -> [f64; 4] {
        match (&self.path, draws) {
            (Path::Controlled(limits), Some(draws)) => self.somewhere(limits, robot, draws),
            (Path::Controlled(limits), None) => {
                let [x, z, heading] = robot;
                [x, limits.lowest_m, z, heading]
            }
            (Path::Constant { start, .. }, _) => *start,
            (Path::Waypoints { point, .. }, _) => point[0],
        }
    }

    /// A random place within the limits, around a robot.
    fn somewhere(&self, limits: &Limits, robot: [f64; 3], draws: &mut Draws) -> [f64; 4] {
        let [x, _, heading] = robot;
        let along = draws.uniform(-limits.reach_m, limits.reach_m);
        let height = draws.uniform(limits.lowest_m, limits.highest_m);
        if self.dimensions == 2 {
            return [x + along, height, 0.0, 0.0];
        }
        let aside = draws.uniform(-limits.lateral_reach_m, limits.lateral_reach_m);
        let yaw = heading + draws.uniform(-limits.yaw_reach_rad, limits.yaw_reach_rad);
        let [x, z] = beside(robot, along, aside);
        [x, height, z, yaw]
    }

    /// See [`super::Actuator::command`]. Values beyond [−1, 1] are clipped; yaw is taken on the branch where the stage
    /// is, so that it never turns back by a whole turn.
    pub fn command<R: Row>(
        &self,
        rows: ActuatorRows<'_, R>,
        lane: usize,
        robot: [f64; 3],
        action: &[f64],
    ) {
        let Some(limits) = self.limits() else { return };
        let components = self.components();
        let value = |k: usize| action.get(k).map_or(0.0, |a| a.clamp(-1.0, 1.0));
        let of = |component| components.iter().position(|c| *c == component).map_or(0.0, value);
        let unit = |component| 0.5 * (of(component) + 1.0);
        let along = of(Component::Along) * limits.reach_m;
        let height =
            limits.lowest_m + unit(Component::Height) * (limits.highest_m - limits.lowest_m);
        let speed = unit(Component::Speed) * limits.speed_m_s;
        let mut set = |row: usize, target: f64| rows.target[row][lane] = Number::of(target);
        if self.dimensions == 2 {
            set(0, robot[0] + along);
        } else {
            let [x, z] = beside(robot, along, of(Component::Aside) * limits.lateral_reach_m);
            let yaw = robot[2] + of(Component::Yaw) * limits.yaw_reach_rad;
            let turns = ((rows.state[3][lane].f64() - yaw) / TAU).round();
            set(0, x);
            set(2, z);
            set(3, yaw + turns * TAU);
        }
        set(1, height);
        set(Self::axes(self.dimensions), speed);
        for (k, row) in rows.action.iter_mut().enumerate() {
            row[lane] = Number::of(value(k));
        }
    }

    /// See [`super::Actuator::advance`].
    #[inline(always)]
    pub fn advance<D: Dim, I: Isa>(
        &self,
        isa: I,
        rows: ActuatorRows<'_, I::Row>,
        clock: Clock<'_, I>,
    ) {
        if D::AXES == 2 {
            self.advance_axes::<2, I>(isa, rows, clock);
        } else {
            self.advance_axes::<4, I>(isa, rows, clock);
        }
    }

    #[inline(always)]
    fn advance_axes<const AXES: usize, I: Isa>(
        &self,
        isa: I,
        rows: ActuatorRows<'_, I::Row>,
        clock: Clock<'_, I>,
    ) {
        let (place, speed) = self.path.advance::<AXES, I>(isa, &rows, clock);
        for axis in 0..AXES {
            for (row, value) in [(axis, place[axis]), (AXES + axis, speed[axis])] {
                let row = &mut rows.state[row];
                isa.store(I::F::select(clock.running, value, isa.load(row)), row);
            }
        }
    }
}

/// x, z of a point that lies along a robot and to its side [m].
fn beside([x, z, heading]: [f64; 3], along_m: f64, aside_m: f64) -> [f64; 2] {
    let (sin, cos) = sin_cos(heading);
    [x + along_m * cos + aside_m * sin, z + aside_m * cos - along_m * sin]
}
