//! Every force between magnets has an equal and opposite one.
//!
//! With d from the place that one wrench is taken about to that of the other, F and T on the target, the source feels −F and
//! −(T + d × F). Both momenta are then kept to rounding, whatever the quadrature.

use crate::lanes::{Dim, Real};

/// Force and torque on the source of a field from those on a target at `offset`.
#[inline(always)]
pub fn reaction<D: Dim, F: Real>(
    offset: D::Vector<F>,
    (force, torque): (D::Vector<F>, D::Angular<F>),
) -> (D::Vector<F>, D::Angular<F>) {
    (-force, -(torque + D::torque(offset, force)))
}
