//! `compile(Scene) → Model`: everything that does not change in time, shared by all environments.

mod coordinates;
mod explain;
mod inertia;
mod magnetics;
mod mesh;

pub use coordinates::{Anchor, Coordinates, MOST, Spin, Stencil, Tie, Unknowns, body_size};
pub use inertia::MassPart;
pub use magnetics::{Magnetics, PairModel};
pub use mesh::{Element, Mesh, MeshMagnet, Sole};

use crate::drive::DriveModel;
use crate::lanes::banded::Band;
use crate::lanes::math::sin_cos;
use crate::magnetic::UniformField;
use crate::scene::{Integrator, Parameter, Scene, SceneError};

/// A compiled scene.
#[derive(Clone, Debug)]
pub struct Model {
    /// The scene it was compiled from.
    pub scene: Scene,
    /// Nodes and elements.
    pub mesh: Mesh,
    /// Unknowns.
    pub coordinates: Coordinates,
    /// Matrix shape.
    pub band: Band,
    /// Axial springs.
    pub stretch: Vec<Stretch>,
    /// Bending springs; in space they twist as well.
    pub bend: Vec<Bend>,
    /// Contributions to the mass of each unknown.
    pub inertia: Vec<MassPart>,
    /// Unknowns that are translations, with their axis (0 for x, 1 for y, 2 for z).
    pub translations: Vec<(usize, usize)>,
    /// Half length of the body magnets [m].
    pub half_magnet_m: f64,
    /// Remanence of a body magnet [T].
    pub magnet_remanence_t: f64,
    /// Greatest thickness of the body [m].
    pub thickness_m: f64,
    /// Ground contacts.
    pub contacts: Vec<Contact>,
    /// The terms of this scene's program; what a scene lacks is absent.
    pub program: Program,
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
    /// Torque of a uniform field on the body magnets.
    pub uniform_field: Option<UniformTorque>,
    /// Ground contact with friction.
    pub ground: Option<GroundLaw>,
    /// The drive's motion.
    pub drive: Option<DriveModel>,
}

/// Torque of a uniform field on a body magnet.
#[derive(Clone, Copy, Debug)]
pub struct UniformTorque {
    /// Flux density along x, y and z [T].
    pub field_t: [f64; 3],
    /// A body magnet in it.
    pub magnet: UniformField,
}

/// Friction of the ground, see [`crate::contact`].
#[derive(Clone, Copy, Debug)]
pub struct GroundLaw {
    /// μ_s.
    pub static_friction: f64,
    /// μ_d.
    pub dynamic_friction: f64,
    /// v_d [m/s].
    pub transition_speed_m_s: f64,
    /// D_f [N].
    pub adhesion_n: f64,
    /// Mass of a typical node [kg].
    pub node_mass_kg: f64,
    /// Weight w of the penalty that holds a contact [kg], see `penalty_weight_kg`.
    pub weight_kg: f64,
}

/// Axial spring of an element: E = ½ k (|e| − l)², k = EA/l.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// The element; its nodes are this and the next.
    pub element: usize,
    /// Rest length l [m].
    pub rest_m: f64,
    /// k = EA/l [N/m].
    pub stiffness_n_m: f64,
    /// The unknowns it acts on.
    pub stencil: Stencil,
}

/// Bending spring at a node: E = ½ B κ², see [`crate::scene::Curvature`]; in space a spring for each axis and
/// one for twist.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// The node; its elements are the one before and this.
    pub node: usize,
    /// B = 1/(l⁻/2EI⁻ + l⁺/2EI⁺) [N·m], I = w h³/12: two halves in series; EI/l̄ where they are alike.
    pub stiffness_n_m: f64,
    /// The same for bending to the side, I = h w³/12 [N·m].
    pub across_n_m: f64,
    /// The same for twisting, with GJ in place of EI, see [`torsion_constant_m4`] [N·m].
    pub twist_n_m: f64,
    /// The unknowns it acts on.
    pub stencil: Stencil,
}

/// A point of the underside that may touch the ground.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Where it is.
    pub sole: Sole,
    /// The unknowns it moves with: those of its magnet, or of its node.
    pub stencil: Stencil,
}

impl Model {
    /// Validates and compiles a scene.
    ///
    /// # Errors
    /// A field that is out of its range, or fields that contradict each other.
    pub fn compile(scene: &Scene) -> Result<Self, SceneError> {
        scene.validate()?;
        let mesh = Mesh::new(scene);
        let unknowns = match scene.solver.integrator {
            Integrator::Implicit => Unknowns::Reduced,
            Integrator::Explicit => Unknowns::Multipliers,
        };
        let coordinates = Coordinates::new(&mesh, unknowns, scene.dimensions);
        let mut stretch = stretch_springs(scene, &mesh, &coordinates);
        let mut bend = bending_springs(scene, &mesh, &coordinates);
        let mut contacts = match scene.ground {
            Some(_) => contact_points(&mesh, &coordinates),
            None => Vec::new(),
        };
        let inertia = inertia::mass_parts(scene, &mesh, &coordinates);
        let band = band(&coordinates, &stretch, &bend, &contacts);
        let in_matrix = coordinates.ties.is_empty();
        stretch.iter_mut().filter(|_| in_matrix).for_each(|s| s.stencil.locate(&band));
        bend.iter_mut().filter(|_| in_matrix).for_each(|b| b.stencil.locate(&band));
        contacts.iter_mut().for_each(|c| c.stencil.locate(&band));
        let program = Program::new(scene, &mesh);
        let step_s = scene.solver.step_s;
        Ok(Self {
            scene: scene.clone(),
            translations: translations(&coordinates),
            magnet_remanence_t: scene.magnet.as_ref().map_or(0.0, |m| m.remanence_t),
            thickness_m: mesh.elements.iter().map(|e| e.thickness_m).fold(0.0, f64::max),
            half_magnet_m: scene.magnet.as_ref().map_or(0.0, |m| 0.5 * m.length_m),
            steps_per_control: (scene.control.step_s / step_s).round() as u32,
            step_s,
            band,
            stretch,
            bend,
            inertia,
            contacts,
            program,
            coordinates,
            mesh,
        })
    }

    /// Number of body magnets, removed ones included.
    pub fn magnets(&self) -> usize {
        self.mesh.magnets.len()
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.mesh.arc_m.len()
    }

    /// 2 in the plane, 3 in space.
    pub fn dimensions(&self) -> usize {
        self.coordinates.dimensions
    }

    /// The parameters that each environment may have for its own.
    pub const PARAMETERS: [Parameter; 7] = [
        Parameter::Stiffness,
        Parameter::Damping,
        Parameter::Mass,
        Parameter::Remanence,
        Parameter::StaticFriction,
        Parameter::DynamicFriction,
        Parameter::DriveSpeed,
    ];
}

impl Program {
    fn new(scene: &Scene, mesh: &Mesh) -> Self {
        let magnetic = scene.magnet.as_ref().filter(|_| mesh.magnets.iter().any(|m| m.present));
        let drive = scene.drive.as_ref().map(DriveModel::new);
        Self {
            gravity_m_s2: (scene.gravity_m_s2 > 0.0).then(|| gravity(scene)),
            magnetics: magnetic
                .zip(scene.drive.as_ref())
                .map(|(magnet, drive)| Magnetics::new(scene, magnet, drive)),
            uniform_field: magnetic.zip(scene.field.as_ref()).map(|(magnet, field)| {
                UniformTorque {
                    field_t: [field.x_t, field.y_t, field.z_t],
                    magnet: UniformField::new(magnetics::cuboid(magnet)),
                }
            }),
            ground: scene.ground.as_ref().map(|g| GroundLaw {
                static_friction: g.static_friction,
                dynamic_friction: g.dynamic_friction,
                transition_speed_m_s: g.transition_speed_m_s,
                // A foot has a toe and a heel in the plane, two of each in space.
                adhesion_n: g.adhesion_n * if scene.dimensions == 3 { 0.5 } else { 1.0 },
                node_mass_kg: typical_node_mass_kg(scene, mesh),
                weight_kg: penalty_weight_kg(scene, mesh),
            }),
            drive,
        }
    }
}

fn gravity(scene: &Scene) -> [f64; 3] {
    let incline = scene.ground.as_ref().map_or(0.0, |g| g.incline_deg.to_radians());
    let (sin, cos) = sin_cos(incline);
    [scene.gravity_m_s2 * sin, -scene.gravity_m_s2 * cos, 0.0]
}

/// Weight of the penalty that holds a contact.
///
/// Large against the nodal mass m, so that the residual velocity is far below 1e-9 m/s; so small that
/// rounding (1e-16 w) leaves the masses eight digits: w = 1e8 m. Short steps need less: the height of a
/// point is known to about 1e-18 m, which the penalty turns into an impulse w · 1e-18 m/Δt; it must
/// stay below 1e-5 of the impulse of weight, m g Δt, hence w ≤ 1e14 m (Δt/s)².
fn penalty_weight_kg(scene: &Scene, mesh: &Mesh) -> f64 {
    let step_s = scene.solver.step_s;
    typical_node_mass_kg(scene, mesh) * (1e14 * step_s * step_s).clamp(1e2, 1e8)
}

fn typical_node_mass_kg(scene: &Scene, mesh: &Mesh) -> f64 {
    let volume_m3: f64 = (0..mesh.elements.len())
        .map(|e| mesh.element_length_m(e) * mesh.elements[e].thickness_m * mesh.width_m)
        .sum();
    scene.material.density_kg_m3 * volume_m3 / mesh.arc_m.len() as f64
}

fn stretch_springs(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<Stretch> {
    let flexible = |e: &usize| mesh.elements[*e].magnet.is_none() && e + 2 > mesh.fixed_nodes;
    (0..mesh.elements.len())
        .filter(flexible)
        .map(|element| {
            let rest_m = mesh.element_length_m(element);
            let area_m2 = mesh.width_m * mesh.elements[element].thickness_m;
            Stretch {
                element,
                rest_m,
                stiffness_n_m: scene.material.youngs_modulus_pa * area_m2 / rest_m,
                stencil: Stencil::new(coordinates, &[element, element + 1]),
            }
        })
        .collect()
}

fn bending_springs(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<Bend> {
    let width_m = mesh.width_m;
    let modulus_pa = scene.material.youngs_modulus_pa;
    let shear_modulus_pa = modulus_pa / (2.0 * (1.0 + scene.material.poisson_ratio));
    // Two halves of elements in series; a rigid element does not yield.
    let in_series = |node: usize, rigidity_n_m2: &dyn Fn(f64) -> f64| {
        let compliance = |element: usize| {
            let Element { thickness_m, magnet } = mesh.elements[element];
            let half_m = 0.5 * mesh.element_length_m(element);
            if magnet.is_some() { 0.0 } else { half_m / rigidity_n_m2(thickness_m) }
        };
        1.0 / (compliance(node - 1) + compliance(node))
    };
    let up = |h: f64| modulus_pa * (width_m * h.powi(3) / 12.0);
    let across = |h: f64| modulus_pa * (h * width_m.powi(3) / 12.0);
    let twist = |h: f64| shear_modulus_pa * torsion_constant_m4(width_m, h);
    (1..mesh.elements.len())
        .map(|node| Bend {
            node,
            stiffness_n_m: in_series(node, &up),
            across_n_m: in_series(node, &across),
            twist_n_m: in_series(node, &twist),
            stencil: Stencil::with_twist(coordinates, &[node - 1, node, node + 1]),
        })
        .collect()
}

/// Torsion constant J of a rectangle [m⁴]: b h³ (1/3 − 0.21 (h/b) (1 − h⁴/12b⁴)) with h ≤ b, within 0.5 % of
/// Saint-Venant's series (Roark's formulas for stress and strain, table of torsion, case 4).
pub fn torsion_constant_m4(width_m: f64, thickness_m: f64) -> f64 {
    let (b, h) = (width_m.max(thickness_m), width_m.min(thickness_m));
    let slender = h / b;
    b * h.powi(3) * (1.0 / 3.0 - 0.21 * slender * (1.0 - slender.powi(4) / 12.0))
}

fn contact_points(mesh: &Mesh, coordinates: &Coordinates) -> Vec<Contact> {
    mesh.soles
        .iter()
        .map(|&sole| Contact {
            sole,
            stencil: match sole {
                Sole::Foot { body, .. } => Stencil::of_body(coordinates, body),
                Sole::Node { node, .. } => Stencil::new(coordinates, &[node]),
            },
        })
        .filter(|contact| contact.stencil.count > 0)
        .collect()
}

fn band(
    coordinates: &Coordinates,
    stretch: &[Stretch],
    bend: &[Bend],
    contacts: &[Contact],
) -> Band {
    let mut band = Band::diagonal(coordinates.count);
    for tie in &coordinates.ties {
        let Anchor::Free { dof } = coordinates.anchors[tie.node] else { continue };
        let body = coordinates.bodies[tie.body];
        let (axis, rotation) = (coordinates.dimensions - 1, coordinates.body_size() - 1);
        band.couple(&[tie.dof, tie.dof + axis, dof, dof + axis, body, body + rotation]);
    }
    // Explicit schemes have no stiffness in their matrix.
    if coordinates.ties.is_empty() {
        stretch.iter().for_each(|s| band.couple(&s.stencil.dofs[..s.stencil.count]));
        bend.iter().for_each(|b| band.couple(&b.stencil.dofs[..b.stencil.count]));
    }
    contacts.iter().for_each(|c| band.couple(&c.stencil.dofs[..c.stencil.count]));
    if coordinates.dimensions == 3 {
        coordinates.bodies.iter().for_each(|&body| band.couple(&[body + 3, body + 5]));
    }
    band
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
