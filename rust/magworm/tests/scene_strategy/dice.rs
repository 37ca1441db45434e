//! Dependent random numbers without nested strategies: a row of numbers in [0, 1], read one by one.

use proptest::prelude::*;

/// A row of numbers in [0, 1]; when it is used up, a half.
#[derive(Clone, Debug)]
pub struct Dice(std::vec::IntoIter<f64>);

/// A row of `count` numbers. The ends of the interval come often: corners break first.
pub fn dice(count: usize) -> impl Strategy<Value = Dice> {
    let unit = prop_oneof![1 => Just(0.0), 1 => Just(1.0), 10 => 0.0..=1.0];
    prop::collection::vec(unit, count).prop_map(|row| Dice(row.into_iter()))
}

impl Dice {
    fn unit(&mut self) -> f64 {
        self.0.next().unwrap_or(0.5)
    }

    /// A number in [low, high].
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        (low + self.unit() * (high - low)).clamp(low, high)
    }

    /// A number in [low, high] in space, 0 in the plane.
    pub fn in_space(&mut self, dimensions: usize, low: f64, high: f64) -> f64 {
        if dimensions > 2 { self.between(low, high) } else { 0.0 }
    }

    /// A number in [low, high], every decade as likely.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp().clamp(low, high)
    }

    /// A whole number in low..=high, small ones more likely.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        // The logarithm and back may miss the greatest number by rounding.
        let above = (self.decades(1.0, (high - low + 1) as f64) + 1e-9) as usize;
        (low + above - 1).min(high)
    }

    /// True or false.
    pub fn coin(&mut self) -> bool {
        self.unit() < 0.5
    }

    /// 1 or −1.
    pub fn polarity(&mut self) -> i8 {
        if self.coin() { 1 } else { -1 }
    }

    /// One of some values.
    pub fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[((self.unit() * values.len() as f64) as usize).min(values.len() - 1)]
    }
}
