//! The shape of a body that starts bent: angles at its nodes, places and frames that have them.
//!
//! A list of P angles cuts the body into P equal parts of its length. The angle a_p of a part is spread evenly over the
//! lengths in it that bend. Around a node i that is C_i, from the middle of the element before to the middle of that after,
//! without rigid halves; a part that ends within it shares it with the next:
//!
//! α_i = Σ_p a_p |C_i ∩ P_p| / Σ_j |C_j ∩ P_p|,
//!
//! so that Σ_i α_i = Σ_p a_p, and the shape hangs on the mesh as little as any. Three such lists give the strains κ₁, κ₂ and
//! τ of each node. With c = cos(τ/2), s = sin(τ/2) and κ = √(κ₁² + κ₂²) the element f after the node turns from the element
//! e before it by φ = κ/c about the axis n = p s_e + r u_e, p = (c κ₁ − s κ₂)/κ, r = −(s κ₁ + c κ₂)/κ, and then by τ about
//! its own tangent. This inverts the strains of [`crate::elastic`] (`twist.rs`), where the frames of e and f count by
//! halves: κ₁ = ½ φ n·(s_e + s_f), κ₂ = −½ φ n·(u_e + u_f).

use super::Mesh;
use crate::lanes::math::{degrees, radians, sin_cos};
use crate::scene::Scene;
use nalgebra::Vector3;

/// Lengths below this part of the body's are none: edges of parts miss ends of magnets by rounding.
const NOTHING: f64 = 1e-9;

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
    let curvature = length(first, second);
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

/// κ₁, κ₂, τ of each bending node in the start of a scene [rad].
pub(crate) fn strains(scene: &Scene, mesh: &Mesh) -> Vec<[f64; 3]> {
    let start = &scene.start;
    let lists = [&start.bends_deg, &start.bends_aside_deg, &start.twists_deg];
    let [first, second, twist] = lists.map(|list_deg| spread_rad(mesh, list_deg));
    (0..first.len()).map(|node| [first[node], second[node], twist[node]]).collect()
}

/// φ of a node: the angle between its elements [rad].
pub(crate) fn angle_rad([first, second, twist]: [f64; 3]) -> f64 {
    length(first, second) / sin_cos(0.5 * twist).1
}

/// √(a² + b²), with equal bits everywhere.
fn length(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// What the parts of a list turn each bending node by [rad].
fn spread_rad(mesh: &Mesh, list_deg: &[f64]) -> Vec<f64> {
    let mut nodes_rad = vec![0.0; mesh.elements.len() - 1];
    for (part, angle_deg) in list_deg.iter().enumerate() {
        let lengths_m = bending_lengths_m(mesh, list_deg.len(), part);
        let whole_m: f64 = lengths_m.iter().sum();
        for (node_rad, length_m) in nodes_rad.iter_mut().zip(lengths_m) {
            if length_m > 0.0 {
                *node_rad += radians(*angle_deg) * (length_m / whole_m);
            }
        }
    }
    nodes_rad
}

/// The length of each bending node that lies in one of equal parts of the body [m].
pub(crate) fn bending_lengths_m(mesh: &Mesh, parts: usize, part: usize) -> Vec<f64> {
    let arc_m = &mesh.arc_m;
    let edge_m = |k: usize| mesh.length_m() * k as f64 / parts as f64;
    let (head_m, tail_m) = (edge_m(part), edge_m(part + 1));
    // The middle of a soft element beside a node; of a rigid one its end.
    let reach_m = |node: usize, element: usize| match mesh.elements[element].magnet {
        Some(_) => arc_m[node],
        None => 0.5 * (arc_m[element] + arc_m[element + 1]),
    };
    (1..mesh.elements.len())
        .map(|node| reach_m(node, node).min(tail_m) - reach_m(node, node - 1).max(head_m))
        .map(|length_m| if length_m > NOTHING * mesh.length_m() { length_m } else { 0.0 })
        .collect()
}
