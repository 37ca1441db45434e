//! The fastest small oscillations of the straight rod at rest, wave by wave.
//!
//! In a straight rod stretching, bending about either axis and twisting do not meet, and each is a line of unknowns u joined
//! by springs ½ k (w·u)² of at most three neighbours: M ü = −K u with K = Σ k w wᵀ. Both ends of a rigid magnet move
//! together along the rod and about it; across it their places u_h and u_t stand for its place and its turn, so with
//! its half length a, its mass m and its moment of inertia I the masses of both are coupled:
//!
//! ½ m ((u_h + u_t)/2)² + ½ I ((u_t − u_h)/2a)² + ½ m_h u_h² + ½ m_t u_t².
//!
//! The greatest eigenvalue ω² of A = M⁻¹K is at most that of |A|, which for any positive x is at most max (|A| x)_i / x_i
//! (Collatz and Wielandt); power iteration brings this bound down. Signs of a rod's K alternate, |A| has then the
//! same eigenvalues, and the bound becomes the eigenvalue itself.

use super::coordinates::{Anchor, Coordinates, Unknowns};
use super::{Bend, Model, inertia};
use crate::scene::Parameter;

/// Most rounds of power iteration.
const ROUNDS: usize = 300;
/// Relative distance of the bounds on the eigenvalue at which it ends.
const CLOSE: f64 = 1e-4;
/// Least entry of its vector, which has to stay positive, over the greatest one.
const FLOOR: f64 = 1e-200;
/// Neighbours to either side that one unknown acts on: a spring reaches two, a magnet one more.
const REACH: usize = 3;

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
    let spatial = model.dimensions() == 3;
    let across: &[(Wave, usize)] = if spatial {
        &[(Wave::Bending, 1), (Wave::BendingAcross, 2)]
    } else {
        &[(Wave::Bending, 1)]
    };
    let mut lines = vec![(Wave::Stretching, stretching(model, &masses))];
    lines.extend(across.iter().map(|&(wave, axis)| (wave, bending(model, &masses, axis))));
    if spatial {
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
        for part in inertia::mass_parts(&model.scene, &model.mesh, &coordinates) {
            let present = part.body.is_none_or(|body| model.mesh.magnets[body].present);
            of[part.dof] += part.rubber + if present { part.magnet } else { part.fill };
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
        let rotation = if self.coordinates.dimensions == 2 { 2 } else { 3 + axis };
        self.of[self.coordinates.bodies[body] + rotation]
    }
}

/// Along the rod: both nodes of a magnet are one unknown.
fn stretching(model: &Model, masses: &Masses) -> Line {
    let mut unknown = vec![0];
    let mut mass = vec![masses.node(0)];
    for (element, one) in model.mesh.elements.iter().enumerate() {
        match one.magnet {
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
    Line::new(&mass, springs.collect())
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
    let mut line = Line::new(&mass, springs.collect());
    for (body, magnet) in model.mesh.magnets.iter().enumerate() {
        let (m, turn) = (masses.magnet(body), masses.turn(body, 3 - axis));
        let turn = turn / model.half_magnet_m.powi(2);
        line.couple(magnet.element, &mass, 0.25 * (m + turn), 0.25 * (m - turn));
    }
    line
}

/// About the rod: the turns of all elements.
fn twisting(model: &Model, masses: &Masses) -> Line {
    let mass: Vec<f64> = (0..model.mesh.elements.len())
        .map(|element| {
            match (masses.coordinates.twists[element], model.mesh.elements[element].magnet) {
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
    Line::new(&mass, springs.collect())
}

/// A spring ½ k (w·u)² over an unknown and the two after it.
struct Spring {
    first: usize,
    weights: [f64; 3],
    stiffness: f64,
    place: usize,
}

/// Unknowns in a line with springs between neighbours.
struct Line {
    /// Diagonal of M⁻¹.
    inverse: Vec<f64>,
    /// Entry of M⁻¹ between an unknown and the next.
    beside: Vec<f64>,
    springs: Vec<Spring>,
}

impl Line {
    fn new(mass: &[f64], mut springs: Vec<Spring>) -> Self {
        for spring in &mut springs {
            for k in 0..3 {
                let held = mass.get(spring.first + k).is_none_or(|mass| mass.is_infinite());
                spring.weights[k] *= if held { 0.0 } else { 1.0 };
            }
        }
        let inverse = mass.iter().map(|mass| 1.0 / mass).collect();
        Self { inverse, beside: vec![0.0; mass.len()], springs }
    }

    /// Couples the masses of an unknown and the next: `own` is added to each, `shared` stands between them.
    fn couple(&mut self, first: usize, mass: &[f64], own: f64, shared: f64) {
        let (head, tail) = (mass[first] + own, mass[first + 1] + own);
        let determinant = head * tail - shared * shared;
        self.inverse[first] = tail / determinant;
        self.inverse[first + 1] = head / determinant;
        self.beside[first] = -shared / determinant;
    }

    /// Greatest eigenvalue of M⁻¹K, bounded from above, and the place of the spring that holds most energy in it.
    fn greatest(&self) -> (f64, usize) {
        let matrix = self.magnitudes();
        let mut x = vec![1.0; matrix.len()];
        let mut bound = f64::INFINITY;
        for _ in 0..ROUNDS {
            let y = times(&matrix, &x);
            let ratios = || x.iter().zip(&y).map(|(x, y)| y / x);
            bound = bound.min(ratios().fold(0.0, f64::max));
            if ratios().fold(f64::INFINITY, f64::min) > bound * (1.0 - CLOSE) {
                break;
            }
            let most = y.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            x = y.iter().map(|y| (y / most).max(FLOOR)).collect();
        }
        let energy = |spring: &Spring| {
            let strain: f64 =
                (0..3).map(|k| spring.weights[k].abs() * at(&x, spring.first + k)).sum();
            spring.stiffness * strain * strain
        };
        let most = self.springs.iter().max_by(|a, b| energy(a).total_cmp(&energy(b)));
        (bound, most.map_or(0, |spring| spring.place))
    }

    /// |M⁻¹K|, of each row the entries from `REACH` before the diagonal to `REACH` after it.
    fn magnitudes(&self) -> Vec<[f64; 2 * REACH + 1]> {
        let mut stiffness = vec![[0.0; 2 * REACH + 1]; self.inverse.len()];
        for spring in &self.springs {
            for (row, a) in spring.weights.iter().enumerate().filter(|(_, w)| **w != 0.0) {
                for (column, b) in spring.weights.iter().enumerate() {
                    stiffness[spring.first + row][REACH + column - row] += spring.stiffness * a * b;
                }
            }
        }
        let mut matrix = stiffness.clone();
        for (row, entries) in matrix.iter_mut().enumerate() {
            for (k, entry) in entries.iter_mut().enumerate() {
                let of = |row: usize, k: Option<usize>| {
                    k.and_then(|k| stiffness.get(row)?.get(k)).copied().unwrap_or(0.0)
                };
                let own = self.inverse[row] * of(row, Some(k));
                let after = self.beside[row] * of(row + 1, k.checked_sub(1));
                let before = match row.checked_sub(1) {
                    Some(before) => self.beside[before] * of(before, Some(k + 1)),
                    None => 0.0,
                };
                *entry = (own + after + before).abs();
            }
        }
        matrix
    }
}

fn at(x: &[f64], place: usize) -> f64 {
    x.get(place).copied().unwrap_or(0.0)
}

fn times(matrix: &[[f64; 2 * REACH + 1]], x: &[f64]) -> Vec<f64> {
    let row = |(i, entries): (usize, &[f64; 2 * REACH + 1])| {
        let neighbours = entries.iter().enumerate();
        neighbours
            .map(|(k, entry)| entry * (i + k).checked_sub(REACH).map_or(0.0, |j| at(x, j)))
            .sum()
    };
    matrix.iter().enumerate().map(row).collect()
}
