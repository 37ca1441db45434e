//! `compile(Scene) → Model`: everything that does not change in time, shared by all environments.

mod contacts;
mod coordinates;
mod explain;
mod explicit_limit;
mod fingerprint;
mod inertia;
mod line;
mod magnet;
mod magnetics;
mod mutual;
mod pair_by_distance;
mod phases;
mod relaxation;
mod rigid_body;
mod robot;
pub(crate) mod rows;
mod shape;
mod springs;
mod waves;

pub use crate::scene::{ContactPoint, Element, Foot, Frame, Mesh};
pub use contacts::{ContactPair, ContactParameters, Restitution, Surface};
pub use coordinates::{Anchor, Coordinates, MAX_STENCIL, Spin, Stencil, Tie, Unknowns};
pub(crate) use fingerprint::Sum;
pub use inertia::{MassPart, OffCentre};
pub use magnet::{Carrier, Magnet};
pub use magnetics::{Magnetics, PairModel};
pub use mutual::Mutual;
pub use pair_by_distance::PairByDistance;
pub use phases::Phase;
pub use relaxation::{Branch, Relaxation};
pub use rigid_body::RigidBody;
pub use robot::Robot;
pub use rows::{Allowed, GREATEST, ROWS, Role, RowGroup};
pub use shape::Shape;
pub use springs::{Bend, Stretch};
pub use waves::Wave;

use crate::actuator::Actuator;
use crate::lanes::Dimensions;
use crate::lanes::banded::OutOfReach;
use crate::lanes::chain::Chain;
use crate::lanes::math::{radians, sin_cos};
use crate::magnetic::UniformField;
use crate::scene::{Parameter, Problem, Scene, SceneError};
use springs::{bending_springs, stretch_springs};

/// A compiled scene.
#[derive(Clone, Debug)]
pub struct Model {
    /// The scene it was compiled from.
    pub scene: Scene,
    /// A number that two scenes share only if they simulate the same: they may differ in their names.
    pub fingerprint: u64,
    /// Nodes and elements.
    pub mesh: Mesh,
    /// Unknowns.
    pub coordinates: Coordinates,
    /// Rigid bodies, head first.
    pub bodies: Vec<RigidBody>,
    /// Magnets: those of the bodies, head first, then those of the actuators.
    pub magnets: Vec<Magnet>,
    /// Whose the nodes and bodies are.
    pub robots: Vec<Robot>,
    /// Shape of the equations of a step.
    pub system: Chain,
    /// Place in the matrix of each unknown's own entry.
    pub diagonal: Vec<usize>,
    /// Axial springs.
    pub stretch: Vec<Stretch>,
    /// Bending springs; in space they twist as well.
    pub bend: Vec<Bend>,
    /// Shape of the body at the start; none where it is straight.
    pub shape: Option<Shape>,
    /// Contributions of the rubber to the mass of each unknown, what is in the middle of bodies aside.
    pub rubber: Vec<MassPart>,
    /// Unknowns that are translations, with their axis (0 for x, 1 for y, 2 for z).
    pub translations: Vec<(usize, usize)>,
    /// Greatest thickness of the body [m].
    pub thickness_m: f64,
    /// Contact points with the surfaces that they may press on.
    pub contacts: Vec<ContactPair>,
    /// The terms of this scene's program; what a scene lacks is absent.
    pub program: Program,
    /// The phases of a step that it needs, in their order.
    pub phases: Vec<Phase>,
    /// Time step [s].
    pub step_s: f64,
    /// Solver steps per control step.
    pub steps_per_control: u32,
}

/// Optional terms of the equations of motion.
#[derive(Clone, Debug)]
pub struct Program {
    /// Gravity along x, y and z of the ground's frame [m/s²].
    pub gravity_m_s2: Option<[f64; 3]>,
    /// Wrench of the drive magnets on the body magnets.
    pub magnetics: Option<Magnetics>,
    /// Wrenches of the body magnets on each other.
    pub mutual: Option<Mutual>,
    /// Torque of a uniform field on the body magnets.
    pub uniform_field: Option<UniformTorque>,
    /// Branches of rubber that relaxes.
    pub relaxation: Relaxation,
    /// Ground contact with friction.
    pub contact: Option<ContactParameters>,
    /// What moves the sources of the field.
    pub actuators: Vec<Actuator>,
}

/// Torque of a uniform field on the body magnets.
#[derive(Clone, Debug)]
pub struct UniformTorque {
    /// Flux density along x, y and z [T].
    pub field_t: [f64; 3],
    /// Each body magnet in it.
    pub magnets: Vec<UniformField>,
}

impl Model {
    /// Validates and compiles a scene.
    ///
    /// # Errors
    /// A field that is out of its range, fields that contradict each other, a body that no kernel is compiled for, or a step
    /// beyond the limit of the explicit scheme.
    pub fn compile(scene: &Scene) -> Result<Self, SceneError> {
        scene.validate()?;
        let mesh = Mesh::new(scene);
        let integrator = scene.solver.integrator;
        let unknowns = match integrator.coefficients().multipliers {
            false => Unknowns::Reduced,
            true => Unknowns::Multipliers,
        };
        let coordinates = Coordinates::new(&mesh, unknowns, scene.dimensions);
        let mut stretch = stretch_springs(scene, &mesh, &coordinates);
        let mut bend = bending_springs(scene, &mesh, &coordinates);
        let touching = if scene.ground.is_some() { &mesh.contact_points[..] } else { &[] };
        let system = system(&coordinates, &stretch, &bend, touching).map_err(no_kernel)?;
        let mut contacts = contacts::contact_pairs(touching, &coordinates, &system)?;
        if scene.contact.between_feet {
            let across = coordinates.sizes().across;
            contacts.extend(contacts::pairs_between_feet(
                &mesh.feet,
                across,
                &coordinates,
                &system,
            )?);
        }
        let in_matrix = coordinates.ties.is_empty();
        stretch.iter_mut().filter(|_| in_matrix).for_each(|s| s.stencil.locate(&system));
        bend.iter_mut().filter(|_| in_matrix).for_each(|b| b.stencil.locate(&system));
        let actuators = Actuator::of(scene);
        let magnets = Magnet::all(&mesh, scene.drive.as_ref(), &actuators);
        let program = Program::new(scene, &mesh, &magnets, actuators);
        let step_s = scene.solver.step_s;
        let model = Self {
            scene: scene.clone(),
            fingerprint: fingerprint::fingerprint(scene),
            translations: translations(&coordinates),
            thickness_m: mesh.elements.iter().map(|e| e.thickness_m).fold(0.0, f64::max),
            steps_per_control: (scene.control.step_s / step_s).round() as u32,
            step_s,
            diagonal: (0..coordinates.count).map(|dof| system.at(dof, dof)).collect(),
            system,
            stretch,
            bend,
            shape: Shape::new(scene, &mesh),
            rubber: inertia::rubber_parts(scene, &mesh, &coordinates),
            bodies: RigidBody::all(scene, &mesh, &coordinates),
            magnets,
            phases: Phase::of(&program, &contacts),
            contacts,
            program,
            coordinates,
            robots: vec![Robot::whole(&mesh)],
            mesh,
        };
        if integrator.is_explicit() {
            model.explicit_limit().check(step_s)?;
        }
        Ok(model)
    }

    /// Number of body magnets, removed ones included.
    pub fn magnets(&self) -> usize {
        self.mesh.magnets.len()
    }

    /// Which body magnets the scene leaves in.
    pub fn present(&self) -> Vec<bool> {
        self.mesh.magnets.iter().map(|held| held.magnet.present).collect()
    }

    /// Bodies whose centre of mass may lie beside the middle of their element.
    #[inline(always)]
    pub fn off_centre(&self) -> impl Iterator<Item = &OffCentre> {
        self.bodies.iter().filter_map(|body| body.off_centre.as_ref())
    }

    /// Number of contact pairs whose surface a body carries.
    pub fn moving_surfaces(&self) -> usize {
        self.contacts.iter().filter(|pair| pair.surface_body.is_some()).count()
    }

    /// Whether points that arrive at a surface may rebound.
    pub fn restitutes(&self) -> bool {
        self.program.contact.is_some_and(|law| law.restitution.is_some())
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.mesh.arc_m.len()
    }

    /// 2 in the plane, 3 in space.
    pub fn dimensions(&self) -> usize {
        self.coordinates.dimensions
    }

    /// The sizes that follow from that.
    pub fn sizes(&self) -> Dimensions {
        self.coordinates.sizes()
    }

    /// The parameters that each environment may have for its own.
    pub const PARAMETERS: [Parameter; 11] = [
        Parameter::Stiffness,
        Parameter::Damping,
        Parameter::Mass,
        Parameter::Remanence,
        Parameter::StaticFriction,
        Parameter::DynamicFriction,
        Parameter::DriveSpeed,
        Parameter::HorizontalForce,
        Parameter::VerticalForce,
        Parameter::Torque,
        Parameter::Mutual,
    ];
}

impl Program {
    fn new(scene: &Scene, mesh: &Mesh, magnets: &[Magnet], actuators: Vec<Actuator>) -> Self {
        let (held, moved) = magnets.split_at(mesh.magnets.len());
        let magnetic = mesh.magnets.iter().any(|held| held.magnet.present);
        let field = scene.field.as_ref().filter(|_| magnetic);
        Self {
            gravity_m_s2: (scene.gravity_m_s2 > 0.0).then(|| gravity(scene)),
            magnetics: (magnetic && !moved.is_empty()).then(|| Magnetics::new(scene, magnets)),
            mutual: Mutual::new(scene, mesh, magnets),
            uniform_field: field.map(|field| UniformTorque {
                field_t: [field.x_t, field.y_t, field.z_t],
                magnets: held.iter().map(|magnet| UniformField::new(magnet.cuboid())).collect(),
            }),
            relaxation: Relaxation::new(scene),
            contact: scene
                .ground
                .as_ref()
                .map(|ground| ContactParameters::new(ground, scene, mesh)),
            actuators,
        }
    }

    /// Whether an actuator follows actions.
    pub fn is_controlled(&self) -> bool {
        self.actuators.iter().any(Actuator::is_controlled)
    }

    /// Number of the actuators' magnets.
    pub fn drive_magnets(&self) -> usize {
        self.actuators.iter().map(Actuator::magnets).sum()
    }
}

fn gravity(scene: &Scene) -> [f64; 3] {
    let incline = scene.ground.as_ref().map_or(0.0, |g| radians(g.incline_deg));
    let (sin, cos) = sin_cos(incline);
    [scene.gravity_m_s2 * sin, -scene.gravity_m_s2 * cos, 0.0]
}

/// The shape of the equations of a step. Where only magnets touch the ground, what lies between them is eliminated
/// before contact is solved.
fn system(
    coordinates: &Coordinates,
    stretch: &[Stretch],
    bend: &[Bend],
    points: &[ContactPoint],
) -> Result<Chain, OutOfReach> {
    let on_magnets =
        !points.is_empty() && points.iter().all(|point| matches!(point.frame, Frame::Body(_)));
    // A multiplier has no mass of its own: it cannot be eliminated before the magnet that it follows.
    let on_magnets = on_magnets && coordinates.ties.is_empty();
    let mut system = if on_magnets {
        Chain::condensed(coordinates.count, &coordinates.bodies, coordinates.body_size())?
    } else {
        Chain::whole(coordinates.count)
    };
    for tie in &coordinates.ties {
        let Anchor::Free { dof } = coordinates.anchors[tie.node] else { continue };
        let body = coordinates.bodies[tie.body];
        let (axis, rotation) = (coordinates.dimensions - 1, coordinates.body_size() - 1);
        system.couple(&[tie.dof, tie.dof + axis, dof, dof + axis, body, body + rotation])?;
    }
    // Explicit schemes have no stiffness in their matrix.
    if coordinates.ties.is_empty() {
        stretch.iter().try_for_each(|s| system.couple(s.stencil.unknowns()))?;
        bend.iter().try_for_each(|b| system.couple(b.stencil.unknowns()))?;
    }
    for &body in &coordinates.bodies {
        system.couple(&[body, body + coordinates.body_size() - 1])?;
    }
    Ok(system)
}

/// A body whose equations no kernel solves. Every body that the rules let pass is solved by one.
fn no_kernel(OutOfReach { from, to }: OutOfReach) -> Problem {
    Problem::Value {
        field: "body".into(),
        value: format!("a layout that couples unknowns {from} and {to}"),
        allowed: "springs between neighbours along the body".into(),
    }
}

fn translations(coordinates: &Coordinates) -> Vec<(usize, usize)> {
    let free = coordinates.anchors.iter().filter_map(|anchor| match *anchor {
        Anchor::Free { dof } => Some(dof),
        _ => None,
    });
    free.chain(coordinates.bodies.iter().copied())
        .flat_map(|dof| (0..coordinates.dimensions).map(move |axis| (dof + axis, axis)))
        .collect()
}

#[cfg(test)]
mod tests;
