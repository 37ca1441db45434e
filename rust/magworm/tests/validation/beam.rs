//! Reference solutions of beams, computed here without the simulator.

/// Loads of an inextensible clamped beam of length 1 and bending stiffness 1.
#[derive(Clone, Copy)]
pub struct Loads {
    /// Weight per length.
    pub weight: f64,
    /// Weight at the tip.
    pub tip: f64,
    /// Distance beyond the tip, along its tangent, at which the tip's weight acts.
    pub overhang: f64,
}

/// Tip (x, drop) of the beam: EI θ″ = −V cos θ with θ the angle below the horizontal and
/// V = P + w (1 − s); θ(0) = 0, EI θ′(1) = P o cos θ(1). Runge–Kutta 4 with 4000 steps, shooting by bisection.
pub fn elastica(loads: Loads) -> [f64; 2] {
    let shape = elastica_shape(loads);
    shape[shape.len() - 1]
}

/// The whole beam, (x, drop) at 101 points.
pub fn elastica_shape(loads: Loads) -> Vec<[f64; 2]> {
    let miss = |slope: f64| {
        let [theta, bend, ..] = shoot(slope, loads, |_| {});
        bend - loads.tip * loads.overhang * theta.cos()
    };
    let (mut low, mut high) = (0.0, 60.0);
    // From above, θ would wind up: the smallest root is the hanging beam.
    let mut probe = 0.0;
    while miss(probe) < 0.0 {
        low = probe;
        probe += 0.05;
        high = probe;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if miss(middle) < 0.0 { low = middle } else { high = middle }
    }
    let mut shape = vec![[0.0; 2]];
    shoot(0.5 * (low + high), loads, |[_, _, x, drop]| shape.push([x, drop]));
    shape
}

/// (θ, θ′, x, drop) at the tip, and every fortieth step to `seen`.
fn shoot(slope: f64, loads: Loads, seen: impl FnMut([f64; 4])) -> [f64; 4] {
    let rate = |s: f64, y: [f64; 4]| {
        let shear = loads.tip + loads.weight * (1.0 - s);
        [y[1], -shear * y[0].cos(), y[0].cos(), y[0].sin()]
    };
    runge_kutta([0.0, slope, 0.0, 0.0], rate, seen)
}

/// Runge–Kutta 4 from 0 to 1 with 4000 steps; every fortieth goes to `seen`.
pub fn runge_kutta<const N: usize>(
    start: [f64; N],
    rate: impl Fn(f64, [f64; N]) -> [f64; N],
    mut seen: impl FnMut([f64; N]),
) -> [f64; N] {
    let steps = 4000;
    let h = 1.0 / f64::from(steps);
    let plus =
        |y: [f64; N], k: [f64; N], c: f64| -> [f64; N] { std::array::from_fn(|i| y[i] + c * k[i]) };
    let mut y = start;
    for n in 0..steps {
        let s = f64::from(n) * h;
        let a = rate(s, y);
        let b = rate(s + 0.5 * h, plus(y, a, 0.5 * h));
        let c = rate(s + 0.5 * h, plus(y, b, 0.5 * h));
        let d = rate(s + h, plus(y, c, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        if (n + 1) % 40 == 0 {
            seen(y);
        }
    }
    y
}

/// Factor on the loads at which a straight column, clamped below, buckles: the smallest λ for which
/// θ″ + λ (P + w (1 − s)) θ = 0, θ(0) = 0, θ′(1) = λ P o θ(1) has a solution besides 0. Euler's column
/// (P = 1 alone) gives π²/4, Greenhill's (w = 1 alone) 7.8373.
pub fn buckling_factor(loads: Loads) -> f64 {
    let miss = |factor: f64| {
        let rate =
            |s: f64, y: [f64; 2]| [y[1], -factor * (loads.tip + loads.weight * (1.0 - s)) * y[0]];
        let [theta, bend] = runge_kutta([0.0, 1.0], rate, |_| {});
        bend - factor * loads.tip * loads.overhang * theta
    };
    let (mut low, mut high) = (0.0, 0.1);
    while miss(high) > 0.0 {
        (low, high) = (high, high + 0.1);
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if miss(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Deflection of the n-th mode of a clamped–free beam at s in [0, 1], βL given.
pub fn mode_shape(beta: f64, s: f64) -> f64 {
    let ratio = (beta.cosh() + beta.cos()) / (beta.sinh() + beta.sin());
    let z = beta * s;
    z.cosh() - z.cos() - ratio * (z.sinh() - z.sin())
}
