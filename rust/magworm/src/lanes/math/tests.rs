//! Errors against the platform's functions, and equal bits in one lane and in eight.

use super::*;
use crate::lanes::{Isa, WIDE, WideTask, run_wide};

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
fn ln_is_within_one_and_a_half_ulp() {
    let wide = uniform(COUNT, 1).into_iter().map(|u| (1400.0 * (u - 0.5)).exp());
    let near_one = uniform(COUNT, 2).into_iter().map(|u| 0.5 + 1.5 * u);
    let error = worst(wide.chain(near_one).map(|x| (ln(x), x.ln())));
    println!("ln: {error:.2} ulp");
    assert!(error <= 1.5);
    assert_eq!(ln(1.0), 0.0);
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
fn all<F: Real>(x: F, y: F) -> [F; 7] {
    let (s, c) = sin_cos(y);
    [ln(x), ln_ratio(x, y.abs()), atan(y), atan2(y, x), atan2(x, y), s, c]
}

struct Everything<'a>(&'a [[f64; WIDE]], &'a [[f64; WIDE]]);
impl WideTask for Everything<'_> {
    type Output = Vec<[[f64; WIDE]; 7]>;
    fn run<I: Isa<WIDE>>(self, isa: I) -> Self::Output {
        let run = |(x, y): (&[f64; WIDE], &[f64; WIDE])| {
            isa.vectorize(
                #[inline(always)]
                || {
                    let mut rows = [[0.0; WIDE]; 7];
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

#[test]
fn eight_lanes_have_the_bits_of_one() {
    let rows = |seed, f: fn(f64) -> f64| -> Vec<[f64; WIDE]> {
        let samples: Vec<f64> = uniform(1 << 16, seed).into_iter().map(f).collect();
        samples.chunks_exact(WIDE).map(|row| row.try_into().unwrap()).collect()
    };
    let x = rows(9, |u| (60.0 * (u - 0.5)).exp());
    let y = rows(10, |u| (20.0 * (u - 0.65)).exp().copysign(u - 0.4).max(-900.0));
    for (i, wide) in run_wide(Everything(&x, &y)).iter().enumerate() {
        for lane in 0..WIDE {
            for (row, scalar) in wide.iter().zip(all(x[i][lane], y[i][lane])) {
                assert_eq!(row[lane].to_bits(), scalar.to_bits());
            }
        }
    }
}
