//! The precision of numbers in rows: `f64` or `f32`.

/// A number as rows hold it, and what the elementary functions and tolerances of its precision are.
pub trait Number: Copy + Default + std::fmt::Debug + PartialEq + Send + Sync + 'static {
    /// The smallest positive number.
    const SMALLEST: f64;
    /// 1.5 · 2^(bits of the fraction): adding and subtracting it rounds to the nearest integer.
    const ROUND: f64;
    /// ln 2 in two parts, of which the first has so few bits that its product with any exponent is exact.
    const LN_2: [f64; 2];
    /// π/4 as a number of this precision, and what is missing.
    const EIGHTH_TURN: [f64; 2];
    /// π/2 in three parts, the first two so short that their products with whole numbers are exact (Cody and Waite).
    const HALF_PI: [f64; 3];
    /// Residual of a contact solve relative to the impulses without contact: well above what rounding leaves of it.
    const RESIDUAL: f64;

    /// The number nearest to a value.
    fn of(value: f64) -> Self;
    /// Its value.
    fn f64(self) -> f64;
}

impl Number for f64 {
    const SMALLEST: f64 = 5e-324;
    const ROUND: f64 = 6_755_399_441_055_744.0;
    const LN_2: [f64; 2] = [0.693_147_180_559_890_3, 5.497_923_018_708_371e-14];
    // The last three bits of the first part are 0, so that its product with 0..=4 is exact.
    const EIGHTH_TURN: [f64; 2] = [std::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17];
    const HALF_PI: [f64; 3] =
        [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
    const RESIDUAL: f64 = 1e-9;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn f64(self) -> f64 {
        self
    }
}

impl Number for f32 {
    const SMALLEST: f64 = f32::from_bits(1) as f64;
    const ROUND: f64 = 12_582_912.0;
    const LN_2: [f64; 2] = [0.693_359_375, -2.121_944_400_546_905_8e-4];
    const EIGHTH_TURN: [f64; 2] = [
        std::f32::consts::FRAC_PI_4 as f64,
        std::f64::consts::FRAC_PI_4 - std::f32::consts::FRAC_PI_4 as f64,
    ];
    const HALF_PI: [f64; 3] = [1.570_312_5, 4.837_512_969_970_703e-4, 7.549_789_948_768_648e-8];
    const RESIDUAL: f64 = 3e-5;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value as Self
    }
    #[inline(always)]
    fn f64(self) -> f64 {
        Self::into(self)
    }
}
