//! Errors against the platform's functions, and equal bits in one lane and in many.

use super::*;
use crate::lanes::{
    InstructionSet, Isa, Number, Row, Scalar, ScalarSingle, Single, WIDE, WIDE_SINGLE, WideTask,
    run_single_on, run_wide,
};

/// Distance in units of the last place of `exact`.
fn ulp(value: f64, exact: f64) -> f64 {
    if value == exact {
        return 0.0;
    }
    let magnitude = exact.abs().max(f64::MIN_POSITIVE);
    let unit = f64::from_bits(magnitude.to_bits() + 1) - magnitude;
    (value - exact).abs() / unit
}

/// Deterministic samples in [0, 1).
fn uniform(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed;
    (0..count)
        .map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        })
        .collect()
}

const COUNT: usize = 1 << 20;

fn worst(values: impl Iterator<Item = (f64, f64)>) -> f64 {
    values.map(|(value, exact)| ulp(value, exact)).fold(0.0, f64::max)
}

#[test]
fn ln_ratio_equals_the_difference_of_logarithms() {
    let (p, q) = (uniform(COUNT, 3), uniform(COUNT, 4));
    let mut error = 0.0_f64;
    for (p, q) in p.into_iter().zip(q) {
        let (p, q) = ((40.0 * (p - 0.5)).exp(), (40.0 * (q - 0.5)).exp());
        let exact = (p / q).ln();
        error = error.max((ln_ratio(p, q) - exact).abs() / exact.abs().max(1.0));
    }
    println!("ln_ratio: {error:.1e}");
    assert!(error <= 5e-16);
    assert_eq!(ln_ratio(0.3, 0.3), 0.0);
}

#[test]
fn arctangents_are_within_two_and_a_half_ulp() {
    let angles = uniform(COUNT, 5).into_iter().zip(uniform(COUNT, 6));
    let error = worst(angles.map(|(angle, size)| {
        let (s, c) = (std::f64::consts::TAU * (angle - 0.5)).sin_cos();
        let r = (100.0 * (size - 0.5)).exp();
        (atan2(r * s, r * c), (r * s).atan2(r * c))
    }));
    let slopes = uniform(COUNT, 7).into_iter().map(|u| (80.0 * (u - 0.5)).exp());
    let single = worst(slopes.flat_map(|x| [(atan(x), x.atan()), (atan(-x), (-x).atan())]));
    println!("atan2: {error:.2} ulp, atan: {single:.2} ulp");
    assert!(error <= 2.5 && single <= 2.5);
}

#[test]
fn arctangent_is_right_on_the_axes() {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    assert_eq!(atan2(0.0, 1.0), 0.0);
    assert_eq!(atan2(0.0, -1.0), PI);
    assert_eq!(atan2(-0.0, -1.0), -PI);
    assert_eq!(atan2(1.0, 0.0), FRAC_PI_2);
    assert_eq!(atan2(-1.0, 0.0), -FRAC_PI_2);
    assert_eq!(atan2(-2.0, 2.0), -FRAC_PI_4);
    assert_eq!(atan2(0.0, 0.0), 0.0);
    assert_eq!(atan(f64::MAX), FRAC_PI_2);
}

#[test]
fn sine_and_cosine_are_within_one_and_a_half_ulp() {
    let mut error = 0.0_f64;
    for u in uniform(COUNT, 8) {
        for x in [2000.0 * (u - 0.5), 8.0 * (u - 0.5), 1e-3 * (u - 0.5)] {
            let (s, c) = sin_cos(x);
            error = error.max(ulp(s, x.sin())).max(ulp(c, x.cos()));
        }
    }
    println!("sin_cos: {error:.2} ulp");
    assert!(error <= 1.5);
    for k in -636..=636 {
        let x = f64::from(k) * std::f64::consts::FRAC_PI_2;
        let (s, c) = sin_cos(x);
        assert!(ulp(s, x.sin()) <= 1.5 && ulp(c, x.cos()) <= 1.5, "{k} quarter turns");
    }
}

/// Every function of this module at (x, y), x positive.
#[inline(always)]
fn all<F: Real>(x: F, y: F) -> [F; 6] {
    let (s, c) = sin_cos(y);
    [ln_ratio(x, y.abs()), atan(y), atan2(y, x), atan2(x, y), s, c]
}

/// Distance in units of the last place of `exact` in single precision.
fn ulp_single(value: Single<f32>, exact: f64) -> f64 {
    let magnitude = (exact.abs() as f32).max(f32::MIN_POSITIVE);
    let unit = f32::from_bits(magnitude.to_bits() + 1) - magnitude;
    (f64::from(value.0) - exact).abs() / f64::from(unit)
}

#[test]
fn single_precision_is_within_two_and_a_half_ulp() {
    let (mut arctangent, mut sine) = (0.0_f64, 0.0_f64);
    for (u, w) in uniform(COUNT, 11).into_iter().zip(uniform(COUNT, 12)) {
        let x = (60.0 * (u - 0.5)).exp() as f32;
        let angle = std::f64::consts::TAU * (w - 0.5);
        let [y, z] = [angle.sin(), angle.cos()].map(|part| (f64::from(x) * part) as f32);
        let exact = f64::from(y).atan2(f64::from(z));
        arctangent = arctangent.max(ulp_single(atan2(Single(y), Single(z)), exact));
        for turned in [8.0 * (u - 0.5), 60.0 * (w - 0.5)].map(|x| x as f32) {
            let (s, c) = sin_cos(Single(turned));
            let (exact_s, exact_c) = f64::from(turned).sin_cos();
            sine = sine.max(ulp_single(s, exact_s)).max(ulp_single(c, exact_c));
        }
    }
    println!("single: atan2 {arctangent:.2}, sin_cos {sine:.2} ulp");
    assert!(arctangent <= 2.5 && sine <= 1.5);
}

#[test]
fn logarithms_of_ratios_in_single_precision_are_within_three_roundings() {
    let mut error = 0.0_f64;
    for (p, q) in uniform(COUNT, 13).into_iter().zip(uniform(COUNT, 14)) {
        let [p, q] = [p, q].map(|u| (40.0 * (u - 0.5)).exp() as f32);
        let exact = (f64::from(p) / f64::from(q)).ln();
        let found = f64::from(ln_ratio(Single(p), Single(q)).0);
        error = error.max((found - exact).abs() / exact.abs().max(1.0));
    }
    println!("single: ln_ratio {error:.1e}");
    assert!(error <= 1.8e-7);
}

struct Everything<'a, R>(&'a [R], &'a [R]);
impl<R: Row> WideTask<R> for Everything<'_, R> {
    type Output = Vec<[R; 6]>;
    fn run<I: Isa<Row = R>>(self, isa: I) -> Self::Output {
        let run = |(x, y): (&R, &R)| {
            isa.vectorize(
                #[inline(always)]
                || {
                    let mut rows = [R::zeros(); 6];
                    for (row, value) in rows.iter_mut().zip(all(isa.load(x), isa.load(y))) {
                        isa.store(value, row);
                    }
                    rows
                },
            )
        };
        self.0.iter().zip(self.1).map(run).collect()
    }
}

/// Arguments of all functions, in rows.
fn arguments<R: Row>() -> [Vec<R>; 2] {
    let rows = |seed, f: fn(f64) -> f64| -> Vec<R> {
        let samples: Vec<_> =
            uniform(1 << 16, seed).into_iter().map(|u| R::Number::of(f(u))).collect();
        R::cut(&samples).to_vec()
    };
    let x = rows(9, |u| (60.0 * (u - 0.5)).exp());
    let y = rows(10, |u| (20.0 * (u - 0.65)).exp().copysign(u - 0.4).max(-900.0));
    [x, y]
}

/// Each lane against one lane alone.
fn lanes_equal_one<R: Row, I: Isa<Row = [R::Number; 1]>>(
    isa: I,
    [x, y]: &[Vec<R>; 2],
    wide: &[[R; 6]],
) {
    for (i, wide) in wide.iter().enumerate() {
        for lane in 0..R::LANES {
            let alone = all(isa.load(&[x[i][lane]]), isa.load(&[y[i][lane]]));
            for (row, value) in wide.iter().zip(alone) {
                let mut one = [R::Number::default()];
                isa.store(value, &mut one);
                assert_eq!(row[lane].f64().to_bits(), one[0].f64().to_bits());
            }
        }
    }
}

#[test]
fn many_lanes_have_the_bits_of_one() {
    let double = arguments::<[f64; WIDE]>();
    lanes_equal_one(Scalar, &double, &run_wide(Everything(&double[0], &double[1])));
    let single = arguments::<[f32; WIDE_SINGLE]>();
    let task = Everything(&single[0], &single[1]);
    lanes_equal_one(ScalarSingle, &single, &run_single_on(InstructionSet::widest(), task));
}
