//! Masses: rubber lumped on the nodes, magnets as rigid bodies.
//!
//! Half of a soft element's rubber goes to each of its nodes. The rubber around a magnet goes ⅙, ⅔, ⅙
//! to its head end, centre and tail end (Simpson), which keeps mass and moment of inertia m l²/12. In space a
//! magnet has a moment of inertia about its tangent, up and side, and a soft element about its tangent.

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
    let rubber = rubber(scene, mesh, coordinates);
    let mut parts: Vec<MassPart> = rubber
        .iter()
        .enumerate()
        .filter(|(_, mass)| **mass > 0.0)
        .map(|(dof, &rubber)| MassPart { dof, rubber, body: None, magnet: 0.0, fill: 0.0 })
        .collect();
    if let Some(magnet) = &scene.magnet {
        for (body, placed) in mesh.magnets.iter().enumerate() {
            let thickness_m = mesh.elements[placed.element].thickness_m;
            let section_m = [thickness_m, mesh.width_m];
            parts.extend(body_parts(scene, coordinates, body, magnet, section_m));
        }
    }
    parts
}

/// Rubber on nodes and of elements that twist, for each unknown.
fn rubber(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<f64> {
    let mut rubber = vec![0.0; coordinates.count];
    let density = scene.material.density_kg_m3;
    for (e, element) in mesh.elements.iter().enumerate() {
        let volume_m3 = mesh.element_length_m(e) * element.thickness_m * mesh.width_m;
        let share = if element.magnet.is_some() { 1.0 / 6.0 } else { 0.5 };
        let solid_m3 = volume_m3 - element.magnet.map_or(0.0, |_| magnet_volume_m3(scene));
        add_point(&mut rubber, coordinates, scene, e, share * density * solid_m3);
        add_point(&mut rubber, coordinates, scene, e + 1, share * density * solid_m3);
        if let Some(dof) = coordinates.twists[e] {
            let gyration_m2 = gyration_m2(element.thickness_m, mesh.width_m);
            rubber[dof] += density * volume_m3 * gyration_m2;
        }
    }
    rubber
}

fn add_point(
    rubber: &mut [f64],
    coordinates: &Coordinates,
    scene: &Scene,
    node: usize,
    mass_kg: f64,
) {
    let dimensions = coordinates.dimensions;
    match coordinates.anchors[node] {
        Anchor::Free { dof } => {
            rubber[dof..dof + dimensions].iter_mut().for_each(|m| *m += mass_kg)
        }
        Anchor::Rigid { body, .. } => {
            let arm_m = scene.magnet.as_ref().map_or(0.0, |m| 0.5 * m.length_m);
            let dof = coordinates.bodies[body];
            rubber[dof..dof + dimensions].iter_mut().for_each(|m| *m += mass_kg);
            // About all axes but the tangent, on which it lies; in the plane there is one.
            let rotations = if dimensions == 2 { dof + 2..dof + 3 } else { dof + 4..dof + 6 };
            rubber[rotations].iter_mut().for_each(|m| *m += mass_kg * arm_m * arm_m);
        }
        Anchor::Fixed => {}
    }
}

/// The magnet, and the part of the rubber around it that sits at its centre.
fn body_parts(
    scene: &Scene,
    coordinates: &Coordinates,
    body: usize,
    magnet: &Magnet,
    [thickness_m, width_m]: [f64; 2],
) -> Vec<MassPart> {
    let (dof, density) = (coordinates.bodies[body], scene.material.density_kg_m3);
    let volume_m3 = magnet_volume_m3(scene);
    let around_kg = density * (magnet.length_m * thickness_m * width_m - volume_m3);
    let (magnet_kg, fill_kg) = (magnet.density_kg_m3 * volume_m3, density * volume_m3);
    let part = |dof, rubber, gyration_m2| MassPart {
        dof,
        rubber,
        body: Some(body),
        magnet: magnet_kg * gyration_m2,
        fill: fill_kg * gyration_m2,
    };
    // About an axis: the rubber's length is in its points.
    let about_side = (gyration_m2(thickness_m, 0.0), gyration_m2(magnet.length_m, magnet.height_m));
    let rotations = if coordinates.dimensions == 2 {
        vec![about_side]
    } else {
        vec![
            (gyration_m2(thickness_m, width_m), gyration_m2(magnet.height_m, magnet.width_m)),
            (gyration_m2(width_m, 0.0), gyration_m2(magnet.length_m, magnet.width_m)),
            about_side,
        ]
    };
    let first = dof + coordinates.dimensions;
    let translations = (dof..first).map(|dof| part(dof, around_kg * 2.0 / 3.0, 1.0));
    let rotations = rotations
        .into_iter()
        .enumerate()
        .map(|(k, (rubber, magnet))| part(first + k, around_kg * rubber, magnet));
    translations.chain(rotations).collect()
}

/// Square of the radius of gyration of a rectangle with these edges.
fn gyration_m2(a_m: f64, b_m: f64) -> f64 {
    (a_m * a_m + b_m * b_m) / 12.0
}

fn magnet_volume_m3(scene: &Scene) -> f64 {
    scene.magnet.as_ref().map_or(0.0, |m| m.length_m * m.width_m * m.height_m)
}
