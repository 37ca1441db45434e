//! Angles of a bent start, spread over the nodes of the mesh.
//!
//! A list of P angles cuts the body into P equal parts of its length. The angle a_p of a part is spread evenly over the
//! lengths in it that bend. Around a node i that is C_i, from the middle of the element before to the middle of that after,
//! without rigid halves; a part that ends within it shares it with the next:
//!
//! α_i = Σ_p a_p |C_i ∩ P_p| / Σ_j |C_j ∩ P_p|,
//!
//! so that Σ_i α_i = Σ_p a_p, and the shape hangs on the mesh as little as any. Three such lists give the strains κ₁, κ₂ and
//! τ of each node.

use super::{Mesh, Scene};
use crate::lanes::math::{radians, sin_cos};

/// Lengths below this part of the body's are none: edges of parts miss ends of magnets by rounding.
const NOTHING: f64 = 1e-9;

/// κ₁, κ₂, τ of each bending node in the start of a scene [rad].
pub(crate) fn strains(scene: &Scene, mesh: &Mesh) -> Vec<[f64; 3]> {
    let start = &scene.start;
    let lists = [&start.bends_deg, &start.bends_aside_deg, &start.twists_deg];
    let [first, second, twist] = lists.map(|list_deg| spread_rad(mesh, list_deg));
    (0..first.len()).map(|node| [first[node], second[node], twist[node]]).collect()
}

/// φ of a node: the angle between its elements [rad].
pub(crate) fn angle_rad([first, second, twist]: [f64; 3]) -> f64 {
    curvature(first, second) / sin_cos(0.5 * twist).1
}

/// κ = √(κ₁² + κ₂²), with equal bits everywhere [rad].
pub(crate) fn curvature(first: f64, second: f64) -> f64 {
    (first * first + second * second).sqrt()
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
    let reach_m = |node: usize, element: usize| match mesh.elements[element].body {
        Some(_) => arc_m[node],
        None => 0.5 * (arc_m[element] + arc_m[element + 1]),
    };
    (1..mesh.elements.len())
        .map(|node| reach_m(node, node).min(tail_m) - reach_m(node, node - 1).max(head_m))
        .map(|length_m| if length_m > NOTHING * mesh.length_m() { length_m } else { 0.0 })
        .collect()
}
