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
    let miss = |slope: f64| {
        let [theta, bend, ..] = shoot(slope, loads);
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
    let [_, _, x, drop] = shoot(0.5 * (low + high), loads);
    [x, drop]
}

/// (θ, θ′, x, drop) at the tip.
fn shoot(slope: f64, loads: Loads) -> [f64; 4] {
    let rate = |s: f64, y: [f64; 4]| {
        let shear = loads.tip + loads.weight * (1.0 - s);
        [y[1], -shear * y[0].cos(), y[0].cos(), y[0].sin()]
    };
    let steps = 4000;
    let h = 1.0 / f64::from(steps);
    let plus =
        |y: [f64; 4], k: [f64; 4], c: f64| -> [f64; 4] { std::array::from_fn(|i| y[i] + c * k[i]) };
    let mut y = [0.0, slope, 0.0, 0.0];
    for n in 0..steps {
        let s = f64::from(n) * h;
        let a = rate(s, y);
        let b = rate(s + 0.5 * h, plus(y, a, 0.5 * h));
        let c = rate(s + 0.5 * h, plus(y, b, 0.5 * h));
        let d = rate(s + h, plus(y, c, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    y
}

/// Deflection of the n-th mode of a clamped–free beam at s in [0, 1], βL given.
pub fn mode_shape(beta: f64, s: f64) -> f64 {
    let ratio = (beta.cosh() + beta.cos()) / (beta.sinh() + beta.sin());
    let z = beta * s;
    z.cosh() - z.cos() - ratio * (z.sinh() - z.sin())
}
