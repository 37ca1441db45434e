//! Elementary functions as polynomials, the same bits in every lane and on every platform.
//!
//! Each function reduces its argument with exact steps and evaluates a minimax polynomial
//! (relative error below 2⁻⁵⁸, found by the exchange algorithm of Remez in 60 digits). Only
//! correctly rounded operations occur, so the result does not depend on the platform.
//!
//! | function | largest error measured | arguments |
//! |---|---|---|
//! | [`ln_ratio`] | 2.2e-16 of the larger of 1 and the result | positive normal |
//! | [`atan`], [`atan2`] | 2 ulp | finite |
//! | [`sin_cos`] | 1 ulp | magnitude up to 1000 rad |
//!
//! The errors are distances to the platform's correctly rounded results over a million samples. In single precision the
//! same polynomials are rounded to `f32`: ln_ratio 1.8e-7, atan2 2 ulp, sine and cosine 1 ulp up to 30 rad.

use super::{Number, Real};

#[cfg(test)]
mod tests;

/// tan(π/8): above it the arctangent is reduced by π/4.
const TAN_PI_8: f64 = std::f64::consts::SQRT_2 - 1.0;

/// (2 artanh s − 2 s) / s³ in s², |s| ≤ (√2 − 1)/(√2 + 1).
const ARTANH: [f64; 7] = [
    0.666_666_666_666_673_4,
    0.399_999_999_994_143,
    0.285_714_287_424_789_6,
    0.222_221_985_631_329_8,
    0.181_835_648_831_235_46,
    0.153_140_354_382_211_88,
    0.147_961_093_238_018_15,
];
/// (atan t − t) / t³ in t², |t| ≤ tan(π/8).
const ATAN: [f64; 11] = [
    -0.333_333_333_333_332,
    0.199_999_999_999_540_4,
    -0.142_857_142_802_442_63,
    0.111_111_107_859_159_76,
    -0.090_908_978_298_116_26,
    0.076_920_615_147_881_64,
    -0.066_631_189_483_764_48,
    0.058_479_981_662_641_62,
    -0.050_397_957_912_677_795,
    0.038_077_027_170_919_07,
    -0.017_920_830_959_707_017,
];
/// (sin r − r) / r³ in r², |r| ≤ π/4.
const SIN: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_413,
    -0.000_198_412_698_298_077_78,
    2.755_731_369_191_571e-6,
    -2.505_075_811_572_423e-8,
    1.589_679_571_505_971_2e-10,
];
/// (cos r − 1 + r²/2) / r⁴ in r², |r| ≤ π/4.
const COS: [f64; 6] = [
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_412_5,
    2.480_158_728_948_234e-5,
    -2.755_731_435_237_231_6e-7,
    2.087_572_327_815_26e-9,
    -1.135_964_804_336_546_1e-11,
];

/// Σ c_i z^i by Horner's rule.
#[inline(always)]
fn polynomial<F: Real, const N: usize>(z: F, c: &[f64; N]) -> F {
    let mut p = z.splat(c[N - 1]);
    for i in (0..N - 1).rev() {
        p = p * z + c[i];
    }
    p
}

/// ln(p/q) with a single division, for positive normal `p` and `q`; finite also where they are 0.
///
/// With p/q = 2^e m and m within a factor √2 of 1, ln(p/q) = e ln 2 + 2 artanh((m−1)/(m+1)).
#[inline(always)]
pub fn ln_ratio<F: Real>(p: F, q: F) -> F {
    let (mp, ep) = p.mantissa_exponent();
    let (mq, eq) = q.mantissa_exponent();
    let one = p.splat(1.0);
    let high = mp.gt(mq * std::f64::consts::SQRT_2);
    let low = (mp * std::f64::consts::SQRT_2).lt(mq);
    let mq = F::select(high, mq + mq, mq);
    let mp = F::select(low, mp + mp, mp);
    let e = ep - eq + F::select(high, one, F::select(low, -one, p.splat(0.0)));
    let s = (mp - mq) / (mp + mq);
    let z = s * s;
    let tail = s * z * polynomial(z, &ARTANH) + e * F::Number::LN_2[1];
    e * F::Number::LN_2[0] + (s + s + tail)
}

/// The nearest whole number, for magnitudes below 2^50.
#[inline(always)]
pub fn round<F: Real>(x: F) -> F {
    x + F::Number::ROUND - F::Number::ROUND
}

/// Angle of the vector (x, y) in [−π, π], for finite `y` and `x`.
///
/// |angle| = k π/4 ± atan(t) with k in 0..=4 and |t| at most tan(π/8). The angle of (0, 0) is 0
/// with the sign of `y`, whatever the sign of the zero `x`; on the negative x axis it is π with
/// the sign of `y`.
#[inline(always)]
pub fn atan2<F: Real>(y: F, x: F) -> F {
    let (up, side) = (y.abs(), x.abs());
    let (zero, one) = (x.splat(0.0), x.splat(1.0));
    let steep = up.gt(side);
    // The smallest positive number in place of 0 avoids 0/0.
    let large = F::select(steep, up, side).max(x.splat(F::Number::SMALLEST));
    let small = F::select(steep, side, up);
    let folded = small.gt(large * TAN_PI_8);
    let t = F::select(folded, small - large, small) / F::select(folded, small + large, large);

    let k = F::select(folded, one, zero);
    let k = F::select(steep, -k + 2.0, k);
    let left = x.lt(zero);
    let k = F::select(left, -k + 4.0, k);
    let t = F::select(steep, -t, t);
    let t = F::select(left, -t, t);
    let z = t * t;
    let tail = t * z * polynomial(z, &ATAN) + k * F::Number::EIGHTH_TURN[1];
    (k * F::Number::EIGHTH_TURN[0] + (t + tail)).copysign(y)
}

/// An angle in radians: one product, rounded once.
pub fn radians(angle_deg: f64) -> f64 {
    angle_deg * (std::f64::consts::PI / 180.0)
}

/// An angle in degrees: one product, rounded once.
pub fn degrees(angle_rad: f64) -> f64 {
    angle_rad * (180.0 / std::f64::consts::PI)
}

/// Arctangent in [−π/2, π/2] of a finite number.
#[inline(always)]
pub fn atan<F: Real>(x: F) -> F {
    atan2(x, x.splat(1.0))
}

/// Sine and cosine of an angle of up to 1000 rad in magnitude.
#[inline(always)]
pub fn sin_cos<F: Real>(x: F) -> (F, F) {
    let k = round(x * std::f64::consts::FRAC_2_PI);
    let r = x - k * F::Number::HALF_PI[0];
    let high = r - k * F::Number::HALF_PI[1];
    let low = (r - high - k * F::Number::HALF_PI[1]) - k * F::Number::HALF_PI[2];
    let r = high + low;
    let low = high - r + low;

    let z = r * r;
    let half = z * 0.5;
    let lead = -half + 1.0;
    let sin = r + (r * z * polynomial(z, &SIN) + low * lead);
    let cos = lead + ((-lead + 1.0 - half) + (z * z * polynomial(z, &COS) - r * low));

    // k mod 4 in −2..=2: odd swaps, 1 and ±2 negate.
    let quarter = k - round(k * 0.25) * 4.0;
    let one = x.splat(1.0);
    let odd = quarter.abs().eq(one);
    let turned = quarter.abs().eq(x.splat(2.0));
    let (s, c) = (F::select(odd, cos, sin), F::select(odd, sin, cos));
    let s = F::select(turned | quarter.eq(-one), -s, s);
    let c = F::select(turned | quarter.eq(one), -c, c);
    (s, c)
}
