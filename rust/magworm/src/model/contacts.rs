//! Where contact may happen: points, the surfaces that they press on, and the parameters of the contact law.

use super::coordinates::{Anchor, Coordinates};
use crate::lanes::chain::Chain;
use crate::scene::{ContactPoint, Foot, Frame, Ground, Mesh, Precision, Problem, Scene};

/// Shape of a surface.
#[derive(Clone, Copy, Debug)]
pub enum Surface {
    /// The plane y = 0 with the normal +y.
    FlatGround,
    /// The nearest face or edge of a foot.
    Foot(Foot),
}

/// A contact point, and the surface that it may press on.
#[derive(Clone, Copy, Debug)]
pub struct ContactPair {
    /// The point.
    pub point: ContactPoint,
    /// The surface.
    pub surface: Surface,
    /// What the surface moves with.
    pub surface_frame: Frame,
    /// First unknown that the point moves with: x of its magnet, or of its node.
    pub dof: usize,
    /// Row of that unknown among those that the contact solve keeps.
    pub row: usize,
    /// Whether the point turns with a magnet.
    pub rigid: bool,
    /// The body that carries the surface; none where it stands still.
    pub surface_body: Option<SurfaceBody>,
}

/// A body that carries the surface of a contact pair.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceBody {
    /// Its first unknown.
    pub dof: usize,
    /// Row of that unknown among those that the contact solve keeps.
    pub row: usize,
    /// Place of the pair among those whose surface a body carries.
    pub place: usize,
}

impl ContactPair {
    /// First unknowns that the point moves with, and the surface where a body carries it.
    pub fn dofs(&self) -> [usize; 2] {
        [self.dof, self.surface_body.map_or(0, |body| body.dof)]
    }

    /// Rows of these among those that the contact solve keeps.
    pub fn rows(&self) -> [usize; 2] {
        [self.row, self.surface_body.map_or(0, |body| body.row)]
    }
}

/// Parameters of the contact law, see [`crate::contact`].
#[derive(Clone, Copy, Debug)]
pub struct ContactParameters {
    /// μ_s.
    pub static_friction: f64,
    /// μ_d.
    pub dynamic_friction: f64,
    /// v_d [m/s].
    pub transition_speed_m_s: f64,
    /// D_f [N].
    pub adhesion_n: f64,
    /// Stiffness k of the contact spring [N/m].
    pub stiffness_n_m: f64,
    /// Dissipation time τ: damping over stiffness [s].
    pub dissipation_time_s: f64,
    /// Rebound; none where impact is inelastic.
    pub restitution: Option<Restitution>,
}

/// Newton's law of impact, see `contact::rebound`.
#[derive(Clone, Copy, Debug)]
pub struct Restitution {
    /// e.
    pub coefficient: f64,
    /// u_r [m/s].
    pub from_m_s: f64,
    /// Effective mass of a point that rebounds [kg].
    pub mass_kg: f64,
}

impl Restitution {
    fn new(scene: &Scene, body_kg: f64) -> Option<Self> {
        let contact = &scene.contact;
        // As rigid as the tolerance of Newton's iteration allows, whose residual holds rounding of this mass times a velocity.
        let masses = match scene.solver.precision {
            Precision::Double => 1e4,
            Precision::Single => 1e2,
        };
        (contact.restitution > 0.0).then(|| Self {
            coefficient: contact.restitution,
            // What rests falls by this speed in a step; it must not be taken for something that arrives.
            from_m_s: contact
                .restitution_from_m_s
                .max(2.0 * scene.gravity_m_s2 * scene.solver.step_s),
            mass_kg: masses * body_kg,
        })
    }
}

/// Compression of the contact spring under the weight of the whole body, as a share of the body's thickness.
const STATIC_COMPRESSION: f64 = 1e-3;
/// Least radius of the edges with which feet meet, as a part of their shortest edge. Of sharp feet that meet end to end, corner on
/// corner, the side would be as near as the end.
const LEAST_ROUNDED: f64 = 0.05;
/// Largest effective mass of a contact, in masses of the body: with more a long step would find no solution.
const MAX_EFFECTIVE_MASS: f64 = 100.0;

impl ContactParameters {
    /// Those of a scene's ground. τ is twice that of critical damping under the whole body, 4 √(m/k), so that nothing
    /// rebounds.
    pub(super) fn new(ground: &Ground, scene: &Scene, mesh: &Mesh) -> Self {
        let thickness_m = mesh.elements.iter().map(|e| e.thickness_m).fold(0.0, f64::max);
        let (mass_kg, compression_m) =
            (body_mass_kg(scene, mesh), STATIC_COMPRESSION * thickness_m);
        let stiffness_n_m = mass_kg * 9.81 / compression_m;
        let dissipation_time_s = 4.0 * (mass_kg / stiffness_n_m).sqrt();
        let step_s = scene.solver.step_s;
        let stiffest_n_m = MAX_EFFECTIVE_MASS * mass_kg / (step_s * dissipation_time_s.max(step_s));
        // A foot has a toe and a heel in the plane, two of each in space.
        let share = 1.0 / (scene.dimensions - 1) as f64;
        Self {
            static_friction: ground.static_friction,
            dynamic_friction: ground.dynamic_friction,
            // Slower than this a point that slides cannot be told from one whose spring gives.
            transition_speed_m_s: ground
                .transition_speed_m_s
                .max(compression_m / dissipation_time_s),
            adhesion_n: share * ground.adhesion_n,
            stiffness_n_m: share * stiffness_n_m.min(stiffest_n_m),
            dissipation_time_s,
            restitution: Restitution::new(scene, mass_kg),
        }
    }
}

/// The pairs that a scene with ground has: its contact points that can move, with the ground.
///
/// # Errors
/// A point moves with an unknown that is eliminated before contact is solved.
pub(super) fn contact_pairs(
    points: &[ContactPoint],
    coordinates: &Coordinates,
    system: &Chain,
) -> Result<Vec<ContactPair>, Problem> {
    let pair = |&point: &ContactPoint| {
        let (dof, rigid) = moves_with(point.frame, coordinates)?;
        let (surface, surface_frame) = (Surface::FlatGround, Frame::World);
        let kept = system.place(dof).ok_or_else(|| eliminated(dof));
        Some(kept.map(|row| ContactPair {
            point,
            surface,
            surface_frame,
            dof,
            row,
            rigid,
            surface_body: None,
        }))
    };
    points.iter().filter_map(pair).collect()
}

/// A body of which a point touches that contact does not reach. None that the rules let pass has one.
fn eliminated(dof: usize) -> Problem {
    Problem::Value {
        field: "body".into(),
        value: format!("a layout with a contact point on unknown {dof}"),
        allowed: "contact points on magnets where soft unknowns are eliminated".into(),
    }
}

/// The pairs of neighbouring feet: all corners of each with the other.
pub(super) fn pairs_between_feet(
    feet: &[Foot],
    across: &[f64],
    coordinates: &Coordinates,
    system: &Chain,
) -> Result<Vec<ContactPair>, Problem> {
    let place = |foot: &Foot| {
        let dof = coordinates.bodies[foot.body];
        system.place(dof).map(|row| (dof, row)).ok_or_else(|| eliminated(dof))
    };
    let feet: Vec<Foot> =
        feet.iter().map(|foot| foot.rounded(LEAST_ROUNDED, coordinates.dimensions)).collect();
    let neighbours = feet.windows(2).flat_map(|two| [(two[0], two[1]), (two[1], two[0])]);
    let corners = neighbours.flat_map(|(foot, other)| {
        [-1.0, 1.0]
            .into_iter()
            .flat_map(move |up| foot.corners(up, across).map(move |corner| (foot, other, corner)))
    });
    let pair = |(index, (foot, other, point)): (usize, (Foot, Foot, ContactPoint))| {
        let ((dof, row), (surface_dof, surface_row)) = (place(&foot)?, place(&other)?);
        Ok(ContactPair {
            point,
            surface: Surface::Foot(other),
            surface_frame: Frame::Body(other.body),
            dof,
            row,
            rigid: true,
            surface_body: Some(SurfaceBody { dof: surface_dof, row: surface_row, place: index }),
        })
    };
    corners.enumerate().map(pair).collect()
}

/// First unknown that a frame moves with, and whether it turns with a magnet; none where it stands still.
fn moves_with(frame: Frame, coordinates: &Coordinates) -> Option<(usize, bool)> {
    match frame {
        Frame::World => None,
        Frame::Body(body) => Some((coordinates.bodies[body], true)),
        Frame::Node(node) => match coordinates.anchors[node] {
            Anchor::Free { dof } => Some((dof, false)),
            Anchor::Rigid { body, .. } => Some((coordinates.bodies[body], true)),
            Anchor::Fixed => None,
        },
    }
}

/// Mass of the whole body with all its magnets [kg].
pub(super) fn body_mass_kg(scene: &Scene, mesh: &Mesh) -> f64 {
    let rubber_m3: f64 = (0..mesh.elements.len()).map(|e| mesh.volume_m3(e)).sum();
    scene.material.density_kg_m3 * rubber_m3 + magnets_kg(mesh)
}

/// Mass of all magnets: one product for those that are alike.
fn magnets_kg(mesh: &Mesh) -> f64 {
    let mut left_kg: Vec<f64> = mesh.magnets.iter().map(|held| held.magnet.mass_kg()).collect();
    let mut total_kg = 0.0;
    while let Some(&mass_kg) = left_kg.first() {
        let before = left_kg.len();
        left_kg.retain(|other_kg| *other_kg != mass_kg);
        total_kg += mass_kg * (before - left_kg.len()) as f64;
    }
    total_kg
}
