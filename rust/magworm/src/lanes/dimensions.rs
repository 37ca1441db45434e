//! Sizes that follow from the dimension, for code that takes it from a scene.

use super::{Components, Dim, Plane, Space};

/// What is counted differently in the plane and in space. See [`Dim`], which says the same to kernels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensions {
    /// Axes of a position, see [`Dim::AXES`].
    pub axes: usize,
    /// Rotations of a body, see [`Dim::ROTATIONS`].
    pub rotations: usize,
    /// Rows of a body's axes, see [`Dim::Frame`].
    pub frame: usize,
    /// Numbers of an orientation as arrays hold it, see [`Dim::ORIENTATION`].
    pub orientation: usize,
    /// Products of inertia, see [`Dim::PRODUCTS`].
    pub products: usize,
    /// Axes of a stage, see [`Dim::STAGE`].
    pub stage: usize,
    /// Contact points across a foot, see [`Dim::ACROSS`].
    pub across: &'static [f64],
}

impl Dimensions {
    /// Those of the plane (2) or of space (3).
    pub const fn new(dimensions: usize) -> Self {
        match dimensions {
            2 => Self::of::<Plane>(),
            _ => Self::of::<Space>(),
        }
    }

    const fn of<D: Dim>() -> Self {
        Self {
            axes: D::AXES,
            rotations: D::ROTATIONS,
            frame: D::Frame::<f64>::COUNT,
            orientation: D::ORIENTATION,
            products: D::PRODUCTS,
            stage: D::STAGE,
            across: D::ACROSS,
        }
    }

    /// Unknowns of a body, and components of its velocity and of a wrench.
    pub const fn body(&self) -> usize {
        self.axes + self.rotations
    }

    /// Numbers of a pose as arrays hold it.
    pub const fn pose(&self) -> usize {
        self.axes + self.orientation
    }

    /// First moments and products of inertia of a body.
    pub const fn moments(&self) -> usize {
        self.axes + self.products
    }

    /// Axes of a stage that it turns about.
    pub const fn yaws(&self) -> usize {
        self.stage - self.axes
    }

    /// Ways in which a rod bends, and tangents of a surface.
    pub const fn tangents(&self) -> usize {
        self.axes - 1
    }

    /// Ways in which a rod twists: one in space, about its tangent.
    pub const fn twists(&self) -> usize {
        self.rotations - self.tangents()
    }
}
