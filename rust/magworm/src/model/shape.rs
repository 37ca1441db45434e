//! The shape of a body that starts bent: places and frames that have given strains κ₁, κ₂ and τ at its nodes.
//!
//! With c = cos(τ/2), s = sin(τ/2) and κ = √(κ₁² + κ₂²) the element f after a node turns from the element
//! e before it by φ = κ/c about the axis n = p s_e + r u_e, p = (c κ₁ − s κ₂)/κ, r = −(s κ₁ + c κ₂)/κ, and then by τ about
//! its own tangent. This inverts the strains of [`crate::elastic`] (`twist.rs`), where the frames of e and f count by
//! halves: κ₁ = ½ φ n·(s_e + s_f), κ₂ = −½ φ n·(u_e + u_f).

use super::Mesh;
use crate::lanes::math::{degrees, sin_cos};
use crate::scene::bends::{angle_rad, curvature, strains};
use crate::scene::{Curvature, Scene};
use nalgebra::Vector3;

/// A bent body in the axes of its head element: tangent, up, side.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Place of each node from the head end [m].
    pub place_m: Vec<Vector3<f64>>,
    /// Tangent of each element.
    pub tangent: Vec<Vector3<f64>>,
    /// Up direction of each element.
    pub up: Vec<Vector3<f64>>,
    /// Turn of each element within the plane, whole turns counted [rad].
    pub turn_rad: Vec<f64>,
    /// κ₁, κ₂, τ of each bending node [rad].
    pub strains: Vec<[f64; 3]>,
}

impl Shape {
    /// The shape in which a validated scene starts; none for a straight body.
    pub fn new(scene: &Scene, mesh: &Mesh) -> Option<Self> {
        let start = &scene.start;
        let lists = [&start.bends_deg, &start.bends_aside_deg, &start.twists_deg];
        let bent = lists.into_iter().flatten().any(|&angle_deg| angle_deg != 0.0);
        bent.then(|| Self::with_strains(mesh, strains(scene, mesh)))
    }

    /// How far the body is bent, for a person.
    pub fn explain(&self) -> String {
        let greatest = |of: &dyn Fn([f64; 3]) -> f64| {
            self.strains.iter().map(|&strain| degrees(of(strain))).fold(0.0, f64::max)
        };
        let (angle, twist) = (greatest(&angle_rad), greatest(&|[_, _, twist]| twist.abs()));
        format!("bent by up to {angle:.1}° and twisted by up to {twist:.1}° at a node")
    }

    /// The strains of each bending node in the measure of a law, see [`crate::elastic`] (`twist.rs`).
    pub fn measured(&self, law: Curvature) -> impl Iterator<Item = [f64; 3]> {
        self.strains.iter().map(move |&strain| {
            let [first, second, twist] = strain;
            let scale = match law {
                Curvature::Angle => 1.0,
                Curvature::Tangent => tangent_over_angle(angle_rad(strain)),
            };
            [first * scale, second * scale, twist]
        })
    }

    fn with_strains(mesh: &Mesh, strains: Vec<[f64; 3]>) -> Self {
        let (mut tangent, mut up) = (vec![Vector3::x()], vec![Vector3::y()]);
        let mut turn_rad = vec![0.0];
        let mut place_m = vec![Vector3::x() * mesh.arc_m[0]];
        for element in 0..mesh.elements.len() {
            place_m.push(place_m[element] + tangent[element] * mesh.element_length_m(element));
            let Some(strain) = strains.get(element) else { break };
            let (t, u) = next_frame(tangent[element], up[element], *strain);
            tangent.push(t);
            up.push(u);
            turn_rad.push(turn_rad[element] + strain[0]);
        }
        Self { place_m, tangent, up, turn_rad, strains }
    }
}

/// Tangent and up of the element after a node, from those before it and the node's strains.
fn next_frame(
    t: Vector3<f64>,
    u: Vector3<f64>,
    [first, second, twist]: [f64; 3],
) -> (Vector3<f64>, Vector3<f64>) {
    let curvature = curvature(first, second);
    let (mut tangent, mut up) = (t, u);
    if curvature > 0.0 {
        let (s, c) = sin_cos(0.5 * twist);
        let along_side = (c * first - s * second) / curvature;
        let along_up = -(s * first + c * second) / curvature;
        let axis = t.cross(&u) * along_side + u * along_up;
        let turn = sin_cos(curvature / c);
        (tangent, up) = (turned(t, axis, turn), turned(u, axis, turn));
    }
    // Rounding would grow from node to node.
    let tangent = tangent.normalize();
    let up = turned(up, tangent, sin_cos(twist));
    (tangent, (up - tangent * up.dot(&tangent)).normalize())
}

/// A vector turned about a unit axis by an angle of that sine and cosine (Rodrigues).
fn turned(a: Vector3<f64>, axis: Vector3<f64>, (sin, cos): (f64, f64)) -> Vector3<f64> {
    a * cos + axis.cross(&a) * sin + axis * (axis.dot(&a) * (1.0 - cos))
}

/// 2 tan(φ/2)/φ.
fn tangent_over_angle(angle_rad: f64) -> f64 {
    let (sin, cos) = sin_cos(0.5 * angle_rad);
    if angle_rad == 0.0 { 1.0 } else { 2.0 * sin / (cos * angle_rad) }
}
