//! Eight lanes of `f64`, or sixteen of `f32`, on the instruction set found at run time. The only file that names the SIMD crate.

use super::{Isa, Mask, Real, Row, Single};
use fearless_simd::{
    Bytes, Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f32x16, f64x8, mask32x16,
    mask64x8, u32x16, u64x8,
};

/// Number of lanes of [`Wide`].
pub const WIDE: usize = 8;

/// The instruction set `S` with eight lanes.
#[derive(Clone, Copy, Debug)]
pub struct Wide<S: Simd>(S);

/// Number of lanes of [`WideSingle`].
pub const WIDE_SINGLE: usize = 16;

/// The instruction set `S` with sixteen lanes of single precision.
#[derive(Clone, Copy, Debug)]
pub struct WideSingle<S: Simd>(S);

/// Work on rows R that is generic over the instruction set, for [`run_wide`].
pub trait WideTask<R: Row = [f64; WIDE]> {
    /// What the work returns.
    type Output;
    /// Does the work with the instruction set `isa`.
    fn run<I: Isa<Row = R>>(self, isa: I) -> Self::Output;
}

/// An instruction set that this processor has. Results do not depend on it.
#[derive(Clone, Copy, Debug)]
pub struct InstructionSet(Level);

impl InstructionSet {
    /// The widest.
    #[inline]
    pub fn widest() -> Self {
        Self::dispatched(Level::new())
    }

    /// The one that runs where a level is asked for: a build may leave some out, and narrower ones take their place.
    #[inline]
    fn dispatched(level: Level) -> Self {
        Self(dispatch!(level, simd => simd.level()))
    }

    /// All, the widest first.
    pub fn available() -> Vec<Self> {
        let widest = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let narrower = [
            widest.as_avx2().map(Simd::level),
            widest.as_sse4_2().map(Simd::level),
            widest.as_sse2().map(Simd::level),
        ];
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let narrower = [None];
        let mut all = vec![Self::widest()];
        all.extend(narrower.into_iter().flatten().map(Self::dispatched));
        all.dedup_by_key(|set| set.name());
        all
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        match self.0 {
            Level::Avx512(_) => return "AVX-512",
            Level::Avx2(_) => return "AVX2",
            Level::Sse4_2(_) => return "SSE4.2",
            Level::Sse2(_) => return "SSE2",
            #[allow(
                unreachable_patterns,
                reason = "processors without SSE2 have a level of their own"
            )]
            _ => {}
        }
        "baseline"
    }
}

/// Runs `task` on the widest instruction set that this processor has.
#[inline]
pub fn run_wide<T: WideTask>(task: T) -> T::Output {
    run_wide_on(InstructionSet::widest(), task)
}

/// Runs `task` on one of the instruction sets that this processor has.
#[inline]
pub fn run_wide_on<T: WideTask>(set: InstructionSet, task: T) -> T::Output {
    dispatch!(set.0, simd => task.run(Wide(simd)))
}

/// Runs `task` in single precision on one of the instruction sets that this processor has.
#[inline]
pub fn run_single_on<T: WideTask<[f32; WIDE_SINGLE]>>(set: InstructionSet, task: T) -> T::Output {
    dispatch!(set.0, simd => task.run(WideSingle(simd)))
}

impl<S: Simd> Mask for mask64x8<S> {
    #[inline(always)]
    fn any(self) -> bool {
        self.any_true()
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.all_true()
    }
}

impl<S: Simd> Real for f64x8<S> {
    type Mask = mask64x8<S>;
    type Number = f64;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        SimdBase::splat(self.simd, value)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.simd.abs_f64x8(self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        SimdFloat::copysign(self, sign)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        self.simd.simd_lt_f64x8(self, other)
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        self.simd.simd_le_f64x8(self, other)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::Mask {
        self.simd.simd_eq_f64x8(self, other)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Select::select(mask, a, b)
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        let bits: u64x8<S> = self.bitcast();
        let mantissa: Self = ((bits & 0x000f_ffff_ffff_ffff) | 0x3ff0_0000_0000_0000).bitcast();
        // 2^52 + n has n in its low mantissa bits: integer to float without a conversion.
        let shifted: Self = ((bits >> 52u32) | 0x4330_0000_0000_0000).bitcast();
        (mantissa, shifted - (4_503_599_627_370_496.0 + 1023.0))
    }
}

impl<S: Simd> Isa for Wide<S> {
    type Row = [f64; WIDE];
    type F = f64x8<S>;
    type M = mask64x8<S>;

    #[inline(always)]
    fn splat(self, value: f64) -> Self::F {
        SimdBase::splat(self.0, value)
    }
    #[inline(always)]
    fn load(self, row: &[f64; WIDE]) -> Self::F {
        f64x8::load_array_ref(self.0, row)
    }
    #[inline(always)]
    fn store(self, value: Self::F, row: &mut [f64; WIDE]) {
        value.store_array(row);
    }
    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.vectorize(f)
    }
}

impl<S: Simd> Mask for mask32x16<S> {
    #[inline(always)]
    fn any(self) -> bool {
        self.any_true()
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.all_true()
    }
}

impl<S: Simd> Real for Single<f32x16<S>> {
    type Mask = mask32x16<S>;
    type Number = f32;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Self(SimdBase::splat(self.0.simd, value as f32))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(SimdFloat::sqrt(self.0))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.simd.abs_f32x16(self.0))
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(SimdFloat::copysign(self.0, sign.0))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        self.0.simd.simd_lt_f32x16(self.0, other.0)
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        self.0.simd.simd_le_f32x16(self.0, other.0)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::Mask {
        self.0.simd.simd_eq_f32x16(self.0, other.0)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Self(Select::select(mask, a.0, b.0))
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        let bits: u32x16<S> = self.0.bitcast();
        let mantissa: f32x16<S> = ((bits & 0x007f_ffff) | 0x3f80_0000).bitcast();
        // 2^23 + n has n in its low mantissa bits: integer to float without a conversion.
        let shifted: f32x16<S> = ((bits >> 23u32) | 0x4b00_0000).bitcast();
        (Self(mantissa), Self(shifted - (8_388_608.0 + 127.0)))
    }
}

impl<S: Simd> Isa for WideSingle<S> {
    type Row = [f32; WIDE_SINGLE];
    type F = Single<f32x16<S>>;
    type M = mask32x16<S>;

    #[inline(always)]
    fn splat(self, value: f64) -> Self::F {
        Single(SimdBase::splat(self.0, value as f32))
    }
    #[inline(always)]
    fn load(self, row: &[f32; WIDE_SINGLE]) -> Self::F {
        Single(f32x16::load_array_ref(self.0, row))
    }
    #[inline(always)]
    fn store(self, value: Self::F, row: &mut [f32; WIDE_SINGLE]) {
        value.0.store_array(row);
    }
    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.vectorize(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;

    const SAMPLES: [f64; WIDE] = [1.0, 1.5, 2.0, 0.1, 1e-300, 1e300, 3.7, 0.999_999_999_999];

    struct Exponents;
    impl WideTask for Exponents {
        type Output = ([f64; WIDE], [f64; WIDE]);
        fn run<I: Isa<Row = [f64; WIDE]>>(self, isa: I) -> Self::Output {
            let (m, e) = isa.load(&SAMPLES).mantissa_exponent();
            let mut out = ([0.0; WIDE], [0.0; WIDE]);
            isa.store(m, &mut out.0);
            isa.store(e, &mut out.1);
            out
        }
    }

    #[test]
    fn mantissa_and_exponent_equal_the_scalar_ones() {
        let (m, e) = run_wide(Exponents);
        for k in 0..WIDE {
            let x = Scalar.splat(SAMPLES[k]);
            assert_eq!((m[k], e[k]), x.mantissa_exponent());
            assert_eq!(m[k] * e[k].exp2(), x);
        }
    }
}
