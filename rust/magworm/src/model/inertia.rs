//! Masses: rubber lumped on the nodes, magnets as rigid bodies.
//!
//! Half of a soft element's rubber goes to each of its nodes. The rubber around a magnet goes ⅙, ⅔, ⅙
//! to its head end, centre and tail end (Simpson), which keeps mass and moment of inertia m l²/12.

use super::coordinates::{Anchor, Coordinates};
use super::mesh::Mesh;
use crate::scene::{Magnet, Scene};

/// A contribution to the diagonal mass of one unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassPart {
    /// The unknown.
    pub dof: usize,
    /// Always there [kg or kg·m²].
    pub rubber: f64,
    /// The magnet whose presence adds `magnet` and whose absence adds `fill`.
    pub body: Option<usize>,
    /// Of the magnet [kg or kg·m²].
    pub magnet: f64,
    /// Of the rubber in an empty cavity [kg or kg·m²].
    pub fill: f64,
}

/// Contributions to the mass of every unknown that has one.
pub fn mass_parts(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<MassPart> {
    let mut rubber = vec![0.0; coordinates.count];
    let mut point =
        |node: usize, mass_kg: f64| add_point(&mut rubber, coordinates, scene, node, mass_kg);
    let density = scene.material.density_kg_m3;
    for (e, element) in mesh.elements.iter().enumerate() {
        let volume_m3 = mesh.element_length_m(e) * element.thickness_m * mesh.width_m;
        let share = if element.magnet.is_some() { 1.0 / 6.0 } else { 0.5 };
        let solid_m3 = volume_m3 - element.magnet.map_or(0.0, |_| magnet_volume_m3(scene));
        point(e, share * density * solid_m3);
        point(e + 1, share * density * solid_m3);
    }
    let mut parts: Vec<MassPart> = rubber
        .iter()
        .enumerate()
        .filter(|(_, mass)| **mass > 0.0)
        .map(|(dof, &rubber)| MassPart { dof, rubber, body: None, magnet: 0.0, fill: 0.0 })
        .collect();
    if let Some(magnet) = &scene.magnet {
        for (body, placed) in mesh.magnets.iter().enumerate() {
            let thickness_m = mesh.elements[placed.element].thickness_m;
            let box_m3 = magnet.length_m * thickness_m * mesh.width_m;
            let around_kg = density * (box_m3 - magnet_volume_m3(scene));
            parts.extend(body_parts(
                coordinates.bodies[body],
                body,
                magnet,
                density,
                around_kg,
                thickness_m,
            ));
        }
    }
    parts
}

fn add_point(
    rubber: &mut [f64],
    coordinates: &Coordinates,
    scene: &Scene,
    node: usize,
    mass_kg: f64,
) {
    match coordinates.anchors[node] {
        Anchor::Free { dof } => {
            rubber[dof] += mass_kg;
            rubber[dof + 1] += mass_kg;
        }
        Anchor::Rigid { body, .. } => {
            let arm_m = scene.magnet.as_ref().map_or(0.0, |m| 0.5 * m.length_m);
            let dof = coordinates.bodies[body];
            rubber[dof] += mass_kg;
            rubber[dof + 1] += mass_kg;
            rubber[dof + 2] += mass_kg * arm_m * arm_m;
        }
        Anchor::Fixed => {}
    }
}

/// The magnet, and the part of the rubber around it that sits at its centre.
fn body_parts(
    dof: usize,
    body: usize,
    magnet: &Magnet,
    density: f64,
    around_kg: f64,
    thickness_m: f64,
) -> [MassPart; 3] {
    let volume_m3 = magnet.length_m * magnet.width_m * magnet.height_m;
    let magnet_kg = magnet.density_kg_m3 * volume_m3;
    let fill_kg = density * volume_m3;
    let gyration_m2 = (magnet.length_m.powi(2) + magnet.height_m.powi(2)) / 12.0;
    let centre_kg = around_kg * 2.0 / 3.0;
    let body = Some(body);
    let translation =
        |dof| MassPart { dof, rubber: centre_kg, body, magnet: magnet_kg, fill: fill_kg };
    [
        translation(dof),
        translation(dof + 1),
        MassPart {
            dof: dof + 2,
            rubber: around_kg * thickness_m.powi(2) / 12.0,
            body,
            magnet: magnet_kg * gyration_m2,
            fill: fill_kg * gyration_m2,
        },
    ]
}

fn magnet_volume_m3(scene: &Scene) -> f64 {
    scene.magnet.as_ref().map_or(0.0, |m| m.length_m * m.width_m * m.height_m)
}
