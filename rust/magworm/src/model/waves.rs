//! The fastest small oscillations of the straight rod at rest, wave by wave.
//!
//! In a straight rod stretching, bending about either axis and twisting do not meet, and each is a line of unknowns u joined
//! by springs ½ k (w·u)² of at most three neighbours: M ü = −K u with K = Σ k w wᵀ. Both ends of a rigid magnet move
//! together along the rod and about it; across it their places u_h and u_t stand for its place and its turn, so with
//! its half length a, its mass m and its moment of inertia I the masses of both are coupled:
//!
//! ½ m ((u_h + u_t)/2)² + ½ I ((u_t − u_h)/2a)² + ½ m_h u_h² + ½ m_t u_t².

use super::coordinates::{Anchor, Coordinates, Unknowns};
use super::line::{Line, Spring};
use super::{Bend, Model, inertia};
use crate::scene::Parameter;

/// A small motion of the straight rod.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wave {
    /// Along the rod.
    Stretching,
    /// In the plane of its thickness.
    Bending,
    /// In the plane of its width; in space only.
    BendingAcross,
    /// About the rod; in space only.
    Twisting,
}

/// The fastest oscillation of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fastest {
    /// Its kind.
    pub wave: Wave,
    /// The element that stretches most in it, or the node that bends or twists most.
    pub place: usize,
    /// Square ω² of its angular frequency [1/s²], bounded from above.
    pub rate_s2: f64,
}

/// The fastest oscillation of each kind that the model has, of undamped rubber. Stiffness and mass are the stiffest and the lightest
/// that a reset draws.
pub fn fastest(model: &Model) -> Vec<Fastest> {
    let masses = Masses::new(model);
    let mut lines = vec![(Wave::Stretching, stretching(model, &masses))];
    let bending_about = [(Wave::Bending, 1), (Wave::BendingAcross, 2)];
    for (wave, axis) in bending_about.into_iter().take(model.sizes().tangents()) {
        lines.push((wave, bending(model, &masses, axis)));
    }
    if model.sizes().twists() > 0 {
        lines.push((Wave::Twisting, twisting(model, &masses)));
    }
    let softest = draw(model, Parameter::Mass, |vary| vary.low);
    let stiffest = draw(model, Parameter::Stiffness, |vary| vary.high);
    let found = lines.into_iter().map(|(wave, line)| (wave, line.greatest()));
    found
        .map(|(wave, (rate_s2, place))| Fastest {
            wave,
            place,
            rate_s2: rate_s2 * stiffest / softest,
        })
        .collect()
}

/// A bound of the factor of a parameter, 1 where a reset leaves it alone.
pub fn draw(
    model: &Model,
    parameter: Parameter,
    bound: fn(&crate::scene::Variation) -> f64,
) -> f64 {
    let varied = model.scene.reset.vary.iter().find(|vary| vary.parameter == parameter);
    varied.map_or(1.0, bound)
}

/// Masses of all unknowns, with every node for itself.
struct Masses {
    of: Vec<f64>,
    coordinates: Coordinates,
}

impl Masses {
    fn new(model: &Model) -> Self {
        let coordinates = Coordinates::new(&model.mesh, Unknowns::Multipliers, model.dimensions());
        let mut of = vec![0.0; coordinates.count];
        let Model { scene, mesh, .. } = model;
        let bodies = (0..mesh.bodies.len())
            .flat_map(|body| inertia::body_parts(scene, mesh, &coordinates, body));
        for part in inertia::rubber_parts(scene, mesh, &coordinates).into_iter().chain(bodies) {
            let present = part.cavity.is_none_or(|cavity| mesh.magnets[cavity].magnet.present);
            of[part.row] += part.rubber + if present { part.magnet } else { part.fill };
        }
        Self { of, coordinates }
    }

    /// Of a node [kg]; infinite where it is held in place.
    fn node(&self, node: usize) -> f64 {
        match self.coordinates.anchors[node] {
            Anchor::Free { dof } => self.of[dof],
            Anchor::Rigid { .. } | Anchor::Fixed => f64::INFINITY,
        }
    }

    /// Of a magnet without its ends [kg].
    fn magnet(&self, body: usize) -> f64 {
        self.of[self.coordinates.bodies[body]]
    }

    /// Moment of inertia of a magnet without its ends about axis 0 (along the rod), 1 (up) or 2 (to its side) [kg m²].
    fn turn(&self, body: usize, axis: usize) -> f64 {
        let end = self.coordinates.bodies[body] + self.coordinates.body_size();
        self.of[end - 3 + axis]
    }
}

/// Along the rod: both nodes of a magnet are one unknown.
fn stretching(model: &Model, masses: &Masses) -> Line {
    let mut unknown = vec![0];
    let mut mass = vec![masses.node(0)];
    for (element, one) in model.mesh.elements.iter().enumerate() {
        match one.body {
            Some(body) => {
                let last = mass.len() - 1;
                mass[last] += masses.magnet(body) + masses.node(element + 1);
            }
            None => mass.push(masses.node(element + 1)),
        }
        unknown.push(mass.len() - 1);
    }
    let springs = model.stretch.iter().map(|spring| Spring {
        first: unknown[spring.element],
        weights: [-1.0, 1.0, 0.0],
        stiffness: spring.stiffness_n_m,
        place: spring.element,
    });
    Line::new(mass, springs.collect())
}

/// Across the rod, along `axis`: the places of all nodes.
fn bending(model: &Model, masses: &Masses, axis: usize) -> Line {
    let mass: Vec<f64> = (0..model.nodes()).map(|node| masses.node(node)).collect();
    let springs = model.bend.iter().map(|spring| {
        let before = 1.0 / model.mesh.element_length_m(spring.node - 1);
        let after = 1.0 / model.mesh.element_length_m(spring.node);
        Spring {
            first: spring.node - 1,
            weights: [before, -before - after, after],
            stiffness: if axis == 1 { spring.stiffness_n_m } else { spring.across_n_m },
            place: spring.node,
        }
    });
    let mut line = Line::new(mass, springs.collect());
    for (body, rigid) in model.bodies.iter().enumerate() {
        let (m, turn) = (masses.magnet(body), masses.turn(body, 3 - axis));
        let turn = turn / (rigid.half_length_m * rigid.half_length_m);
        line.couple(rigid.element, 0.25 * (m + turn), 0.25 * (m - turn));
    }
    line
}

/// About the rod: the turns of all elements.
fn twisting(model: &Model, masses: &Masses) -> Line {
    let mass: Vec<f64> = (0..model.mesh.elements.len())
        .map(|element| {
            match (masses.coordinates.twists[element], model.mesh.elements[element].body) {
                (Some(dof), _) => masses.of[dof],
                (None, Some(body)) => masses.turn(body, 0),
                (None, None) => f64::INFINITY,
            }
        })
        .collect();
    let springs = model.bend.iter().map(|spring: &Bend| Spring {
        first: spring.node - 1,
        weights: [-1.0, 1.0, 0.0],
        stiffness: spring.twist_n_m,
        place: spring.node,
    });
    Line::new(mass, springs.collect())
}
