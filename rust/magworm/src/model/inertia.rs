//! Masses: rubber lumped on the nodes, rigid bodies with their magnets.
//!
//! Half of a soft element's rubber goes to each of its nodes. The rubber of a rigid body goes ⅙, ⅔, ⅙
//! to its head end, middle and tail end (Simpson), which keeps mass and moment of inertia m l²/12. In space a
//! body has a moment of inertia about its tangent, up and side, and a soft element about its tangent.
//!
//! A magnet whose centre lies r beside the middle of its element brings a first moment m r and products of inertia
//! −m r_k r_l about it. The cavity that it leaves in the rubber takes as much of the rubber away, so that an empty one filled
//! with rubber brings none.

use super::coordinates::{Anchor, Coordinates};
use super::{Element, Mesh};
use crate::scene::{RigidElement, Scene, SegmentMagnet};

/// A contribution to the diagonal mass of one unknown, or to a moment of a body off its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassPart {
    /// The unknown, or the row of the moment.
    pub row: usize,
    /// Always there [kg or kg·m²; kg·m of a first moment].
    pub rubber: f64,
    /// The body magnet whose presence adds `magnet` and whose absence adds `fill`.
    pub cavity: Option<usize>,
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

/// The first and mixed moments of a body whose magnets lie beside the middle of its element; `row`: the first of their rows.
pub fn off_centre(
    scene: &Scene,
    mesh: &Mesh,
    coordinates: &Coordinates,
    body: usize,
    row: usize,
) -> Option<OffCentre> {
    let beside = |k: &usize| mesh.magnets[*k].magnet.offset_m() != [0.0; 3];
    let magnets = mesh.magnets_of(body).filter(beside);
    let density_kg_m3 = scene.material.density_kg_m3;
    let rows = coordinates.sizes().moments();
    let parts: Vec<MassPart> =
        magnets.flat_map(|k| moments(density_kg_m3, mesh, k, row).take(rows)).collect();
    let dof = coordinates.bodies[body];
    (!parts.is_empty()).then_some(OffCentre { body, dof, row, parts })
}

/// First moments and products of inertia of a magnet and its cavity; in the plane the first two are all.
fn moments(
    density_kg_m3: f64,
    mesh: &Mesh,
    cavity: usize,
    row: usize,
) -> impl Iterator<Item = MassPart> + use<> {
    let magnet = &mesh.magnets[cavity].magnet;
    let [x, y, z] = magnet.offset_m();
    let (magnet_kg, cavity_kg) = (magnet.mass_kg(), density_kg_m3 * magnet.volume_m3());
    let arms = [x, y, z, -y * z, -z * x, -x * y];
    arms.into_iter().enumerate().map(move |(k, arm)| MassPart {
        row: row + k,
        rubber: -cavity_kg * arm,
        cavity: Some(cavity),
        magnet: magnet_kg * arm,
        fill: cavity_kg * arm,
    })
}

/// Rubber on nodes and of elements that twist: contributions to the mass of each unknown that has some.
pub fn rubber_parts(scene: &Scene, mesh: &Mesh, coordinates: &Coordinates) -> Vec<MassPart> {
    let rubber = rubber(scene.material.density_kg_m3, mesh, coordinates);
    rubber
        .iter()
        .enumerate()
        .filter(|(_, mass)| **mass > 0.0)
        .map(|(dof, &rubber)| MassPart { row: dof, rubber, cavity: None, magnet: 0.0, fill: 0.0 })
        .collect()
}

/// The same for all unknowns.
fn rubber(density_kg_m3: f64, mesh: &Mesh, coordinates: &Coordinates) -> Vec<f64> {
    let mut rubber = vec![0.0; coordinates.count];
    for (e, element) in mesh.elements.iter().enumerate() {
        let volume_m3 = mesh.volume_m3(e);
        let share = if element.body.is_some() { 1.0 / 6.0 } else { 0.5 };
        let cavity_m3 = element.body.map_or(0.0, |body| cavities_m3(mesh, body));
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
            let arm_m = mesh.bodies[body].half_length_m;
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

/// The magnets of a body, and the part of the rubber around them that sits in its middle.
pub fn body_parts(
    scene: &Scene,
    mesh: &Mesh,
    coordinates: &Coordinates,
    body: usize,
) -> Vec<MassPart> {
    let density_kg_m3 = scene.material.density_kg_m3;
    let RigidElement { element, half_length_m } = mesh.bodies[body];
    let Element { thickness_m, width_m, .. } = mesh.elements[element];
    let volume_m3 = 2.0 * half_length_m * thickness_m * width_m;
    let around_kg = density_kg_m3 * (volume_m3 - cavities_m3(mesh, body));
    // The rubber's length is in its points.
    let middle_kg = around_kg * 2.0 / 3.0;
    let [tangent, up, side] = [(thickness_m, width_m), (width_m, 0.0), (thickness_m, 0.0)]
        .map(|(a_m, b_m)| around_kg * gyration_m2(a_m, b_m));
    let rubber = [middle_kg, middle_kg, middle_kg, tangent, up, side];
    let magnets = mesh.magnets_of(body);
    let mut parts: Vec<MassPart> = if magnets.is_empty() {
        let empty = |(row, _)| MassPart { row, rubber: 0.0, cavity: None, magnet: 0.0, fill: 0.0 };
        unknowns(coordinates, body).map(empty).collect()
    } else {
        magnets
            .flat_map(|k| magnet_parts(density_kg_m3, mesh, k, unknowns(coordinates, body)))
            .collect()
    };
    // It stands with the first magnet.
    for (part, (_, k)) in parts.iter_mut().zip(unknowns(coordinates, body)) {
        part.rubber += rubber[k];
    }
    parts
}

/// What a magnet and its cavity bring to each unknown of its body.
fn magnet_parts(
    density_kg_m3: f64,
    mesh: &Mesh,
    cavity: usize,
    unknowns: impl Iterator<Item = (usize, usize)>,
) -> impl Iterator<Item = MassPart> {
    let magnet = &mesh.magnets[cavity].magnet;
    let SegmentMagnet { length_m, height_m, width_m, density_kg_m3: own_kg_m3, .. } = *magnet;
    let volume_m3 = magnet.volume_m3();
    let (magnet_kg, fill_kg) = (own_kg_m3 * volume_m3, density_kg_m3 * volume_m3);
    let [x, y, z] = magnet.offset_m();
    // Squares of the radius of gyration, and of the distance of the magnet.
    let about = [
        (1.0, 0.0),
        (1.0, 0.0),
        (1.0, 0.0),
        (gyration_m2(height_m, width_m), y * y + z * z),
        (gyration_m2(length_m, width_m), z * z + x * x),
        (gyration_m2(length_m, height_m), x * x + y * y),
    ];
    unknowns.map(move |(row, k)| {
        let (gyration_m2, beside_m2) = about[k];
        MassPart {
            row,
            rubber: -fill_kg * beside_m2,
            cavity: Some(cavity),
            magnet: magnet_kg * (gyration_m2 + beside_m2),
            fill: fill_kg * (gyration_m2 + beside_m2),
        }
    })
}

/// Unknowns of a body, each with its direction: along x, y, z, about tangent, up and side; in the plane about the last alone.
fn unknowns(coordinates: &Coordinates, body: usize) -> impl Iterator<Item = (usize, usize)> {
    let first = coordinates.bodies[body];
    let directions = (0..coordinates.dimensions).chain(6 - coordinates.sizes().rotations..6);
    directions.enumerate().map(move |(k, direction)| (first + k, direction))
}

/// Volume of the magnets of a body [m³].
fn cavities_m3(mesh: &Mesh, body: usize) -> f64 {
    mesh.magnets_of(body).map(|k| mesh.magnets[k].magnet.volume_m3()).sum()
}

/// Square of the radius of gyration of a rectangle with these edges.
fn gyration_m2(a_m: f64, b_m: f64) -> f64 {
    (a_m * a_m + b_m * b_m) / 12.0
}
