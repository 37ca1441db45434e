//! One lane: plain `f64` or `f32`, the reference that the vectors must equal bit for bit.

use super::{Isa, Mask, Real, Single};

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
    type Number = f64;

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

impl Isa for Scalar {
    type Row = [f64; 1];
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

/// The instruction set of one lane in single precision.
#[derive(Clone, Copy, Debug, Default)]
pub struct ScalarSingle;

impl Real for Single<f32> {
    type Mask = bool;
    type Number = f32;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Self(value as f32)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self.0 <= other.0
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        self.0 == other.0
    }
    #[inline(always)]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        let bits = self.0.to_bits();
        let mantissa = f32::from_bits((bits & 0x007f_ffff) | 0x3f80_0000);
        let exponent = (bits >> 23) as f32 - 127.0;
        (Self(mantissa), Self(exponent))
    }
}

impl Isa for ScalarSingle {
    type Row = [f32; 1];
    type F = Single<f32>;
    type M = bool;

    #[inline(always)]
    fn splat(self, value: f64) -> Single<f32> {
        Single(value as f32)
    }
    #[inline(always)]
    fn load(self, row: &[f32; 1]) -> Single<f32> {
        Single(row[0])
    }
    #[inline(always)]
    fn store(self, value: Single<f32>, row: &mut [f32; 1]) {
        row[0] = value.0;
    }
    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }
}
