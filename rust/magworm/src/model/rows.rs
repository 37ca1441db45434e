//! Rows of a block, declared once: name, unit, how many a model needs, and what they may hold.
//!
//! A row is one number per lane. [`crate::state::Block`] has a field for each group of rows that stands here, with
//! the group's doc comment; allocation, reset, snapshots and `docs/rows.md` follow from the declaration as well.

use super::Model;
use crate::actuator::Sizes;
use crate::lanes::unsymmetric;

/// What rows are to a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// They change in time and decide what follows: a reset zeroes them first, a snapshot holds them.
    State,
    /// They follow from the state: reset and restore derive them.
    Derived,
    /// A step writes them before it reads them.
    Workspace,
}

/// Greatest magnitude of a number of the state, in the SI unit of its row: no robot that runs comes near it, and its
/// powers in a step are finite in single precision too.
pub const GREATEST: f64 = 1e9;

/// What a number of a state may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// From the first to the second.
    Range(f64, f64),
    /// A whole number from 0 to this.
    Whole(u8),
    /// A factor of each parameter, in their order: only a drive's speed may be negative.
    Factors,
    /// Groups of six, up direction and tangent of an element: unit vectors at right angles.
    Frames,
}

/// Rows of one kind.
#[derive(Clone, Copy, Debug)]
pub struct RowGroup {
    /// Their name.
    pub name: &'static str,
    /// What they are.
    pub meaning: &'static str,
    /// SI unit, "1" for what has none.
    pub unit: &'static str,
    /// What they are to a block.
    pub role: Role,
    /// What they may hold in a state.
    pub allowed: Allowed,
    /// How many a model needs.
    pub rows: fn(&Model) -> usize,
}

/// Rows of a contact's linearised law: λ*, C_n, c, and the lower half of C_t.
pub const fn hessian_rows(dimensions: usize) -> usize {
    let tangents = dimensions - 1;
    dimensions + 1 + tangents + tangents * (tangents + 1) / 2
}
/// Rows of a line search.
pub const LINE_SEARCH: usize = 6;

/// Hands all declarations to another macro, in the order in which a snapshot holds them. A group reads
/// `name: unit, rows => allowed;` as in [`RowGroup`]; what is allowed is left out where any number is.
macro_rules! block_rows {
    ($declare:ident) => {
        $declare! {
            State {
                /// Unknowns, shape [unknowns].
                q: "m, rad", |m| m.coordinates.count;
                /// Their velocities; multipliers hold impulses [N·s]; shape [unknowns].
                v: "m/s, rad/s", |m| m.coordinates.count;
                /// What the springs take for the velocities at the start of a step, see [`crate::integrate::Coefficients::numerical_dissipation`], shape [unknowns].
                spring_velocity: "m/s, rad/s", |m| m.coordinates.count;
                /// Normal impulse of each contact in the last step, shape [contacts].
                normal_impulse: "N·s", |m| m.contacts.len();
                /// Impulse that the tangential spring of each contact holds along x and in space along z, shape [contacts × (D − 1)]. Friction
                /// differs from it by what the damper held in the last step.
                tangential_spring: "N·s", |m| (m.dimensions() - 1) * m.contacts.len();
                /// State of each contact, see `contact::ContactMode`, shape [contacts].
                contact_mode: "1", |m| m.contacts.len() => Allowed::Whole(2);
                /// What the actuators are at and how they move, one after the other, see [`crate::actuator`].
                stage: "m, rad, m/s, rad/s", |m| Sizes::of(&m.program.actuators).state;
                /// What they are to reach.
                target: "m, rad, m/s", |m| Sizes::of(&m.program.actuators).target;
                /// The action that said so, shape [action].
                action: "1", |m| Sizes::of(&m.program.actuators).action => Allowed::Range(-1.0, 1.0);
                /// Factors of the scene's parameters in force, in the order of [`Model::PARAMETERS`].
                factors: "1", |_| Model::PARAMETERS.len() => Allowed::Factors;
                /// 1 where a magnet is in, 0 where it is out, shape [magnets].
                present: "1", |m| m.magnets() => Allowed::Whole(1);
                /// Positions of the nodes held in place, shape [fixed nodes × D].
                fixed_position: "m", |m| m.dimensions() * m.mesh.fixed_nodes;
                /// In space up direction and tangent of each element, shape [elements × 6].
                director: "1", |m| in_space(m, 6 * (m.nodes() - 1)) => Allowed::Frames;
                /// In space twist of each bending node, beyond ±π where it has gone there, shape [bending nodes].
                twist: "rad", |m| in_space(m, m.bend.len());
                /// Strain of the dashpots of rubber that relaxes beside each axial spring, shape [axial springs × branches]. With Euler's scheme
                /// they are a step behind the unknowns, else half a step ahead.
                stretch_dashpot: "m", |m| m.program.relaxation.branches.len() * m.stretch.len();
                /// The same beside the springs that bend and twist, shape [bending nodes × branches], in space [bending nodes × 3 × branches].
                bend_dashpot: "rad", |m| m.program.relaxation.branches.len() * m.sizes().rotations * m.bend.len();
                /// Force and torque of the drive on each body where they act for several steps, see
                /// [`crate::model::Magnetics::interval`], shape [bodies × 3], in space [bodies × 6]; else none.
                wrench: "N, N·m", held_wrenches;
            }
            Derived {
                /// Mass of each unknown, shape [unknowns].
                mass: "kg, kg·m²", |m| m.coordinates.count;
                /// First moments and products of inertia of bodies off their centre, see [`crate::model::OffCentre::row`].
                off_centre: "kg·m, kg·m²", |m| m.sizes().moments() * m.off_centre().count();
                /// Remanence of each body magnet along its up direction, 0 where it is out, shape [magnets].
                remanence: "T", |m| m.magnets();
            }
            Workspace {
                /// 1 where the lane runs, 0 where it stands still, shape [1].
                running: "1", |_| 1;
                /// Vertical force of the body's magnets on those of a stage that gives way, shape [1]; else none.
                drive_load: "N", |m| m.program.actuators.iter().filter(|one| one.is_suspended()).count();
                /// Node positions, shape [nodes × D].
                node: "m", |m| m.dimensions() * m.nodes();
                /// Unit tangents, shape [elements × D].
                tangent: "1", |m| m.dimensions() * (m.nodes() - 1);
                /// Lengths, shape [elements].
                length: "m", |m| m.nodes() - 1;
                /// Inverse lengths, shape [elements].
                inverse_length: "1/m", |m| m.nodes() - 1;
                /// In space side direction of each element, shape [elements × 3].
                side: "1", |m| in_space(m, 3 * (m.nodes() - 1));
                /// Cosine and sine of each body's angle, shape [bodies × 2]; in space its tangent, up and side,
                /// shape [bodies × 9].
                frame: "1", |m| m.sizes().frame * m.bodies.len();
                /// Matrix without contacts, then its factors, see [`crate::lanes::chain`].
                matrix: "kg, kg·m, kg·m²", |m| m.system.entries();
                /// Right-hand side, shape [unknowns].
                rhs: "N·s, N·m·s", |m| m.coordinates.count;
                /// Velocities at the end of this step, shape [unknowns].
                end_velocity: "m/s, rad/s", |m| m.coordinates.count;
            }
            Contact {
                /// r: from a point's body to the point, shape [contacts × D].
                arm: "m", |m| m.dimensions() * m.contacts.len();
                /// r from the body that carries a surface to where the point meets it, shape [contacts between bodies × D].
                surface_arm: "m", |m| m.dimensions() * m.moving_surfaces();
                /// Normal of such a surface there, shape [contacts between bodies × D].
                surface_normal: "1", |m| m.dimensions() * m.moving_surfaces();
                /// û: the part of a point's velocity that v has no share in, shape [contacts × D].
                bias: "m/s", |m| m.dimensions() * m.contacts.len();
                /// μ in this step, shape [contacts].
                friction_coefficient: "1", |m| m.contacts.len();
                /// λ of the step before, along the tangents λ⁰, shape [contacts × D].
                warm_start: "N·s", |m| m.dimensions() * m.contacts.len();
                /// F of Tresca's law, shape [contacts].
                friction_bound: "N·s", |m| m.contacts.len();
                /// λ* and C, see `hessian::ContactHessian`, shape [contacts × 5], in space [contacts × 9].
                hessian: "N·s, kg", |m| hessian_rows(m.dimensions()) * m.contacts.len();
                /// 1 where a point was closed before or would be inside the surface at the end of the step, shape [contacts].
                active: "1", |m| m.contacts.len();
                /// Effective mass along the normal of a point that rebounds, else 0, shape [contacts]; none without restitution.
                impact_mass: "kg", |m| if m.restitutes() { m.contacts.len() } else { 0 };
                /// Direction of ξ_t where the law was linearised last, shape [contacts × (D − 1)].
                friction_direction: "1", |m| (m.dimensions() - 1) * m.contacts.len();
                /// u, shape [contacts × D].
                velocity: "m/s", |m| m.dimensions() * m.contacts.len();
                /// J d: change of u along the Newton direction, shape [contacts × D].
                velocity_change: "m/s", |m| m.dimensions() * m.contacts.len();
                /// S + Jᵀ C J, unsymmetric.
                matrix: "kg, kg·m, kg·m²", |m| kept(m, unsymmetric::entries(m.system.kept()));
                /// s + Jᵀ λ*, then the solution of the system; with ghost rows.
                solution: "N·s, m/s", |m| kept(m, unsymmetric::rows(m.system.kept()));
                /// v: velocities of the kept unknowns, shape [kept].
                iterate: "m/s, rad/s", |m| kept(m, m.system.kept().size());
                /// d: Newton direction, shape [kept].
                direction: "m/s, rad/s", |m| kept(m, m.system.kept().size());
                /// S v − s: residual without contact, shape [kept].
                free_residual: "N·s, N·m·s", |m| kept(m, m.system.kept().size());
                /// S d, shape [kept].
                free_residual_change: "N·s, N·m·s", |m| kept(m, m.system.kept().size());
                /// r = S v − s − Jᵀ λ at a trial, shape [kept].
                residual: "N·s, N·m·s", |m| kept(m, m.system.kept().size());
                /// 1/diag S, the metric of the residual, shape [kept].
                inverse_diagonal: "1/kg, 1/(kg·m²)", |m| kept(m, m.system.kept().size());
                /// The search of each lane, see `line_search::LineSearch`, shape [6].
                line_search: "1", |_| LINE_SEARCH;
            }
        }
    };
}
pub(crate) use block_rows;

macro_rules! table {
    ($($section:ident { $($(#[doc = $doc:literal])+ $name:ident: $unit:literal, $rows:expr $(=> $allowed:expr)?;)* })*) => {
        /// All rows of a block; those of the contact solve last.
        pub const ROWS: &[RowGroup] = &[$($(RowGroup {
            name: stringify!($name),
            meaning: concat!($($doc),+).trim_ascii_start(),
            unit: $unit,
            role: role!($section),
            allowed: allowed!($($allowed)?),
            rows: $rows,
        },)*)*];
    };
}
/// The contact solve has a workspace of its own.
macro_rules! role {
    (Contact) => {
        Role::Workspace
    };
    ($role:ident) => {
        Role::$role
    };
}
macro_rules! allowed {
    () => {
        Allowed::Range(-GREATEST, GREATEST)
    };
    ($allowed:expr) => {
        $allowed
    };
}
block_rows!(table);

/// Rows that only a robot in space has, which can twist.
fn in_space(model: &Model, rows: usize) -> usize {
    model.sizes().twists() * rows
}

/// Rows of the contact solve: none where nothing touches.
fn kept(model: &Model, rows: usize) -> usize {
    if model.contacts.is_empty() { 0 } else { rows }
}

/// None where each wrench acts for one step.
fn held_wrenches(model: &Model) -> usize {
    let holds = model.program.magnetics.as_ref().is_some_and(|magnetics| magnetics.interval > 1);
    if holds { model.sizes().body() * model.bodies.len() } else { 0 }
}
