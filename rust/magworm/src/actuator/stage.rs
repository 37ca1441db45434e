//! A stage that carries magnets beneath the ground: along x and up in the plane, also aside and in yaw in space.
//!
//! It is written for the axes x, y, z and yaw. In the plane it has the first two, and a robot there stands at z = 0 with
//! heading 0; so the others stay at 0, and are neither stored nor shown.

use super::layout::Layout;
use super::path::{Limits, Path, YAW};
use super::rows::{ActuatorRows, Clock, Sizes};
use super::suspension::Suspension;
use crate::draws::Draws;
use crate::lanes::math::sin_cos;
use crate::lanes::{Dim, Dimensions, Isa, Number, Real, Row};
use crate::scene::{Arrangement, Drive, Scene};
use crate::specification::{Observation, Outlook, Scales, Specification};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// The axis of height.
const HEIGHT: usize = 1;

/// A stage. Its state is the place of its axes and their velocities: x, y, in space also z [m] and yaw [rad]; then what its
/// suspension gives way by and how fast, where it has one. Its targets are those of the axes, then their greatest speed [m/s].
#[derive(Clone, Debug)]
pub struct Stage {
    sizes: Dimensions,
    /// The robot that its targets and its start lie around and that its belt comes round beneath: a place in the list
    /// of a scene's robots.
    pub robot: usize,
    /// Places of the magnets around the stage.
    pub layout: Layout,
    /// Its motion.
    pub path: Path,
    /// What carries the magnets, where they give way.
    suspension: Option<Suspension>,
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
    /// All, in the order of an action.
    const ALL: [Self; 5] = [Self::Along, Self::Aside, Self::Height, Self::Speed, Self::Yaw];

    /// Those of a stage, which may turn by command.
    fn of(sizes: Dimensions, turns: bool) -> impl Iterator<Item = Self> {
        let axes = if turns { sizes.stage } else { sizes.axes };
        Self::ALL.into_iter().filter(move |component| component.axis() < axes)
    }

    /// Place among x, y, z and yaw of the axis that it needs; all have a speed.
    const fn axis(self) -> usize {
        match self {
            Self::Along | Self::Speed => 0,
            Self::Height => 1,
            Self::Aside => 2,
            Self::Yaw => YAW,
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
    pub fn new(drive: &Drive, scene: &Scene) -> Self {
        let (layout, path) = (Layout::new(&drive.arrangement), Path::new(drive));
        let suspension = drive.suspension.as_ref();
        let suspension = suspension.map(|one| Suspension::new(one, scene.solver.step_s));
        Self { sizes: Dimensions::new(scene.dimensions), robot: 0, layout, path, suspension }
    }

    /// One that stands still, with a single magnet.
    pub fn standing(dimensions: usize) -> Self {
        let path = Path::Constant { start: [0.0; 4], speed_m_s: 0.0 };
        let layout = Layout::new(&Arrangement::Single);
        Self { sizes: Dimensions::new(dimensions), robot: 0, layout, path, suspension: None }
    }

    /// Its limits, where it follows commands.
    pub fn limits(&self) -> Option<&Limits> {
        match &self.path {
            Path::Controlled(limits) => Some(limits),
            _ => None,
        }
    }

    /// Whether it turns by command.
    fn turns(&self) -> bool {
        self.limits().is_some_and(|limits| limits.yaw_reach_rad > 0.0)
    }

    fn components(&self) -> impl Iterator<Item = Component> {
        Component::of(self.sizes, self.turns())
    }

    /// Whether its magnets give way.
    pub fn is_suspended(&self) -> bool {
        self.suspension.is_some()
    }

    /// x, y, z [m] and yaw [rad] of what carries its magnets; an axis that it lacks is at 0.
    #[inline(always)]
    pub fn place_in<F: Real>(&self, zero: F, row: impl Fn(usize) -> F) -> [F; 4] {
        self.axes_in(0, zero, row)
    }

    /// Their velocities [m/s, rad/s].
    #[inline(always)]
    fn velocity_in<F: Real>(&self, zero: F, row: impl Fn(usize) -> F) -> [F; 4] {
        self.axes_in(1, zero, row)
    }

    /// Places (0) or velocities (1) of the axes, each with its part of what the suspension gives way by.
    #[inline(always)]
    fn axes_in<F: Real>(&self, which: usize, zero: F, row: impl Fn(usize) -> F) -> [F; 4] {
        let (mut axes, count) = ([zero; 4], self.sizes.stage);
        for axis in 0..count {
            axes[axis] = row(which * count + axis);
        }
        if self.is_suspended() {
            axes[HEIGHT] = axes[HEIGHT] + row(2 * count + which);
        }
        axes
    }
}

/// What a person sees, in one lane.
impl Stage {
    /// See [`super::Actuator::magnet_place`].
    pub fn magnet_place(&self, magnet: usize, state: &[f64], robot_x: f64) -> Vec<f64> {
        let [x, y, z, yaw] = self.place_in(0.0, |row| state[row]);
        let (sin, cos) = sin_cos(yaw);
        let [x, z] = self.layout.place(magnet, x, z, robot_x, sin, cos);
        [x, y, z, yaw][..self.sizes.stage].to_vec()
    }

    /// See [`super::Actuator::velocity`].
    pub fn velocity(&self, state: &[f64]) -> Vec<f64> {
        self.velocity_in(0.0, |row| state[row])[..self.sizes.stage].to_vec()
    }
}

/// What an agent sees and does.
impl Stage {
    /// How many rows it needs.
    pub fn sizes(&self) -> Sizes {
        let sizes = Self::sizes_in(self.sizes, self.turns());
        let rows = if self.is_suspended() { Suspension::ROWS } else { 0 };
        Sizes { state: sizes.state + rows, ..sizes }
    }

    /// How many rows one needs in the plane or in space that turns by command, or does not. Yaw is seen as cosine and sine.
    pub fn sizes_in(sizes: Dimensions, turns: bool) -> Sizes {
        Sizes {
            state: 2 * sizes.stage,
            target: sizes.stage + 1,
            action: Component::of(sizes, turns).count(),
            observation: 2 * sizes.stage + sizes.yaws(),
        }
    }

    /// Its components of an action.
    pub fn action(&self) -> Vec<Specification> {
        self.components().map(Component::specification).collect()
    }

    /// Its components of an observation.
    pub fn observation(&self, scales: &Scales) -> Vec<Specification> {
        let slice = Specification::new;
        let (axes, yaws) = (self.sizes.axes, self.sizes.yaws());
        let (length, speed) = (scales.length(), scales.speed());
        let place = "place of the drive along each axis; x from the robot's centre";
        let mut slices = vec![
            slice("drive_position", &length, axes, place),
            slice("drive_yaw", "1", 2 * yaws, "cosine and sine of the drive's yaw"),
            slice("drive_velocity", &speed, axes, "velocity of the drive along each axis"),
            slice("drive_rate", &scales.rate(), yaws, "angular velocity of the drive about y"),
        ];
        slices.retain(|slice| slice.size > 0);
        slices
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
        let ([x, y, z, yaw], [vx, vy, vz, rate]) =
            (self.place_in(0.0, at), self.velocity_in(0.0, at));
        let centre = from.robot[0];
        if self.sizes.axes == 2 {
            let (per_length, per_speed) = (1.0 / scales.length_m, 1.0 / scales.speed_m_s);
            let x = self.layout.position(0, x, centre);
            out.numbers(&[(x - centre) * per_length, y * per_length]);
            return out.numbers(&[vx * per_speed, vy * per_speed]);
        }
        let x = match self.layout.circumference_m {
            Some(_) => self.layout.position(0, x, centre),
            None => x,
        };
        out.vector(from.place(Vector3::new(x, y, z)) / scales.length_m);
        let (sin, cos) = sin_cos(yaw - from.robot[2]);
        out.numbers(&[cos, sin]);
        out.vector(from.vector(Vector3::new(vx, vy, vz)) / scales.speed_m_s);
        out.numbers(&[rate / scales.rate_rad_s()]);
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
        let axes = self.sizes.stage;
        for axis in 0..axes {
            rows.state[axis][lane] = Number::of(place[axis]);
            rows.state[axes + axis][lane] = Number::of(0.0);
            rows.target[axis][lane] = Number::of(place[axis]);
        }
        rows.state[2 * axes..].iter_mut().for_each(|row| row[lane] = Number::of(0.0));
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
        let along = draws.uniform(-limits.reach_m, limits.reach_m);
        let height = draws.uniform(limits.lowest_m, limits.highest_m);
        let aside = draws.uniform(-limits.lateral_reach_m, limits.lateral_reach_m);
        let turn = draws.uniform(-limits.yaw_reach_rad, limits.yaw_reach_rad);
        let [x, z] = beside(robot, along, aside);
        [x, height, z, robot[2] + turn]
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
        let value = |k: usize| action.get(k).map_or(0.0, |a| a.clamp(-1.0, 1.0));
        let of = |component| self.components().position(|c| c == component).map_or(0.0, value);
        let unit = |component| 0.5 * (of(component) + 1.0);
        let along = of(Component::Along) * limits.reach_m;
        let aside = of(Component::Aside) * limits.lateral_reach_m;
        let [x, z] = beside(robot, along, aside);
        let height =
            limits.lowest_m + unit(Component::Height) * (limits.highest_m - limits.lowest_m);
        let yaw = robot[2] + of(Component::Yaw) * limits.yaw_reach_rad;
        let is_at = self.place_in(0.0, |row| rows.state[row][lane].f64());
        let turns = ((is_at[YAW] - yaw) / TAU).round();
        let (place, speed) = ([x, height, z, yaw + turns * TAU], unit(Component::Speed));
        for axis in 0..self.sizes.stage {
            rows.target[axis][lane] = Number::of(place[axis]);
        }
        rows.target[self.sizes.stage][lane] = Number::of(speed * limits.speed_m_s);
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
        let (place, speed) = self.path.advance::<D, I>(isa, &rows, clock);
        for axis in 0..D::STAGE {
            for (row, value) in [(axis, place[axis]), (D::STAGE + axis, speed[axis])] {
                let row = &mut rows.state[row];
                isa.store(I::F::select(clock.running, value, isa.load(row)), row);
            }
        }
        if let Some(suspension) = &self.suspension {
            let rows = &mut rows.state[2 * D::STAGE..];
            let before = [isa.load(&rows[0]), isa.load(&rows[1])];
            let after = suspension.advance(before, clock.load_n);
            for k in 0..Suspension::ROWS {
                isa.store(I::F::select(clock.running, after[k], before[k]), &mut rows[k]);
            }
        }
    }
}

/// x, z of a point that lies along a robot and to its side [m].
fn beside([x, z, heading]: [f64; 3], along_m: f64, aside_m: f64) -> [f64; 2] {
    let (sin, cos) = sin_cos(heading);
    [x + along_m * cos + aside_m * sin, z + aside_m * cos - along_m * sin]
}
