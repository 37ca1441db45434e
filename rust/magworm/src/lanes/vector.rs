//! Vectors of up to three components in lanes, with the operators that formulas are written in.
//!
//! Operators work component by component in the order x, y, z, so a formula gives the same bits as its components written out.

use super::{Isa, Real};
use std::ops::{Add, Index, IndexMut, Mul, Neg, Sub};

/// N components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<F, const N: usize>(pub [F; N]);

/// Components along x, y and z.
pub type Vec3<F> = Vector<F, 3>;

/// What kernels ask of a vector whose number of components depends on the dimension, see [`super::Dim`].
pub trait Components<F: Real>:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<F, Output = Self>
    + Index<usize, Output = F>
    + IndexMut<usize>
{
    /// Number of components.
    const COUNT: usize;

    /// The same number in every component.
    fn splat(value: F) -> Self;
    /// a · b.
    fn dot(self, other: Self) -> F;
    /// `a` where the mask is true, `b` elsewhere.
    fn select(mask: F::Mask, a: Self, b: Self) -> Self;
    /// Reads the first rows, one for each component.
    fn load<I: Isa<F = F>>(isa: I, rows: &[I::Row]) -> Self;
    /// Writes the first rows.
    fn store<I: Isa<F = F>>(self, isa: I, rows: &mut [I::Row]);

    /// |a|² = a · a.
    #[inline(always)]
    fn norm_squared(self) -> F {
        self.dot(self)
    }
    /// Writes the lanes of a mask.
    #[inline(always)]
    fn store_where<I: Isa<F = F>>(self, isa: I, mask: F::Mask, rows: &mut [I::Row]) {
        let rows = &mut rows[..Self::COUNT];
        Self::select(mask, self, Self::load(isa, rows)).store(isa, rows);
    }
}

impl<F: Real, const N: usize> Components<F> for Vector<F, N> {
    const COUNT: usize = N;

    #[inline(always)]
    fn splat(value: F) -> Self {
        Self([value; N])
    }
    #[inline(always)]
    fn dot(self, other: Self) -> F {
        let mut sum = self[0] * other[0];
        for k in 1..N {
            sum = sum + self[k] * other[k];
        }
        sum
    }
    #[inline(always)]
    fn select(mask: F::Mask, mut a: Self, b: Self) -> Self {
        for k in 0..N {
            a[k] = F::select(mask, a[k], b[k]);
        }
        a
    }
    #[inline(always)]
    fn load<I: Isa<F = F>>(isa: I, rows: &[I::Row]) -> Self {
        let rows = &rows[..N];
        let mut vector = [isa.splat(0.0); N];
        for k in 0..N {
            vector[k] = isa.load(&rows[k]);
        }
        Self(vector)
    }
    #[inline(always)]
    fn store<I: Isa<F = F>>(self, isa: I, rows: &mut [I::Row]) {
        let rows = &mut rows[..N];
        for k in 0..N {
            isa.store(self[k], &mut rows[k]);
        }
    }
}

impl<F: Real> Vec3<F> {
    /// a × b.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        let a = self;
        Self([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
    }

    /// a bᵀ, by rows.
    #[inline(always)]
    pub fn outer(self, b: Self) -> [Self; 3] {
        [b * self[0], b * self[1], b * self[2]]
    }
}

impl<F, const N: usize> Index<usize> for Vector<F, N> {
    type Output = F;
    #[inline(always)]
    fn index(&self, k: usize) -> &F {
        &self.0[k]
    }
}

impl<F, const N: usize> IndexMut<usize> for Vector<F, N> {
    #[inline(always)]
    fn index_mut(&mut self, k: usize) -> &mut F {
        &mut self.0[k]
    }
}

impl<F: Real, const N: usize> Add for Vector<F, N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, b: Self) -> Self {
        for k in 0..N {
            self[k] = self[k] + b[k];
        }
        self
    }
}

impl<F: Real, const N: usize> Sub for Vector<F, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, b: Self) -> Self {
        for k in 0..N {
            self[k] = self[k] - b[k];
        }
        self
    }
}

impl<F: Real, const N: usize> Neg for Vector<F, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        for k in 0..N {
            self[k] = -self[k];
        }
        self
    }
}

impl<F: Real, const N: usize> Mul<F> for Vector<F, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, factor: F) -> Self {
        for k in 0..N {
            self[k] = self[k] * factor;
        }
        self
    }
}
