//! Surfaces: the gap of a place, and the normal and tangents there.
//!
//! A surface that is curved or turned is one more [`Surface`] with its evaluation here; its [`ContactFrame`] holds the normal as
//! numbers. Normal and tangents of flat ground are axes of the world, so turning into its frame and back only reorders
//! components.

use super::ContactVector;
use crate::lanes::{Components, Dim, Real};
use crate::model::Foot;

/// Normal and tangents of a surface at a contact.
#[derive(Clone, Copy)]
pub(super) enum ContactFrame<D: Dim, F: Real> {
    /// Normal +y; tangents +x, in space also +z.
    Upright,
    /// Normal, then tangents.
    Turned([D::Vector<F>; 3]),
}

/// Axis of the normal of an upright frame; its tangents are the axes before and after.
const NORMAL: usize = 1;

/// Gap of a place above flat ground [m].
#[inline(always)]
pub(super) fn gap_to_ground<D: Dim, F: Real>(place: D::Vector<F>) -> F {
    place[NORMAL]
}

/// Gap of a place from a foot [m], and its outward normal along the foot's axes.
///
/// Outside a box the nearest point of it decides, inside the nearest face.
#[inline(always)]
pub(super) fn nearest_of_foot<D: Dim, F: Real>(
    foot: &Foot,
    place: D::Vector<F>,
) -> (F, D::Vector<F>) {
    let zero = place[0].splat(0.0);
    let (mut outside, mut inside) = (D::Vector::splat(zero), D::Vector::splat(zero));
    let mut depth = zero - f64::INFINITY;
    for axis in 0..D::AXES {
        let beyond = place[axis].abs() - foot.half_m[axis];
        let sign = place[axis].splat(1.0).copysign(place[axis]);
        outside[axis] = sign * beyond.max(zero);
        let nearer = beyond.gt(depth);
        let mut face = D::Vector::splat(zero);
        face[axis] = sign;
        inside = D::Vector::select(nearer, face, inside);
        depth = F::select(nearer, beyond, depth);
    }
    let distance = outside.norm_squared().sqrt();
    let is_outside = distance.gt(zero);
    let over = zero.splat(1.0) / F::select(is_outside, distance, zero.splat(1.0));
    let normal = D::Vector::select(is_outside, outside * over, inside);
    (F::select(is_outside, distance, depth) - foot.radius_m, normal)
}

impl<D: Dim, F: Real> ContactFrame<D, F> {
    /// The frame with this normal.
    #[inline(always)]
    pub(super) fn about(normal: D::Vector<F>) -> Self {
        let [first, second] = D::tangents(normal);
        Self::Turned([normal, first, second])
    }

    /// Components of a vector along normal and tangents.
    #[inline(always)]
    pub(super) fn components(self, a: D::Vector<F>) -> ContactVector<D, F> {
        let mut tangent = D::Tangent::splat(a[0]);
        match self {
            Self::Upright => {
                for t in 1..D::TANGENTS {
                    tangent[t] = a[NORMAL + t];
                }
                ContactVector::new(a[NORMAL], tangent)
            }
            Self::Turned([normal, tangents @ ..]) => {
                for t in 0..D::TANGENTS {
                    tangent[t] = tangents[t].dot(a);
                }
                ContactVector::new(normal.dot(a), tangent)
            }
        }
    }

    /// A vector from its components along normal and tangents.
    #[inline(always)]
    pub(super) fn vector(self, a: ContactVector<D, F>) -> D::Vector<F> {
        match self {
            Self::Upright => {
                let mut world = D::Vector::splat(a.tangent[0]);
                world[NORMAL] = a.normal;
                for t in 1..D::TANGENTS {
                    world[NORMAL + t] = a.tangent[t];
                }
                world
            }
            Self::Turned([normal, tangents @ ..]) => {
                let mut world = normal * a.normal;
                for t in 0..D::TANGENTS {
                    world = world + tangents[t] * a.tangent[t];
                }
                world
            }
        }
    }

    /// The columns of a matrix in the contact frame, the normal's first, as those of the same matrix along the axes of the world.
    #[inline(always)]
    pub(super) fn matrix(
        self,
        [normal, first, second]: [ContactVector<D, F>; 3],
    ) -> [D::Vector<F>; 3] {
        match self {
            Self::Upright => [self.vector(first), self.vector(normal), self.vector(second)],
            Self::Turned(axes) => {
                let columns = [self.vector(normal), self.vector(first), self.vector(second)];
                let mut world = [columns[0]; 3];
                for axis in 0..D::AXES {
                    world[axis] = columns[0] * axes[0][axis];
                    for t in 1..=D::TANGENTS {
                        world[axis] = world[axis] + columns[t] * axes[t][axis];
                    }
                }
                world
            }
        }
    }
}
