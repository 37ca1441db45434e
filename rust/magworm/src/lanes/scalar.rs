//! One lane: plain `f64`, the reference that the vectors must equal bit for bit.

use super::{Isa, Mask, Real};

/// The instruction set of one lane.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scalar;

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

impl Real for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(self, value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
    #[inline(always)]
    fn copysign(self, sign: f64) -> f64 {
        f64::copysign(self, sign)
    }
    #[inline(always)]
    fn lt(self, other: f64) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: f64) -> bool {
        self <= other
    }
    #[inline(always)]
    fn eq(self, other: f64) -> bool {
        self == other
    }
    #[inline(always)]
    fn select(mask: bool, a: f64, b: f64) -> f64 {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (f64, f64) {
        let bits = self.to_bits();
        let mantissa = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | 0x3ff0_0000_0000_0000);
        let exponent = (bits >> 52) as f64 - 1023.0;
        (mantissa, exponent)
    }
}

impl Isa<1> for Scalar {
    type F = f64;
    type M = bool;

    #[inline(always)]
    fn splat(self, value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn load(self, row: &[f64; 1]) -> f64 {
        row[0]
    }
    #[inline(always)]
    fn store(self, value: f64, row: &mut [f64; 1]) {
        row[0] = value;
    }
    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }
}
