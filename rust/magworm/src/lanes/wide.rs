//! Eight lanes on the instruction set found at run time. The only file that names the SIMD crate.

use super::{Isa, Mask, Real};
use fearless_simd::{
    Bytes, Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f64x8, mask64x8, u64x8,
};

/// Number of lanes of [`Wide`].
pub const WIDE: usize = 8;

/// The instruction set `S` with eight lanes.
#[derive(Clone, Copy, Debug)]
pub struct Wide<S: Simd>(S);

/// Work that is generic over the instruction set, for [`run_wide`].
pub trait WideTask {
    /// What the work returns.
    type Output;
    /// Does the work with the instruction set `isa`.
    fn run<I: Isa<WIDE>>(self, isa: I) -> Self::Output;
}

/// An instruction set that this processor has. Results do not depend on it.
#[derive(Clone, Copy, Debug)]
pub struct InstructionSet(Level);

impl InstructionSet {
    /// The widest.
    #[inline]
    pub fn widest() -> Self {
        Self(Level::new())
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
        let mut all = vec![Self(widest)];
        all.extend(narrower.into_iter().flatten().map(Self));
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

impl<S: Simd> Isa<WIDE> for Wide<S> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;

    const SAMPLES: [f64; WIDE] = [1.0, 1.5, 2.0, 0.1, 1e-300, 1e300, 3.7, 0.999_999_999_999];

    struct Exponents;
    impl WideTask for Exponents {
        type Output = ([f64; WIDE], [f64; WIDE]);
        fn run<I: Isa<WIDE>>(self, isa: I) -> Self::Output {
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
