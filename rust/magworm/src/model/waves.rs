//! The fastest small oscillations of the straight rod at rest, wave by wave.
//!
//! In a straight rod stretching, bending about either axis and twisting do not meet, and each is a line of unknowns u joined
//! by springs ½ k (w·u)² of at most three neighbours: M ü = −K u with K = Σ k w wᵀ. Both ends of a rigid magnet move
//! together along the rod and about it; across it their places u_h and u_t stand for its place and its turn, so with
//! its half length a, its mass m and its moment of inertia I the masses of both are coupled:
//!
//! ½ m ((u_h + u_t)/2)² + ½ I ((u_t − u_h)/2a)² + ½ m_h u_h² + ½ m_t u_t².
//!
//! A rate ω² exceeds that of every oscillation where ω²M − K is positive definite, which its factorisation L D Lᵀ tells;
//! bisection brings it down to the fastest one, whose shape inverse iteration then gives.

use super::coordinates::{Anchor, Coordinates, Unknowns};
use super::{Bend, Model, inertia};
use crate::scene::Parameter;

/// Relative width of the bracket at which bisection ends; the bound is its upper end.
const CLOSE: f64 = 1e-6;
/// Rounds of inverse iteration: each enlarges the fastest oscillation against the next by far.
const ROUNDS: usize = 5;
/// Neighbours to either side that an unknown is coupled to.
const REACH: usize = 2;

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
    for (body, magnet) in model.mesh.magnets.iter().enumerate() {
        let (m, turn) = (masses.magnet(body), masses.turn(body, 3 - axis));
        let turn = turn / model.half_magnet_m.powi(2);
        line.couple(magnet.element, 0.25 * (m + turn), 0.25 * (m - turn));
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
    Line::new(mass, springs.collect())
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
    /// Diagonal of M.
    mass: Vec<f64>,
    /// Entry of M between an unknown and the next.
    beside: Vec<f64>,
    springs: Vec<Spring>,
}

/// A symmetric matrix, of each row the diagonal and the entries before it; or its factors, D in place of the diagonal.
type Band = Vec<[f64; REACH + 1]>;

impl Line {
    /// What has infinite mass does not move.
    fn new(mut mass: Vec<f64>, mut springs: Vec<Spring>) -> Self {
        for spring in &mut springs {
            for k in 0..3 {
                let held = mass.get(spring.first + k).is_none_or(|mass| mass.is_infinite());
                spring.weights[k] *= if held { 0.0 } else { 1.0 };
            }
        }
        mass.iter_mut().filter(|mass| mass.is_infinite()).for_each(|mass| *mass = 1.0);
        Self { beside: vec![0.0; mass.len()], mass, springs }
    }

    /// Couples the masses of an unknown and the next: `own` is added to each, `shared` stands between them.
    fn couple(&mut self, first: usize, own: f64, shared: f64) {
        self.mass[first] += own;
        self.mass[first + 1] += own;
        self.beside[first] = shared;
    }

    /// Greatest eigenvalue of M⁻¹K, bounded from above, and the place of the spring that holds most energy in it.
    fn greatest(&self) -> (f64, usize) {
        let stiffness = self.shifted(0.0);
        let ratios = self.mass.iter().zip(&stiffness).map(|(mass, row)| -row[0] / mass);
        let mut low = ratios.fold(0.0, f64::max);
        if low == 0.0 {
            return (0.0, 0);
        }
        let mut high = 2.0 * low;
        while factors(self.shifted(high)).is_none() {
            (low, high) = (high, 2.0 * high);
        }
        while high - low > CLOSE * high {
            let middle = 0.5 * (low + high);
            if factors(self.shifted(middle)).is_some() { high = middle } else { low = middle }
        }
        (high, self.place(&self.shape(high)))
    }

    /// Shape of the oscillation whose rate lies just below the given one.
    fn shape(&self, rate_s2: f64) -> Vec<f64> {
        let alternating = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut x: Vec<f64> = (0..self.mass.len()).map(alternating).collect();
        let Some(factors) = factors(self.shifted(rate_s2)) else { return x };
        for _ in 0..ROUNDS {
            solve(&factors, &mut x);
            let most = x.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max);
            let coupled = |k: usize, x: &[f64]| {
                let before = k.checked_sub(1).map_or(0.0, |j| self.beside[j] * x[j]);
                let after = x.get(k + 1).map_or(0.0, |next| self.beside[k] * next);
                (self.mass[k] * x[k] + before + after) / most
            };
            x = (0..x.len()).map(|k| coupled(k, &x)).collect();
        }
        solve(&factors, &mut x);
        x
    }

    /// Place of the spring that holds most energy in a shape.
    fn place(&self, x: &[f64]) -> usize {
        let energy = |spring: &Spring| {
            let weights = spring.weights.iter().zip(&x[spring.first..]);
            let strain: f64 = weights.map(|(weight, x)| weight * x).sum();
            spring.stiffness * strain * strain
        };
        let most = self.springs.iter().max_by(|a, b| energy(a).total_cmp(&energy(b)));
        most.map_or(0, |spring| spring.place)
    }

    /// ω²M − K.
    fn shifted(&self, rate_s2: f64) -> Band {
        let mut rows: Band = self.mass.iter().map(|mass| [rate_s2 * mass, 0.0, 0.0]).collect();
        for (row, shared) in rows.iter_mut().skip(1).zip(&self.beside) {
            row[1] = rate_s2 * shared;
        }
        for spring in &self.springs {
            for (k, a) in spring.weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                for (j, b) in spring.weights.iter().enumerate().take(k + 1) {
                    rows[spring.first + k][k - j] -= spring.stiffness * a * b;
                }
            }
        }
        rows
    }
}

/// L and D of a matrix; none where it is not positive definite.
fn factors(mut rows: Band) -> Option<Band> {
    for k in 0..rows.len() {
        for back in (1..=REACH.min(k)).rev() {
            let j = k - back;
            for between in 1..=(REACH - back).min(j) {
                let part = rows[k][back + between] * rows[j][between] * rows[j - between][0];
                rows[k][back] -= part;
            }
            rows[k][back] /= rows[j][0];
            let part = rows[k][back] * rows[k][back] * rows[j][0];
            rows[k][0] -= part;
        }
        if rows[k][0].is_nan() || rows[k][0] <= 0.0 {
            return None;
        }
    }
    Some(rows)
}

/// Solves L D Lᵀ x = b, b in place of x.
fn solve(factors: &Band, x: &mut [f64]) {
    for k in 0..x.len() {
        for back in 1..=REACH.min(k) {
            x[k] -= factors[k][back] * x[k - back];
        }
    }
    x.iter_mut().zip(factors).for_each(|(x, row)| *x /= row[0]);
    for k in (0..x.len()).rev() {
        for back in 1..=REACH.min(k) {
            x[k - back] -= factors[k][back] * x[k];
        }
    }
}
