//! Gauss–Legendre quadrature on [−1, 1].

use crate::lanes::math::sin_cos;

/// Largest order of a [`GaussLegendre`] rule.
pub const MAX_ORDER: usize = 10;

/// Nodes and weights that integrate polynomials up to degree 2 `order` − 1 exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussLegendre {
    order: usize,
    nodes: [f64; MAX_ORDER],
    weights: [f64; MAX_ORDER],
}

impl GaussLegendre {
    /// The rule with `order` nodes.
    ///
    /// # Panics
    /// If `order` is not in 1..=[`MAX_ORDER`].
    pub fn new(order: usize) -> Self {
        assert!(
            (1..=MAX_ORDER).contains(&order),
            "quadrature order {order} is not in 1..={MAX_ORDER}"
        );
        let (mut nodes, mut weights) = ([0.0; MAX_ORDER], [0.0; MAX_ORDER]);
        for i in 0..order.div_ceil(2) {
            let mirror = order - 1 - i;
            let x = if i == mirror { 0.0 } else { root(order, i) };
            let slope = legendre(order, x).1;
            let weight = 2.0 / ((1.0 - x * x) * slope * slope);
            (nodes[i], nodes[mirror]) = (-x, x);
            (weights[i], weights[mirror]) = (weight, weight);
        }
        GaussLegendre { order, nodes, weights }
    }

    /// Nodes in [−1, 1], ascending.
    #[inline(always)]
    pub fn nodes(&self) -> &[f64] {
        &self.nodes[..self.order]
    }
    /// Weights, of sum 2.
    #[inline(always)]
    pub fn weights(&self) -> &[f64] {
        &self.weights[..self.order]
    }

    /// Pairs of node and weight, ascending.
    #[inline(always)]
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.nodes().iter().copied().zip(self.weights().iter().copied())
    }
}

/// The `i`-th largest root of the Legendre polynomial P_n by Newton's method.
fn root(n: usize, i: usize) -> f64 {
    // Tricomi's start is so close that three steps reach the last digit; the rest are spare.
    let mut x = sin_cos(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).1;
    for _ in 0..8 {
        let (value, slope) = legendre(n, x);
        x -= value / slope;
    }
    x
}

/// P_n(x) and P_n'(x), |x| < 1, by Bonnet's recursion.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (before - x * value) / (1.0 - x * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_order_integrates_its_polynomials() {
        for order in 1..=MAX_ORDER {
            let rule = GaussLegendre::new(order);
            for degree in 0..2 * order as i32 {
                let sum: f64 = rule.points().map(|(x, w)| w * x.powi(degree)).sum();
                let exact = if degree % 2 == 0 { 2.0 / (f64::from(degree) + 1.0) } else { 0.0 };
                assert!((sum - exact).abs() < 4e-15, "order {order}, degree {degree}: {sum}");
            }
        }
    }

    #[test]
    fn third_order_has_the_tabulated_nodes() {
        let rule = GaussLegendre::new(3);
        assert!((rule.nodes()[2] - 0.6_f64.sqrt()).abs() < 1e-15);
        assert!((rule.weights()[1] - 8.0 / 9.0).abs() < 1e-15);
    }
}
