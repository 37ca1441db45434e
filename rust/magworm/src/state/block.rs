//! Environments of one model, one per lane.

use super::kept::Kept;
use super::rows::Rows;
use crate::actuator::{ActuatorRows, Sizes};
use crate::contact::Workspace;
use crate::equations::held_rows;
use crate::lanes::{InstructionSet, Row};
use crate::model::{Model, off_centre_rows};

/// Why an environment stands still.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// It does not: the environment runs.
    #[default]
    Running = 0,
    /// A velocity was infinite or not a number.
    NotFinite = 1,
    /// An element was stretched beyond three times or squeezed below a tenth of its rest length.
    Overstretched = 2,
    /// A node sank into the ground by more than the body's thickness.
    Sunk = 3,
    /// The lane belongs to no environment: the batch is not a multiple of the lanes.
    Unused = 255,
}

impl Status {
    /// The status of a code; none for codes that no status has.
    pub fn from_code(code: u8) -> Option<Self> {
        [Self::Running, Self::NotFinite, Self::Overstretched, Self::Sunk, Self::Unused]
            .into_iter()
            .find(|status| *status as u8 == code)
    }

    /// One sentence about it.
    pub fn text(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::NotFinite => "a velocity became infinite or not a number",
            Self::Overstretched => {
                "an element was stretched beyond 3 times or squeezed below 0.1 of its rest length"
            }
            Self::Sunk => "a node sank into the ground by more than the body's thickness",
            Self::Unused => "unused lane",
        }
    }
}

/// Work done since the block was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Solver steps of the block.
    pub steps: u64,
    /// Linear systems with contact that were solved, or without where nothing touches.
    pub factorisations: u64,
    /// Trials of the contact solve, see [`crate::contact`].
    pub trials: u64,
    /// Wrenches of one drive magnet on one body magnet.
    pub wrenches: u64,
}

impl Counters {
    /// The sum of both.
    pub fn plus(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            factorisations: self.factorisations + other.factorisations,
            trials: self.trials + other.trials,
            wrenches: self.wrenches + other.wrenches,
        }
    }
}

/// The state of as many environments as a row has lanes, and the workspace of their step.
#[derive(Clone, Debug)]
pub struct Block<R: Row> {
    // State. Every row is one number per lane; together with `status` this is a snapshot.
    /// Unknowns [m, rad], shape [unknowns].
    pub q: Rows<R>,
    /// Their velocities [m/s, rad/s]; multipliers hold impulses [N·s], shape [unknowns].
    pub v: Rows<R>,
    /// What the springs take for the velocities at the start of a step [m/s, rad/s], see [`crate::integrate::Coefficients::lag`],
    /// shape [unknowns].
    pub lagged: Rows<R>,
    /// Normal impulse of each contact in the last step [N·s], shape [contacts].
    pub normal: Rows<R>,
    /// What the spring of each pad holds along x and in space along z [N·s], shape [contacts × (D − 1)]. Friction
    /// differs from it by what the damper held in the last step.
    pub pad: Rows<R>,
    /// State of each contact, see [`crate::contact::Mode`], shape [contacts].
    pub mode: Rows<R>,
    /// What the actuators are at and how they move, one after the other, see [`crate::actuator`].
    pub stage: Rows<R>,
    /// What they are to reach.
    pub target: Rows<R>,
    /// The action that said so, shape [action].
    pub action: Rows<R>,
    /// Solver steps since the reset, shape [1].
    pub step_count: Rows<R>,
    /// Factors of the scene's parameters in force, in the order of [`Model::PARAMETERS`].
    pub factors: Rows<R>,
    /// 1 where a magnet is in, 0 where it is out, shape [magnets].
    pub present: Rows<R>,
    /// Positions of the nodes held in place [m], shape [fixed nodes × D].
    pub held: Rows<R>,
    /// In space up direction and tangent of each element, shape [elements × 6].
    pub director: Rows<R>,
    /// In space twist of each bending node [rad], beyond ±π where it has gone there, shape [bending nodes].
    pub twist: Rows<R>,
    /// Force [N] and torque [N·m] of the drive on each body magnet where they act for several steps, see
    /// [`crate::model::Magnetics::interval`], shape [magnets × 3], in space [magnets × 6]; else none.
    pub wrench: Rows<R>,
    /// Status of each environment, shape [lanes].
    pub status: Box<[Status]>,

    // Derived from the factors and the magnets present, by reset.
    /// Mass of each unknown [kg, kg·m²], shape [unknowns].
    pub mass: Rows<R>,
    /// First moments and products of inertia of bodies off their centre [kg·m, kg·m²], see
    /// [`crate::model::OffCentre::row`].
    pub off_centre: Rows<R>,
    /// Remanence of each body magnet along its up direction [T], 0 where it is out, shape [magnets].
    pub remanence: Rows<R>,

    // Workspace.
    /// 1 where the lane runs, 0 where it stands still, shape [1].
    pub running: Rows<R>,
    /// Node positions [m], shape [nodes × D].
    pub node: Rows<R>,
    /// Unit tangents, shape [elements × D].
    pub tangent: Rows<R>,
    /// Lengths [m], shape [elements].
    pub length: Rows<R>,
    /// Inverse lengths [1/m], shape [elements].
    pub inverse_length: Rows<R>,
    /// In space side direction of each element, shape [elements × 3].
    pub side: Rows<R>,
    /// Cosine and sine of each magnet's angle, shape [magnets × 2]; in space its tangent, up and side,
    /// shape [magnets × 9].
    pub frame: Rows<R>,
    /// Matrix without contacts, then its factors, see [`crate::lanes::chain`].
    pub matrix: Rows<R>,
    /// Right-hand side [N·s], shape [unknowns].
    pub right: Rows<R>,
    /// Velocities at the end of this step, shape [unknowns].
    pub next: Rows<R>,
    /// The robot seen from above when a control step began, see [`Self::robot_pose`], shape [lanes].
    pub robot_before: Box<[[f64; 3]]>,
    /// The contact solve.
    pub contact: Workspace<R>,
    /// Work done.
    pub counters: Counters,
    /// The state before a call that may be stopped.
    pub(super) kept: Kept<R>,
    /// The instruction set that a batch steps the block on; bits do not depend on it.
    pub set: InstructionSet,
}

impl<R: Row> Block<R> {
    /// A block whose lanes are unused until they are reset.
    pub fn new(model: &Model) -> Self {
        let unknowns = model.coordinates.count;
        let (magnets, nodes, contacts) = (model.magnets(), model.nodes(), model.contacts.len());
        let (dimensions, zeros) = (model.dimensions(), Rows::zeros);
        // Rows that only a robot in space has.
        let in_space = |rows| zeros(if dimensions == 3 { rows } else { 0 });
        let (elements, actuators) = (nodes - 1, Sizes::of(&model.program.actuators));
        let mut this = Self {
            q: zeros(unknowns),
            v: zeros(unknowns),
            lagged: zeros(unknowns),
            normal: zeros(contacts),
            pad: zeros((dimensions - 1) * contacts),
            mode: zeros(contacts),
            stage: zeros(actuators.state),
            target: zeros(actuators.target),
            action: zeros(actuators.action),
            step_count: zeros(1),
            factors: zeros(Model::PARAMETERS.len()),
            present: zeros(magnets),
            held: zeros(dimensions * model.mesh.fixed_nodes),
            director: in_space(6 * elements),
            twist: in_space(model.bend.len()),
            wrench: zeros(held_rows(model)),
            status: vec![Status::Unused; R::LANES].into(),
            mass: zeros(unknowns),
            off_centre: zeros(off_centre_rows(dimensions) * model.off_centre.len()),
            remanence: zeros(magnets),
            running: zeros(1),
            node: zeros(dimensions * nodes),
            tangent: zeros(dimensions * elements),
            length: zeros(elements),
            inverse_length: zeros(elements),
            side: in_space(3 * elements),
            frame: zeros(if dimensions == 2 { 2 } else { 9 } * magnets),
            matrix: zeros(model.system.entries()),
            right: zeros(unknowns),
            next: zeros(unknowns),
            robot_before: vec![[0.0; 3]; R::LANES].into(),
            contact: Workspace::new(model),
            counters: Counters::default(),
            kept: Kept::default(),
            set: InstructionSet::widest(),
        };
        (0..R::LANES).for_each(|lane| crate::reset::rest(model, &mut this, lane));
        this
    }

    /// The rows of the actuators.
    pub fn actuator_rows(&mut self) -> ActuatorRows<'_, R> {
        let Self { stage, target, action, .. } = self;
        ActuatorRows { state: stage, target, action }
    }

    /// The rows that change in time, in the order of a snapshot.
    pub fn state_rows(&self) -> [&Rows<R>; 16] {
        [
            &self.q,
            &self.v,
            &self.lagged,
            &self.normal,
            &self.pad,
            &self.mode,
            &self.stage,
            &self.target,
            &self.action,
            &self.step_count,
            &self.factors,
            &self.present,
            &self.held,
            &self.director,
            &self.twist,
            &self.wrench,
        ]
    }

    /// The rows of [`Self::state_rows`], to be written.
    pub fn state_rows_mut(&mut self) -> [&mut Rows<R>; 16] {
        [
            &mut self.q,
            &mut self.v,
            &mut self.lagged,
            &mut self.normal,
            &mut self.pad,
            &mut self.mode,
            &mut self.stage,
            &mut self.target,
            &mut self.action,
            &mut self.step_count,
            &mut self.factors,
            &mut self.present,
            &mut self.held,
            &mut self.director,
            &mut self.twist,
            &mut self.wrench,
        ]
    }
}
