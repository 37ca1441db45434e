//! Masses: rubber lumped on the nodes, magnets as rigid bodies.
//!
//! Half of a soft element's rubber goes to each of its nodes. The rubber around a magnet goes ⅙, ⅔, ⅙
//! to its head end, centre and tail end (Simpson), which keeps mass and moment of inertia m l²/12. In space a
//! magnet has a moment of inertia about its tangent, up and side, and a soft element about its tangent.

use super::coordinates::{Anchor, Coordinates};
use super::{Element, Mesh};
use crate::scene::Scene;

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
    let density_kg_m3 = scene.material.density_kg_m3;
    let rubber = rubber(density_kg_m3, mesh, coordinates);
    let mut parts: Vec<MassPart> = rubber
        .iter()
        .enumerate()
        .filter(|(_, mass)| **mass > 0.0)
        .map(|(dof, &rubber)| MassPart { dof, rubber, body: None, magnet: 0.0, fill: 0.0 })
        .collect();
    for body in 0..mesh.magnets.len() {
        parts.extend(body_parts(density_kg_m3, mesh, coordinates, body));
    }
    parts
}

/// Rubber on nodes and of elements that twist, for each unknown.
fn rubber(density_kg_m3: f64, mesh: &Mesh, coordinates: &Coordinates) -> Vec<f64> {
    let mut rubber = vec![0.0; coordinates.count];
    for (e, element) in mesh.elements.iter().enumerate() {
        let volume_m3 = mesh.volume_m3(e);
        let share = if element.magnet.is_some() { 1.0 / 6.0 } else { 0.5 };
        let cavity_m3 = element.magnet.map_or(0.0, |body| mesh.magnets[body].volume_m3());
        let mass_kg = share * density_kg_m3 * (volume_m3 - cavity_m3);
        add_point(&mut rubber, mesh, coordinates, e, mass_kg);
        add_point(&mut rubber, mesh, coordinates, e + 1, mass_kg);
        if let Some(dof) = coordinates.twists[e] {
            let gyration_m2 = gyration_m2(element.thickness_m, element.width_m);
            rubber[dof] += density_kg_m3 * volume_m3 * gyration_m2;
        }
    }
    rubber
}

fn add_point(
    rubber: &mut [f64],
    mesh: &Mesh,
    coordinates: &Coordinates,
    node: usize,
    mass_kg: f64,
) {
    let dimensions = coordinates.dimensions;
    match coordinates.anchors[node] {
        Anchor::Free { dof } => {
            rubber[dof..dof + dimensions].iter_mut().for_each(|m| *m += mass_kg)
        }
        Anchor::Rigid { body, .. } => {
            let arm_m = mesh.magnets[body].half_length_m;
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
    density_kg_m3: f64,
    mesh: &Mesh,
    coordinates: &Coordinates,
    body: usize,
) -> Vec<MassPart> {
    let (magnet, dof) = (&mesh.magnets[body], coordinates.bodies[body]);
    let Element { thickness_m, width_m, .. } = mesh.elements[magnet.element];
    let [length_m, height_m, depth_m] = magnet.size_m;
    let volume_m3 = magnet.volume_m3();
    let around_kg = density_kg_m3 * (length_m * thickness_m * width_m - volume_m3);
    let (magnet_kg, fill_kg) = (magnet.density_kg_m3 * volume_m3, density_kg_m3 * volume_m3);
    let part = |dof, rubber, gyration_m2| MassPart {
        dof,
        rubber,
        body: Some(body),
        magnet: magnet_kg * gyration_m2,
        fill: fill_kg * gyration_m2,
    };
    // About an axis: the rubber's length is in its points.
    let about_side = (gyration_m2(thickness_m, 0.0), gyration_m2(length_m, height_m));
    let rotations = if coordinates.dimensions == 2 {
        vec![about_side]
    } else {
        vec![
            (gyration_m2(thickness_m, width_m), gyration_m2(height_m, depth_m)),
            (gyration_m2(width_m, 0.0), gyration_m2(length_m, depth_m)),
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
