//! W environments of one model, one per lane.

use super::rows::Rows;
use crate::lanes::math::sin_cos;
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
}

impl Counters {
    /// The sum of both.
    pub fn plus(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            solves: self.solves + other.solves,
            factorisations: self.factorisations + other.factorisations,
            wrenches: self.wrenches + other.wrenches,
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
    /// Tangential impulse of each contact in the last step [N·s], shape [contacts].
    pub tangential: Rows<W>,
    /// State of each contact, see [`crate::contact::Mode`], shape [contacts].
    pub mode: Rows<W>,
    /// Stage x, y [m] and their velocities [m/s], shape [4].
    pub stage: Rows<W>,
    /// Stage target x, y [m] and speed limit [m/s], shape [3].
    pub target: Rows<W>,
    /// Last action, shape [3].
    pub action: Rows<W>,
    /// Solver steps since the reset, shape [1].
    pub step_count: Rows<W>,
    /// Factors of the scene's parameters in force, in the order of [`Model::PARAMETERS`].
    pub factors: Rows<W>,
    /// 1 where a magnet is in, 0 where it is out, shape [magnets].
    pub present: Rows<W>,
    /// Positions of the nodes held in place [m], shape [fixed nodes × 2].
    pub held: Rows<W>,
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
    /// Node positions [m], shape [nodes × 2].
    pub node: Rows<W>,
    /// Unit tangents, shape [elements × 2].
    pub tangent: Rows<W>,
    /// Lengths [m], shape [elements].
    pub length: Rows<W>,
    /// Inverse lengths [1/m], shape [elements].
    pub inverse_length: Rows<W>,
    /// Cosine and sine of each magnet's angle, shape [magnets × 2].
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
    /// Jacobians of the contacts, normal then tangential, shape [contacts × 2 × 3].
    pub jacobian: Rows<W>,
    /// Normal velocity that a contact must reach at least [m/s], shape [contacts].
    pub approach: Rows<W>,
    /// Coefficient of friction in this step, shape [contacts].
    pub coefficient: Rows<W>,
    /// Normal impulse that friction reckons with [N·s], shape [contacts].
    pub reckoned: Rows<W>,
    /// Normal impulse reckoned with, and found, in the pass before [N·s], shape [contacts × 2].
    pub earlier: Rows<W>,
    /// Impulses of the last step, where the penalties start from [N·s], shape [contacts × 2].
    pub warm: Rows<W>,
    /// Work done.
    pub counters: Counters,
}

impl<const W: usize> Block<W> {
    /// A block whose lanes are unused until they are reset.
    pub fn new(model: &Model) -> Self {
        let unknowns = model.coordinates.count;
        let (magnets, nodes, contacts) = (model.magnets(), model.nodes(), model.contacts.len());
        let zeros = Rows::zeros;
        let mut this = Self {
            q: zeros(unknowns),
            v: zeros(unknowns),
            normal: zeros(contacts),
            tangential: zeros(contacts),
            mode: zeros(contacts),
            stage: zeros(4),
            target: zeros(3),
            action: zeros(3),
            step_count: zeros(1),
            factors: zeros(Model::PARAMETERS.len()),
            present: zeros(magnets),
            held: zeros(2 * model.mesh.fixed_nodes),
            status: [Status::Unused; W],
            mass: zeros(unknowns),
            remanence: zeros(magnets),
            running: zeros(1),
            node: zeros(2 * nodes),
            tangent: zeros(2 * (nodes - 1)),
            length: zeros(nodes - 1),
            inverse_length: zeros(nodes - 1),
            frame: zeros(2 * magnets),
            matrix: zeros(model.band.entries()),
            factor: zeros(model.band.entries()),
            right: zeros(unknowns),
            solution: zeros(unknowns),
            next: zeros(unknowns),
            jacobian: zeros(contacts * 2 * crate::contact::SLOTS),
            approach: zeros(contacts),
            coefficient: zeros(contacts),
            reckoned: zeros(contacts),
            earlier: zeros(2 * contacts),
            warm: zeros(2 * contacts),
            counters: Counters::default(),
        };
        (0..W).for_each(|lane| crate::reset::rest(model, &mut this, lane));
        this
    }

    /// The rows that change in time, in the order of a snapshot.
    pub fn state_rows(&self) -> [&Rows<W>; 12] {
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
        ]
    }

    /// The rows of [`Self::state_rows`], to be written.
    pub fn state_rows_mut(&mut self) -> [&mut Rows<W>; 12] {
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
        ]
    }

    /// Position [m] of a node in one lane.
    pub fn node_position(&self, model: &Model, node: usize, lane: usize) -> [f64; 2] {
        use crate::model::Anchor;
        match model.coordinates.anchors[node] {
            Anchor::Free { dof } => [self.q[dof][lane], self.q[dof + 1][lane]],
            Anchor::Rigid { body, side } => {
                let dof = model.coordinates.bodies[body];
                let arm = f64::from(side) * model.half_magnet_m;
                let (sin, cos) = sin_cos(self.q[dof + 2][lane]);
                [self.q[dof][lane] + arm * cos, self.q[dof + 1][lane] + arm * sin]
            }
            Anchor::Fixed => [self.held[2 * node][lane], self.held[2 * node + 1][lane]],
        }
    }

    /// Position x, y [m] and angle [rad] of a body magnet in one lane.
    pub fn magnet_pose(&self, model: &Model, magnet: usize, lane: usize) -> [f64; 3] {
        let dof = model.coordinates.bodies[magnet];
        [0, 1, 2].map(|k| self.q[dof + k][lane])
    }

    /// Velocity of a body magnet in one lane [m/s, m/s, rad/s].
    pub fn magnet_velocity(&self, model: &Model, magnet: usize, lane: usize) -> [f64; 3] {
        let dof = model.coordinates.bodies[magnet];
        [0, 1, 2].map(|k| self.v[dof + k][lane])
    }

    /// x of the robot's centre in one lane [m]: mean of its magnets, or of its nodes where it has none.
    pub fn centre_x(&self, model: &Model, lane: usize) -> f64 {
        let magnets = model.magnets();
        if magnets == 0 {
            let nodes = model.nodes();
            return (0..nodes).map(|n| self.node_position(model, n, lane)[0]).sum::<f64>()
                / nodes as f64;
        }
        model.coordinates.bodies.iter().map(|&dof| self.q[dof][lane]).sum::<f64>() / magnets as f64
    }
}
