//! Actuators: what moves the sources of the field, and how a controller commands it.
//!
//! An actuator declares its part of an action and of an observation, how many rows of a block it needs, where it starts,
//! what a command sets, how it moves in a step, and where its magnets are. It knows its rows and is told where its
//! robot is; it knows neither model nor block. A scene has a list of them.

mod axis;
mod layout;
mod path;
mod rows;
mod stage;
mod suspension;

pub use layout::Layout;
pub use rows::{ActuatorRows, Clock, Sizes, each, states};
pub use stage::Stage;

use crate::draws::Draws;
use crate::lanes::{Dim, Isa, Row};
use crate::scene::Scene;
use crate::specification::{Observation, Outlook, Scales, Specification};

/// One actuator. Each kind has a file.
#[derive(Clone, Debug)]
pub enum Actuator {
    /// Magnets on a stage.
    Stage(Stage),
}

impl Actuator {
    /// The actuators of a scene.
    pub fn of(scene: &Scene) -> Vec<Self> {
        let stage = scene.drive.as_ref().map(|drive| Stage::new(drive, scene));
        stage.map(Self::Stage).into_iter().collect()
    }

    /// The stage, where it is one: its magnets are sources of the field.
    pub fn stage(&self) -> Option<&Stage> {
        match self {
            Self::Stage(stage) => Some(stage),
        }
    }

    /// Whether its magnets give way to a vertical force.
    pub fn is_suspended(&self) -> bool {
        match self {
            Self::Stage(stage) => stage.is_suspended(),
        }
    }

    /// How many rows of a block it needs.
    pub fn sizes(&self) -> Sizes {
        match self {
            Self::Stage(stage) => stage.sizes(),
        }
    }

    /// Whether it follows actions.
    pub fn is_controlled(&self) -> bool {
        match self {
            Self::Stage(stage) => stage.limits().is_some(),
        }
    }

    /// Number of magnets.
    pub fn magnets(&self) -> usize {
        match self {
            Self::Stage(stage) => stage.layout.offset_m.len(),
        }
    }

    /// Place of the robot that it belongs to in the list of a scene's robots.
    pub fn robot(&self) -> usize {
        match self {
            Self::Stage(stage) => stage.robot,
        }
    }

    /// Where a magnet is in one lane, where the centre of its robot is at x [m]: x, y, in space also z [m] and yaw [rad].
    pub fn magnet_place(&self, magnet: usize, state: &[f64], robot_x: f64) -> Vec<f64> {
        match self {
            Self::Stage(stage) => stage.magnet_place(magnet, state, robot_x),
        }
    }

    /// Velocities of its axes in one lane [m/s, rad/s].
    pub fn velocity(&self, state: &[f64]) -> Vec<f64> {
        match self {
            Self::Stage(stage) => stage.velocity(state),
        }
    }

    /// Its greatest speed under control [m/s].
    pub fn speed_m_s(&self) -> Option<f64> {
        match self {
            Self::Stage(stage) => stage.limits().map(|limits| limits.speed_m_s),
        }
    }

    /// Its components of an action, in order.
    pub fn action(&self) -> Vec<Specification> {
        match self {
            Self::Stage(stage) => stage.action(),
        }
    }

    /// Its components of an observation, in order.
    pub fn observation(&self, scales: &Scales) -> Vec<Specification> {
        match self {
            Self::Stage(stage) => stage.observation(scales),
        }
    }

    /// Writes its part of the observation of one lane.
    pub fn observe<R: Row>(
        &self,
        state: &[R],
        lane: usize,
        from: &Outlook,
        scales: &Scales,
        out: &mut Observation<'_>,
    ) {
        match self {
            Self::Stage(stage) => stage.observe(state, lane, from, scales, out),
        }
    }

    /// Puts it where it starts in one lane, at rest: by its motion, or at a place drawn at random within its limits.
    /// `robot`: x, z of the centre of its robot [m] and heading [rad].
    pub fn place<R: Row>(
        &self,
        rows: ActuatorRows<'_, R>,
        lane: usize,
        robot: [f64; 3],
        draws: Option<&mut Draws>,
    ) {
        match self {
            Self::Stage(stage) => stage.place(rows, lane, robot, draws),
        }
    }

    /// Sets its targets in one lane from its part of an action, whose components are clipped to [−1, 1]; those that are
    /// missing count as 0. `robot`: x, z of the centre of its robot [m] and heading [rad].
    pub fn command<R: Row>(
        &self,
        rows: ActuatorRows<'_, R>,
        lane: usize,
        robot: [f64; 3],
        action: &[f64],
    ) {
        match self {
            Self::Stage(stage) => stage.command(rows, lane, robot, action),
        }
    }

    /// Moves it to where it is at the end of a step.
    #[inline(always)]
    pub fn advance<D: Dim, I: Isa>(
        &self,
        isa: I,
        rows: ActuatorRows<'_, I::Row>,
        clock: Clock<'_, I>,
    ) {
        match self {
            Self::Stage(stage) => stage.advance::<D, I>(isa, rows, clock),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn actuators(preset: &str) -> Vec<Actuator> {
        Actuator::of(&Scene::preset(preset).expect("a preset"))
    }

    #[test]
    fn an_actuator_declares_as_many_numbers_as_it_exchanges() {
        let scales = Scales { length_m: 0.02, speed_m_s: 0.2 };
        for preset in ["paper-3", "turn-3"] {
            let [stage] = &actuators(preset)[..] else { panic!("{preset} has one stage") };
            let count = |slices: Vec<Specification>| slices.iter().map(|s| s.size).sum::<usize>();
            let Sizes { state, action, observation, .. } = stage.sizes();
            assert_eq!(count(stage.action()), action, "{preset}");
            assert_eq!(count(stage.observation(&scales)), observation, "{preset}");
            let rows = vec![[0.5]; state];
            let mut row = vec![f32::NAN; observation];
            let from = Outlook::new([0.0; 3]);
            stage.observe(&rows, 0, &from, &scales, &mut Observation::new(&mut row));
            assert!(row.iter().all(|number| number.is_finite()), "{preset}: {row:?}");
        }
    }

    #[test]
    fn each_actuator_of_a_list_has_rows_of_its_own() {
        let pair: Vec<Actuator> = ["paper-3", "turn-3"].into_iter().flat_map(actuators).collect();
        let sizes = Sizes::of(&pair);
        let mut rows: [Vec<[f64; 1]>; 3] =
            [sizes.state, sizes.target, sizes.action].map(|count| vec![[f64::NAN]; count]);
        let [state, target, action] = &mut rows;
        let all = ActuatorRows { state, target, action };
        for (k, (actuator, own)) in each(&pair, all).enumerate() {
            actuator.place(own, 0, [k as f64, 0.0, 0.0], None);
        }
        assert!(rows.iter().flatten().all(|[number]| number.is_finite()), "{rows:?}");
        let place = |(k, (actuator, state)): (usize, (&Actuator, &[[f64; 1]]))| {
            (actuator.sizes().state, state[0][0] - k as f64)
        };
        let places: Vec<_> = states(&pair, &rows[0]).enumerate().map(place).collect();
        assert_eq!(places, [(4, 0.0), (8, 0.0)]);
    }
}
