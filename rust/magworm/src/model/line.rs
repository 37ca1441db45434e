//! Unknowns in a line, joined by springs between neighbours: the fastest of their oscillations.
//!
//! A rate ω² exceeds that of every oscillation where ω²M − K is positive definite, which its factorisation L D Lᵀ tells;
//! bisection brings it down to the fastest one, whose shape inverse iteration then gives.

/// Relative width of the bracket at which bisection ends; the bound is its upper end.
const CLOSE: f64 = 1e-6;
/// Rounds of inverse iteration: each enlarges the fastest oscillation against the next by far.
const ROUNDS: usize = 5;
/// Neighbours to either side that an unknown is coupled to.
const REACH: usize = 2;

/// A spring ½ k (w·u)² over an unknown and the two after it.
pub struct Spring {
    /// The first of the unknowns.
    pub first: usize,
    /// w.
    pub weights: [f64; 3],
    /// k.
    pub stiffness: f64,
    /// What the caller knows it by.
    pub place: usize,
}

/// Unknowns in a line with springs between neighbours.
pub struct Line {
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
    pub fn new(mut mass: Vec<f64>, mut springs: Vec<Spring>) -> Self {
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
    pub fn couple(&mut self, first: usize, own: f64, shared: f64) {
        self.mass[first] += own;
        self.mass[first + 1] += own;
        self.beside[first] = shared;
    }

    /// Greatest eigenvalue of M⁻¹K, bounded from above, and the place of the spring that holds most energy in it.
    pub fn greatest(&self) -> (f64, usize) {
        let stiffness = self.shifted(0.0);
        let ratios = self.mass.iter().zip(&stiffness).map(|(mass, row)| -row[0] / mass);
        let mut low = ratios.fold(0.0, f64::max);
        if low == 0.0 {
            return (0.0, 0);
        }
        let mut high = 2.0 * low;
        while high.is_finite() && factors(self.shifted(high)).is_none() {
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
