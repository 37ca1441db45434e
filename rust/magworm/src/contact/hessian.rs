//! The contact law linearised: λ = λ* − C J v, with the contact Hessian C = −∂λ/∂u.
//!
//! ```text
//!     | C_n   0   |       C_n = w where closed, else 0
//! C = |           |       c   = dF/dλ_n C_n e          where sliding, else 0
//!     | c     C_t |       C_t = w F/|ξ_t| (I − e eᵀ)   where sliding, else w I
//! ```
//!
//! with e = ξ_t/|ξ_t|. Friction that follows the normal impulse makes C unsymmetric, so it is the Hessian of an energy only with
//! Tresca's law, where c = 0. λ* takes the bias of the velocity in: λ* = λ(u) + C (u − û).

use super::ContactVector;
use super::law::{ContactImpulse, ContactLaw, FrictionLaw, PointState};
use crate::lanes::{Components, Dim, Isa, Real};
use crate::model::rows::hessian_rows;

/// λ* and C.
#[derive(Clone, Copy)]
pub(super) struct ContactHessian<D: Dim, F: Real> {
    /// λ*.
    pub(super) impulse: ContactVector<D, F>,
    /// C_n.
    pub(super) normal: F,
    /// c.
    pub(super) coupling: D::Tangent<F>,
    /// C_t.
    pub(super) tangential: D::Symmetric<F>,
}

impl<D: Dim, F: Real> ContactHessian<D, F> {
    /// The law linearised at u, where it gives `found`; in the lanes of `stick` as if the point stuck.
    #[inline(always)]
    pub(super) fn linearise(
        point: &PointState<D, F>,
        law: &ContactLaw<F>,
        friction: FrictionLaw,
        found: &ContactImpulse<D, F>,
        [u, bias]: [ContactVector<D, F>; 2],
        stick: F::Mask,
    ) -> Self {
        let (zero, w) = (u.normal.splat(0.0), law.effective_mass);
        let normal = F::select(found.closed, point.normal_mass, zero);
        let slope = law.friction_bound_slope(point.coefficient, found.impulse.normal);
        let sliding = found.sliding & !stick;
        let coupling = match friction {
            FrictionLaw::Coulomb => F::select(sliding, normal * slope, zero),
            FrictionLaw::Tresca => zero,
        };
        let across = F::select(sliding, found.cut * w, w);
        let along = F::select(sliding, across, zero);
        let mut hessian = Self {
            impulse: found.impulse,
            normal,
            coupling: found.direction * coupling,
            tangential: D::isotropic_less(across, along, found.direction),
        };
        hessian.impulse = hessian.impulse + hessian.times(u - bias);
        let sticking = point.warm_start.tangent - bias.tangent * w;
        hessian.impulse.tangent = D::Tangent::select(stick, sticking, hessian.impulse.tangent);
        hessian
    }

    /// C u.
    #[inline(always)]
    fn times(&self, u: ContactVector<D, F>) -> ContactVector<D, F> {
        let coupled = self.coupling * u.normal;
        ContactVector::new(
            self.normal * u.normal,
            D::add_product(coupled, self.tangential, u.tangent),
        )
    }

    /// Columns of C, the normal's first.
    #[inline(always)]
    pub(super) fn columns(&self) -> [ContactVector<D, F>; 3] {
        let zero = self.normal.splat(0.0);
        let tangent = |t| ContactVector::new(zero, D::column(self.tangential, t));
        [ContactVector::new(self.normal, self.coupling), tangent(0), tangent(D::TANGENTS - 1)]
    }

    /// Reads that of contact `c`.
    #[inline(always)]
    pub(super) fn load<I: Isa<F = F>>(isa: I, stored: &[I::Row], c: usize) -> Self {
        let rows = &stored[hessian_rows(D::AXES) * c..][..hessian_rows(D::AXES)];
        let (impulse, rest) = rows.split_at(D::AXES);
        Self {
            impulse: ContactVector::load(isa, impulse, 0),
            normal: isa.load(&rest[0]),
            coupling: D::Tangent::load(isa, &rest[1..]),
            tangential: D::Symmetric::load(isa, &rest[1 + D::TANGENTS..]),
        }
    }

    /// Writes the lanes of a mask.
    #[inline(always)]
    pub(super) fn store_where<I: Isa<F = F, M = F::Mask>>(
        &self,
        isa: I,
        mask: I::M,
        stored: &mut [I::Row],
        c: usize,
    ) {
        let rows = &mut stored[hessian_rows(D::AXES) * c..][..hessian_rows(D::AXES)];
        let (impulse, rest) = rows.split_at_mut(D::AXES);
        self.impulse.store_where(isa, mask, impulse, 0);
        super::store_where(isa, mask, self.normal, &mut rest[0]);
        self.coupling.store_where(isa, mask, &mut rest[1..]);
        self.tangential.store_where(isa, mask, &mut rest[1 + D::TANGENTS..]);
    }
}
