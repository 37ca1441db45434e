//! Lanes: environments side by side in one vector.
//!
//! Kernels are written once against [`Real`] (a vector of numbers), [`Row`] (the same in memory), [`Mask`] and [`Isa`]
//! (an instruction set of a given width) and run as plain `f64` ([`Scalar`], one lane) or as eight
//! lanes ([`Wide`]) on whatever instruction set the processor offers at run time. In single precision
//! they run as plain `f32` ([`ScalarSingle`]) or as sixteen lanes ([`WideSingle`]): as many bytes, twice the robots.
//!
//! Only IEEE-exact operations are offered: `+ − × ÷ √`, comparison and selection, and exact bit
//! manipulation. There is no fused multiply-add, no approximate reciprocal, no platform `libm`.
//! Therefore scalar, SSE2, AVX2 and AVX-512 give **equal bits**.
//!
//! Every function that takes a `Real` or an `Isa` is `#[inline(always)]`: code that is not
//! inlined into [`Isa::vectorize`] would be compiled without the vector instructions.

pub mod banded;
pub mod chain;
mod dim;
mod dimensions;
pub mod math;
mod number;
mod row;
mod scalar;
mod single;
pub mod unsymmetric;
mod vector;
mod wide;

pub use dim::{Dim, Plane, Space};
pub use dimensions::Dimensions;
pub use number::Number;
pub use row::Row;
pub use scalar::{Scalar, ScalarSingle};
pub use single::Single;
pub use vector::{Components, Vec3, Vector};
pub use wide::{InstructionSet, WIDE, WIDE_SINGLE, WideTask, run_single_on, run_wide, run_wide_on};

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// One truth value per lane.
pub trait Mask:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> + Send + Sync
{
    /// Whether any lane is true.
    fn any(self) -> bool;
    /// Whether every lane is true.
    fn all(self) -> bool;
}

/// A vector of numbers, one per lane, with IEEE-exact arithmetic. Constants are given as `f64` and rounded to the
/// precision of its numbers.
pub trait Real:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// One truth value per lane.
    type Mask: Mask;
    /// What rows of it hold.
    type Number: Number;

    /// The constant `value` in every lane.
    fn splat(self, value: f64) -> Self;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Absolute value: clears the sign bit.
    fn abs(self) -> Self;
    /// Magnitude of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;
    /// `self < other`; false where either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`; false where either is NaN.
    fn le(self, other: Self) -> Self::Mask;
    /// `self == other`; false where either is NaN.
    fn eq(self, other: Self) -> Self::Mask;
    /// `a` where the mask is true, `b` elsewhere.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;
    /// Splits a positive normal number into mantissa and exponent:
    /// `self = m · 2^e`, `m` in [1, 2), `e` an integer held as a float.
    fn mantissa_exponent(self) -> (Self, Self);

    /// `self > other`.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }
    /// `self >= other`.
    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }
    /// The larger of the two; `other` where `self` is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }
    /// The smaller of the two; `other` where `self` is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }
    /// `self` limited to `[low, high]`.
    #[inline(always)]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }
    /// True where the value is neither infinite nor NaN.
    #[inline(always)]
    fn is_finite(self) -> Self::Mask {
        self.abs().lt(self.splat(f64::INFINITY))
    }
}

/// An instruction set with vectors of as many lanes as its rows have.
pub trait Isa: Copy + Send + Sync {
    /// What a vector is in memory.
    type Row: Row;
    /// The vector of numbers.
    type F: Real<Mask = Self::M, Number = <Self::Row as Row>::Number>;
    /// The vector of truth values.
    type M: Mask;

    /// The constant `value` in every lane.
    fn splat(self, value: f64) -> Self::F;
    /// Reads a row, one number per lane.
    fn load(self, row: &Self::Row) -> Self::F;
    /// Writes a row, one number per lane.
    fn store(self, value: Self::F, row: &mut Self::Row);
    /// Runs `f` compiled for this instruction set.
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R;
}
