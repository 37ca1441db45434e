//! The rows of a block that belong to actuators, dealt out to them in their order.

use super::Actuator;
use crate::lanes::Isa;

/// How many rows of a block an actuator needs, and how many numbers an agent exchanges with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Where it is and how fast it moves.
    pub state: usize,
    /// What it is to reach.
    pub target: usize,
    /// Components of its action.
    pub action: usize,
    /// Components of its observation.
    pub observation: usize,
}

impl Sizes {
    /// Those of a list.
    pub fn of(actuators: &[Actuator]) -> Self {
        actuators.iter().map(Actuator::sizes).fold(Self::default(), |sum, one| Self {
            state: sum.state + one.state,
            target: sum.target + one.target,
            action: sum.action + one.action,
            observation: sum.observation + one.observation,
        })
    }
}

/// Rows of one actuator, or of a list one after the other.
#[derive(Debug)]
pub struct ActuatorRows<'a, R> {
    /// Where it is and how fast it moves.
    pub state: &'a mut [R],
    /// What it is to reach.
    pub target: &'a mut [R],
    /// The action that said so.
    pub action: &'a mut [R],
}

/// What a step tells an actuator.
#[derive(Clone, Copy, Debug)]
pub struct Clock<'a, I: Isa> {
    /// Steps since the reset at the end of this one, of each lane.
    pub steps: &'a [u64],
    /// Time step [s].
    pub step_s: f64,
    /// Factor of the speed of a motion that the scene prescribes.
    pub speed_factor: &'a I::Row,
    /// Vertical force of the body's magnets on its own in this step [N].
    pub load_n: I::F,
    /// Lanes that run.
    pub running: I::M,
}

/// Each actuator of a list with its rows.
#[inline(always)]
pub fn each<'a, 'b, R>(
    actuators: &'a [Actuator],
    rows: ActuatorRows<'b, R>,
) -> impl Iterator<Item = (&'a Actuator, ActuatorRows<'b, R>)> {
    let ActuatorRows { mut state, mut target, mut action } = rows;
    actuators.iter().map(move |actuator| {
        let sizes = actuator.sizes();
        let own = ActuatorRows {
            state: cut(&mut state, sizes.state),
            target: cut(&mut target, sizes.target),
            action: cut(&mut action, sizes.action),
        };
        (actuator, own)
    })
}

/// Each actuator of a list with the rows of its state.
#[inline(always)]
pub fn states<'a, 'b, R>(
    actuators: &'a [Actuator],
    mut state: &'b [R],
) -> impl Iterator<Item = (&'a Actuator, &'b [R])> {
    actuators.iter().map(move |actuator| {
        let (own, rest) = state.split_at(actuator.sizes().state);
        state = rest;
        (actuator, own)
    })
}

/// The first rows of what is left.
#[inline(always)]
fn cut<'a, R>(rest: &mut &'a mut [R], count: usize) -> &'a mut [R] {
    let (own, left) = std::mem::take(rest).split_at_mut(count);
    *rest = left;
    own
}
