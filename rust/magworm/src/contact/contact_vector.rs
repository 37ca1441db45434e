//! Velocities and impulses at a contact, along the normal n and the tangents t of the surface.

use crate::lanes::{Components, Dim, Isa, Real};
use std::ops::{Add, Mul, Neg, Sub};

/// Components along the normal and along the tangents. Stored as D rows, the normal's first.
#[derive(Clone, Copy)]
pub(super) struct ContactVector<D: Dim, F: Real> {
    pub(super) normal: F,
    pub(super) tangent: D::Tangent<F>,
}

impl<D: Dim, F: Real> ContactVector<D, F> {
    #[inline(always)]
    pub(super) fn new(normal: F, tangent: D::Tangent<F>) -> Self {
        Self { normal, tangent }
    }

    /// Reads the vector of contact `c`.
    #[inline(always)]
    pub(super) fn load<I: Isa<F = F>>(isa: I, rows: &[I::Row], c: usize) -> Self {
        let rows = &rows[D::AXES * c..][..D::AXES];
        Self::new(isa.load(&rows[0]), D::Tangent::load(isa, &rows[1..]))
    }

    /// Writes the vector of contact `c`.
    #[inline(always)]
    pub(super) fn store<I: Isa<F = F>>(self, isa: I, rows: &mut [I::Row], c: usize) {
        let rows = &mut rows[D::AXES * c..][..D::AXES];
        isa.store(self.normal, &mut rows[0]);
        self.tangent.store(isa, &mut rows[1..]);
    }

    /// Writes the lanes of a mask.
    #[inline(always)]
    pub(super) fn store_where<I: Isa<F = F, M = F::Mask>>(
        self,
        isa: I,
        mask: F::Mask,
        rows: &mut [I::Row],
        c: usize,
    ) {
        let rows = &mut rows[D::AXES * c..][..D::AXES];
        super::store_where(isa, mask, self.normal, &mut rows[0]);
        self.tangent.store_where(isa, mask, &mut rows[1..]);
    }
}

impl<D: Dim, F: Real> Add for ContactVector<D, F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::new(self.normal + b.normal, self.tangent + b.tangent)
    }
}

impl<D: Dim, F: Real> Sub for ContactVector<D, F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::new(self.normal - b.normal, self.tangent - b.tangent)
    }
}

impl<D: Dim, F: Real> Neg for ContactVector<D, F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.normal, -self.tangent)
    }
}

impl<D: Dim, F: Real> Mul<F> for ContactVector<D, F> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: F) -> Self {
        Self::new(self.normal * factor, self.tangent * factor)
    }
}
