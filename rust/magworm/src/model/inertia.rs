//! Masses: rubber lumped on the nodes, magnets as rigid bodies.
//!
//! Half of a soft element's rubber goes to each of its nodes. The rubber around a magnet goes ⅙, ⅔, ⅙
//! to its head end, centre and tail end (Simpson), which keeps mass and moment of inertia m l²/12. In space a
//! magnet has a moment of inertia about its tangent, up and side, and a soft element about its tangent.
//!
//! A magnet whose centre lies r beside the middle of its element brings a first moment m r and products of inertia
//! −m r_k r_l about it. The cavity that it leaves in the rubber takes as much of the rubber away, so that an empty one filled
//! with rubber brings none.

use super::coordinates::{Anchor, Coordinates};
use super::{Element, Mesh, MeshMagnet};
use crate::scene::Scene;
use std::ops::Range;

/// A contribution to the diagonal mass of one unknown, or to a moment of a body off its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassPart {
    /// The unknown, or the row of the moment.
    pub row: usize,
    /// Always there [kg or kg·m²; kg·m of a first moment].
    pub rubber: f64,
    /// The magnet whose presence adds `magnet` and whose absence adds `fill`.
    pub body: Option<usize>,
    /// Of the magnet.
    pub magnet: f64,
    /// Of the rubber in an empty cavity.
    pub fill: f64,
}

/// A rigid body whose centre of mass may lie beside the middle of its element.
#[derive(Clone, Debug, PartialEq)]
pub struct OffCentre {
    /// The body.
    pub body: usize,
    /// Its first unknown.
    pub dof: usize,
    /// The first of its rows beside the masses of unknowns: the first moment of mass along the body and up [kg·m]; in space
    /// also to its side, then the products of inertia of up and side, side and tangent, tangent and up [kg·m²].
    pub row: usize,
    /// Contributions to these rows, in place of unknowns.
    pub parts: Vec<MassPart>,
}

/// The bodies whose magnets lie beside the middle of their elements.
pub fn off_centre(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<OffCentre> {
    let rows = coordinates.sizes().moments();
    let density_kg_m3 = scene.material.density_kg_m3;
    let bodies = (0..mesh.magnets.len()).filter(|body| mesh.magnets[*body].offset_m.is_some());
    bodies
        .enumerate()
        .map(|(place, body)| OffCentre {
            body,
            dof: coordinates.bodies[body],
            row: rows * place,
            parts: moments(
                density_kg_m3,
                &mesh.magnets[body],
                body,
                rows * place..rows * (place + 1),
            ),
        })
        .collect()
}

/// First moments and products of inertia of a magnet and its cavity.
fn moments(
    density_kg_m3: f64,
    magnet: &MeshMagnet,
    body: usize,
    rows: Range<usize>,
) -> Vec<MassPart> {
    let [x, y, z] = magnet.offset_m.unwrap_or_default();
    let (magnet_kg, cavity_kg) = (magnet.mass_kg(), density_kg_m3 * magnet.volume_m3());
    // In the plane the first two are all.
    let arms = [x, y, z, -y * z, -z * x, -x * y];
    let part = |(row, arm)| MassPart {
        row,
        rubber: -cavity_kg * arm,
        body: Some(body),
        magnet: magnet_kg * arm,
        fill: cavity_kg * arm,
    };
    rows.zip(arms).map(part).collect()
}

/// Contributions to the mass of every unknown that has one.
pub fn mass_parts(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<MassPart> {
    let density_kg_m3 = scene.material.density_kg_m3;
    let rubber = rubber(density_kg_m3, mesh, coordinates);
    let mut parts: Vec<MassPart> = rubber
        .iter()
        .enumerate()
        .filter(|(_, mass)| **mass > 0.0)
        .map(|(dof, &rubber)| MassPart { row: dof, rubber, body: None, magnet: 0.0, fill: 0.0 })
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
    let (sizes, dimensions) = (coordinates.sizes(), coordinates.dimensions);
    match coordinates.anchors[node] {
        Anchor::Free { dof } => {
            rubber[dof..dof + dimensions].iter_mut().for_each(|m| *m += mass_kg)
        }
        Anchor::Rigid { body, .. } => {
            let arm_m = mesh.magnets[body].half_length_m;
            let dof = coordinates.bodies[body];
            rubber[dof..dof + dimensions].iter_mut().for_each(|m| *m += mass_kg);
            // About all axes but the tangent, on which it lies: the last ones.
            let end = dof + sizes.body();
            rubber[end - sizes.tangents()..end]
                .iter_mut()
                .for_each(|m| *m += mass_kg * arm_m * arm_m);
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
    let part = |row, rubber, gyration_m2| MassPart {
        row,
        rubber,
        body: Some(body),
        magnet: magnet_kg * gyration_m2,
        fill: fill_kg * gyration_m2,
    };
    // About tangent, up and side, in the plane about the last alone. The rubber's length is in its points. Squares of the radii of
    // gyration, and of the distance of the magnet.
    let [x, y, z] = magnet.offset_m.unwrap_or_default();
    let about = [
        (gyration_m2(thickness_m, width_m), gyration_m2(height_m, depth_m), y * y + z * z),
        (gyration_m2(width_m, 0.0), gyration_m2(length_m, depth_m), z * z + x * x),
        (gyration_m2(thickness_m, 0.0), gyration_m2(length_m, height_m), x * x + y * y),
    ];
    let first = dof + coordinates.dimensions;
    let translations = (dof..first).map(|dof| part(dof, around_kg * 2.0 / 3.0, 1.0));
    let rotations = about.into_iter().skip(3 - coordinates.sizes().rotations);
    let rotations = rotations.enumerate().map(|(k, (rubber, magnet, beside))| {
        part(first + k, around_kg * rubber - fill_kg * beside, magnet + beside)
    });
    translations.chain(rotations).collect()
}

/// Square of the radius of gyration of a rectangle with these edges.
fn gyration_m2(a_m: f64, b_m: f64) -> f64 {
    (a_m * a_m + b_m * b_m) / 12.0
}
