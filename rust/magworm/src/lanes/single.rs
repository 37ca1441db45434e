//! Vectors of single precision as [`super::Real`] wants them: constants come as `f64`.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A vector of `f32`, or one: V.
#[derive(Clone, Copy, Debug)]
pub struct Single<V>(pub(super) V);

macro_rules! operator {
    ($operator:ident, $method:ident) => {
        impl<V: $operator<Output = V>> $operator for Single<V> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
        impl<V: $operator<f32, Output = V>> $operator<f64> for Single<V> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, constant: f64) -> Self {
                Self(self.0.$method(constant as f32))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<V: Neg<Output = V>> Neg for Single<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}
