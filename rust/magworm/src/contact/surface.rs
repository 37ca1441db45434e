//! Surfaces: the gap of a place, and the normal and tangents there.
//!
//! A surface that is curved or turned is one more [`Surface`] with its evaluation here, and one more [`ContactFrame`] that holds
//! the normal and the tangents as numbers. Those of flat ground are axes of the world, so turning into its frame and back only
//! reorders components.

use super::ContactVector;
use crate::lanes::{Components, Dim, Real};
use crate::model::Surface;

/// Normal and tangents of a surface at a contact.
#[derive(Clone, Copy)]
pub(super) enum ContactFrame {
    /// Normal +y; tangents +x, in space also +z.
    Upright,
}

/// Axis of the normal of an upright frame; its tangents are the axes before and after.
const NORMAL: usize = 1;

/// Gap of a place [m], and the contact frame there.
#[inline(always)]
pub(super) fn evaluate<D: Dim, F: Real>(
    surface: Surface,
    place: D::Vector<F>,
) -> (F, ContactFrame) {
    match surface {
        Surface::FlatGround => (place[NORMAL], frame(surface)),
    }
}

/// The contact frame of a surface on which it is the same everywhere.
#[inline(always)]
pub(super) fn frame(surface: Surface) -> ContactFrame {
    match surface {
        Surface::FlatGround => ContactFrame::Upright,
    }
}

impl ContactFrame {
    /// Components of a vector along normal and tangents.
    #[inline(always)]
    pub(super) fn components<D: Dim, F: Real>(self, a: D::Vector<F>) -> ContactVector<D, F> {
        match self {
            Self::Upright => {
                let mut tangent = D::Tangent::splat(a[0]);
                for t in 1..D::TANGENTS {
                    tangent[t] = a[NORMAL + t];
                }
                ContactVector::new(a[NORMAL], tangent)
            }
        }
    }

    /// A vector from its components along normal and tangents.
    #[inline(always)]
    pub(super) fn vector<D: Dim, F: Real>(self, a: ContactVector<D, F>) -> D::Vector<F> {
        match self {
            Self::Upright => {
                let mut world = D::Vector::splat(a.tangent[0]);
                world[NORMAL] = a.normal;
                for t in 1..D::TANGENTS {
                    world[NORMAL + t] = a.tangent[t];
                }
                world
            }
        }
    }

    /// The columns of a matrix in the contact frame, the normal's first, as those of the same matrix along the axes of the world.
    #[inline(always)]
    pub(super) fn matrix<D: Dim, F: Real>(
        self,
        [normal, first, second]: [ContactVector<D, F>; 3],
    ) -> [D::Vector<F>; 3] {
        match self {
            Self::Upright => [self.vector(first), self.vector(normal), self.vector(second)],
        }
    }
}
