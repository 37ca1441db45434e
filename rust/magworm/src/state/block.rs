//! W environments of one model, one per lane.

use super::rows::Rows;
use crate::drive::stage_axes;
use crate::model::Model;

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
    /// Linear solves.
    pub solves: u64,
    /// Factorisations.
    pub factorisations: u64,
    /// Wrenches of one drive magnet on one body magnet.
    pub wrenches: u64,
    /// Steps that some lane took in parts, see [`crate::step`].
    pub divided: u64,
}

impl Counters {
    /// The sum of both.
    pub fn plus(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            solves: self.solves + other.solves,
            factorisations: self.factorisations + other.factorisations,
            wrenches: self.wrenches + other.wrenches,
            divided: self.divided + other.divided,
        }
    }
}

/// The state of W environments and the workspace of their step.
#[derive(Clone, Debug)]
pub struct Block<const W: usize> {
    // State. Every row is one number per lane; together with `status` this is a snapshot.
    /// Unknowns [m, rad], shape [unknowns].
    pub q: Rows<W>,
    /// Their velocities [m/s, rad/s]; multipliers hold impulses [N·s], shape [unknowns].
    pub v: Rows<W>,
    /// Normal impulse of each contact in the last step [N·s], shape [contacts].
    pub normal: Rows<W>,
    /// Tangential impulse of each contact in the last step, along x and in space along z [N·s],
    /// shape [contacts × (D − 1)].
    pub tangential: Rows<W>,
    /// State of each contact, see [`crate::contact::Mode`], shape [contacts].
    pub mode: Rows<W>,
    /// Stage x, y, in space also z [m] and yaw [rad], then their velocities, shape [2 × axes].
    pub stage: Rows<W>,
    /// Targets of these axes, then the speed limit [m/s], shape [axes + 1].
    pub target: Rows<W>,
    /// Last action, shape [action].
    pub action: Rows<W>,
    /// Solver steps since the reset, shape [1].
    pub step_count: Rows<W>,
    /// Factors of the scene's parameters in force, in the order of [`Model::PARAMETERS`].
    pub factors: Rows<W>,
    /// 1 where a magnet is in, 0 where it is out, shape [magnets].
    pub present: Rows<W>,
    /// Positions of the nodes held in place [m], shape [fixed nodes × D].
    pub held: Rows<W>,
    /// In space up direction and tangent of each element, shape [elements × 6].
    pub director: Rows<W>,
    /// In space twist of each bending node [rad], beyond ±π where it has gone there, shape [bending nodes].
    pub twist: Rows<W>,
    /// Status of each environment.
    pub status: [Status; W],

    // Derived from the factors and the magnets present, by reset.
    /// Mass of each unknown [kg, kg·m²], shape [unknowns].
    pub mass: Rows<W>,
    /// Remanence of each body magnet along its up direction [T], 0 where it is out, shape [magnets].
    pub remanence: Rows<W>,

    // Workspace.
    /// 1 where the lane runs, 0 where it stands still, shape [1].
    pub running: Rows<W>,
    /// Node positions [m], shape [nodes × D].
    pub node: Rows<W>,
    /// Unit tangents, shape [elements × D].
    pub tangent: Rows<W>,
    /// Lengths [m], shape [elements].
    pub length: Rows<W>,
    /// Inverse lengths [1/m], shape [elements].
    pub inverse_length: Rows<W>,
    /// In space side direction of each element, shape [elements × 3].
    pub side: Rows<W>,
    /// Cosine and sine of each magnet's angle, shape [magnets × 2]; in space its tangent, up and side,
    /// shape [magnets × 9].
    pub frame: Rows<W>,
    /// Matrix without contacts, banded.
    pub matrix: Rows<W>,
    /// Matrix with contacts, then its factors.
    pub factor: Rows<W>,
    /// Right-hand side without contacts [N·s], shape [unknowns].
    pub right: Rows<W>,
    /// Right-hand side with contacts, then the solution, shape [unknowns].
    pub solution: Rows<W>,
    /// Accepted velocities of this step, shape [unknowns].
    pub next: Rows<W>,
    /// Jacobians of the contacts, normal then tangential, over the unknowns of a magnet, shape
    /// [contacts × 2 × 3], in space [contacts × 3 × 6].
    pub jacobian: Rows<W>,
    /// State of each contact at the start of the step, shape [contacts].
    pub mode_before: Rows<W>,
    /// Normal velocity that a contact must reach at least [m/s], shape [contacts].
    pub approach: Rows<W>,
    /// Coefficient of friction in this step, shape [contacts].
    pub coefficient: Rows<W>,
    /// Normal impulse that friction reckons with [N·s], shape [contacts].
    pub reckoned: Rows<W>,
    /// What is kept of earlier passes [N·s], see [`crate::contact::MEMORY`], shape [contacts × 4].
    pub memory: Rows<W>,
    /// How many passes that are, shape [1].
    pub remembered: Rows<W>,
    /// Impulses of the last step, where the penalties start from [N·s], shape [contacts × D].
    pub warm: Rows<W>,
    /// Direction in which each contact slides, shape [contacts × (D − 1)].
    pub slip: Rows<W>,
    /// In space its speed in the pass before [m/s], shape [contacts].
    pub speed: Rows<W>,
    /// In space the direction across it that friction is linearised along, its viscosity [kg] and the velocity
    /// that it is linearised about [m/s], shape [contacts × 4].
    pub across: Rows<W>,
    /// 1 where friction runs away, see [`crate::contact::hold`], shape [1].
    pub wild: Rows<W>,
    /// 1 where a lane takes this step in parts, shape [1].
    pub divided: Rows<W>,
    /// The time step in force [s]: the scene's, or a part of it.
    pub dt_s: f64,
    /// Work done.
    pub counters: Counters,
}

impl<const W: usize> Block<W> {
    /// A block whose lanes are unused until they are reset.
    pub fn new(model: &Model) -> Self {
        let unknowns = model.coordinates.count;
        let (magnets, nodes, contacts) = (model.magnets(), model.nodes(), model.contacts.len());
        let (dimensions, zeros) = (model.dimensions(), Rows::zeros);
        // Rows that only a robot in space has.
        let in_space = |rows| zeros(if dimensions == 3 { rows } else { 0 });
        let (elements, axes) = (nodes - 1, stage_axes(dimensions));
        let mut this = Self {
            q: zeros(unknowns),
            v: zeros(unknowns),
            normal: zeros(contacts),
            tangential: zeros((dimensions - 1) * contacts),
            mode: zeros(contacts),
            stage: zeros(2 * axes),
            target: zeros(axes + 1),
            action: zeros(crate::observe::action_size(model)),
            step_count: zeros(1),
            factors: zeros(Model::PARAMETERS.len()),
            present: zeros(magnets),
            held: zeros(dimensions * model.mesh.fixed_nodes),
            director: in_space(6 * elements),
            twist: in_space(model.bend.len()),
            status: [Status::Unused; W],
            mass: zeros(unknowns),
            remanence: zeros(magnets),
            running: zeros(1),
            node: zeros(dimensions * nodes),
            tangent: zeros(dimensions * elements),
            length: zeros(elements),
            inverse_length: zeros(elements),
            side: in_space(3 * elements),
            frame: zeros(if dimensions == 2 { 2 } else { 9 } * magnets),
            matrix: zeros(model.band.entries()),
            factor: zeros(model.band.entries()),
            right: zeros(unknowns),
            solution: zeros(unknowns),
            next: zeros(unknowns),
            jacobian: zeros(contacts * crate::contact::jacobian_rows(dimensions)),
            mode_before: zeros(contacts),
            approach: zeros(contacts),
            coefficient: zeros(contacts),
            reckoned: zeros(contacts),
            memory: zeros(crate::contact::MEMORY * contacts),
            remembered: zeros(1),
            warm: zeros(dimensions * contacts),
            slip: zeros((dimensions - 1) * contacts),
            speed: in_space(contacts),
            across: in_space(4 * contacts),
            wild: zeros(1),
            divided: zeros(1),
            dt_s: model.step_s,
            counters: Counters::default(),
        };
        (0..W).for_each(|lane| crate::reset::rest(model, &mut this, lane));
        this
    }

    /// The rows that change in time, in the order of a snapshot.
    pub fn state_rows(&self) -> [&Rows<W>; 14] {
        [
            &self.q,
            &self.v,
            &self.normal,
            &self.tangential,
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
        ]
    }

    /// The rows of [`Self::state_rows`], to be written.
    pub fn state_rows_mut(&mut self) -> [&mut Rows<W>; 14] {
        [
            &mut self.q,
            &mut self.v,
            &mut self.normal,
            &mut self.tangential,
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
        ]
    }
}
