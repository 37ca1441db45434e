//! Sixteen lanes as two vectors of eight: every kernel does its work for two blocks, operation by operation, so that
//! each chain of operations that wait for each other has a second one beside it that waits for nothing of the first.

use magworm::internals::lanes::{Isa, Mask, Real, WIDE};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Lanes of two vectors.
pub const TWIN: usize = 2 * WIDE;

/// Two vectors of an instruction set side by side.
#[derive(Clone, Copy)]
pub struct Twin<I>(pub I);

/// A value of both.
#[derive(Clone, Copy)]
pub struct Pair<T>(T, T);

macro_rules! arithmetic {
    ($($name:ident, $method:ident;)*) => {$(
        impl<F: Real> $name for Pair<F> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Pair(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
        impl<F: Real> $name<f64> for Pair<F> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                Pair(self.0.$method(other), self.1.$method(other))
            }
        }
    )*};
}

arithmetic! { Add, add; Sub, sub; Mul, mul; Div, div; }

impl<F: Real> Neg for Pair<F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Pair(-self.0, -self.1)
    }
}

impl<M: Mask> BitAnd for Pair<M> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Pair(self.0 & other.0, self.1 & other.1)
    }
}

impl<M: Mask> BitOr for Pair<M> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Pair(self.0 | other.0, self.1 | other.1)
    }
}

impl<M: Mask> Not for Pair<M> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Pair(!self.0, !self.1)
    }
}

impl<M: Mask> Mask for Pair<M> {
    #[inline(always)]
    fn any(self) -> bool {
        self.0.any() | self.1.any()
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0.all() & self.1.all()
    }
}

impl<F: Real> Real for Pair<F> {
    type Mask = Pair<F::Mask>;
    type Number = F::Number;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Pair(self.0.splat(value), self.1.splat(value))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Pair(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Pair(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Pair(self.0.copysign(sign.0), self.1.copysign(sign.1))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        Pair(self.0.lt(other.0), self.1.lt(other.1))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        Pair(self.0.le(other.0), self.1.le(other.1))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::Mask {
        Pair(self.0.eq(other.0), self.1.eq(other.1))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Pair(F::select(mask.0, a.0, b.0), F::select(mask.1, a.1, b.1))
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        let (a, b) = (self.0.mantissa_exponent(), self.1.mantissa_exponent());
        (Pair(a.0, b.0), Pair(a.1, b.1))
    }
}

/// Both halves of a row.
#[inline(always)]
fn halves(row: &[f64; TWIN]) -> (&[f64; WIDE], &[f64; WIDE]) {
    let (halves, _) = row.as_chunks::<WIDE>();
    (&halves[0], &halves[1])
}

impl<I: Isa<Row = [f64; WIDE]>> Isa for Twin<I> {
    type Row = [f64; TWIN];
    type F = Pair<I::F>;
    type M = Pair<I::M>;

    #[inline(always)]
    fn splat(self, value: f64) -> Self::F {
        Pair(self.0.splat(value), self.0.splat(value))
    }
    #[inline(always)]
    fn load(self, row: &[f64; TWIN]) -> Self::F {
        let (first, second) = halves(row);
        Pair(self.0.load(first), self.0.load(second))
    }
    #[inline(always)]
    fn store(self, value: Self::F, row: &mut [f64; TWIN]) {
        let (halves, _) = row.as_chunks_mut::<WIDE>();
        self.0.store(value.0, &mut halves[0]);
        self.0.store(value.1, &mut halves[1]);
    }
    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.vectorize(f)
    }
}
