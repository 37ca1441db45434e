//! Springs of the rubber: axial ones of elements, bending and twisting ones of nodes.

use super::{Coordinates, Element, Mesh, Stencil};
use crate::scene::Scene;

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
    /// The same for twisting, with GJ in place of EI, see `torsion_constant_m4` [N·m].
    pub twist_n_m: f64,
    /// The unknowns it acts on.
    pub stencil: Stencil,
}

pub(super) fn stretch_springs(
    scene: &Scene,
    mesh: &Mesh,
    coordinates: &Coordinates,
) -> Vec<Stretch> {
    let flexible = |e: &usize| mesh.elements[*e].body.is_none() && e + 2 > mesh.fixed_nodes;
    (0..mesh.elements.len())
        .filter(flexible)
        .map(|element| {
            let rest_m = mesh.element_length_m(element);
            let Element { thickness_m, width_m, .. } = mesh.elements[element];
            let area_m2 = width_m * thickness_m;
            Stretch {
                element,
                rest_m,
                stiffness_n_m: scene.material.youngs_modulus_pa * area_m2 / rest_m,
                stencil: Stencil::new(coordinates, &[element, element + 1]),
            }
        })
        .collect()
}

pub(super) fn bending_springs(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<Bend> {
    let modulus_pa = scene.material.youngs_modulus_pa;
    let shear_modulus_pa = modulus_pa / (2.0 * (1.0 + scene.material.poisson_ratio));
    // Two halves of elements in series; a rigid element does not yield.
    let in_series = |node: usize, rigidity_n_m2: &dyn Fn(f64, f64) -> f64| {
        let compliance = |element: usize| {
            let Element { thickness_m, width_m, body } = mesh.elements[element];
            let half_m = 0.5 * mesh.element_length_m(element);
            if body.is_some() { 0.0 } else { half_m / rigidity_n_m2(thickness_m, width_m) }
        };
        1.0 / (compliance(node - 1) + compliance(node))
    };
    let up = |h: f64, w: f64| modulus_pa * (w * cube(h) / 12.0);
    let across = |h: f64, w: f64| modulus_pa * (h * cube(w) / 12.0);
    let twist = |h: f64, w: f64| shear_modulus_pa * torsion_constant_m4(w, h);
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
fn torsion_constant_m4(width_m: f64, thickness_m: f64) -> f64 {
    let (b, h) = (width_m.max(thickness_m), width_m.min(thickness_m));
    let slender = h / b;
    let square = slender * slender;
    b * cube(h) * (1.0 / 3.0 - 0.21 * slender * (1.0 - square * square / 12.0))
}

fn cube(x: f64) -> f64 {
    x * x * x
}
