//! What the mechanics of a rod do differently in the plane and in space.

use super::{Scheme, bend, frames, twist};
use crate::lanes::math::sin_cos;
use crate::lanes::{Components, Dim, Isa, Plane, Real, Space, Vec3, Vector};
use crate::model::Model;
use crate::state::Block;

/// A rod in the plane or in space. The axes of a magnet are its tangent, up and side.
pub trait Rod: Dim {
    /// Brings the axes of the magnets up to date with the unknowns.
    fn place_axes<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>);
    /// Brings the frames of the elements up to date with their tangents.
    fn update_frames<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>);
    /// Turns the frames over a step in the lanes of a mask.
    fn rotate_frames<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, mask: I::M);
    /// Axes of a magnet at the start of a step.
    fn axes_before<I: Isa>(isa: I, block: &Block<I::Row>, body: usize) -> [Vec3<I::F>; 3];
    /// Axes of a magnet at the end of a step, once its unknowns or its frame are those there.
    fn axes_after<I: Isa>(
        isa: I,
        model: &Model,
        block: &Block<I::Row>,
        body: usize,
    ) -> [Vec3<I::F>; 3];
    /// A normal of an element with tangent t, of as many as a surface has tangents.
    fn normal<I: Isa>(
        isa: I,
        frames: Frames<'_, I::Row>,
        element: usize,
        t: Self::Vector<I::F>,
        which: usize,
    ) -> Self::Vector<I::F>;
    /// Puts the inertia of turning magnets in place of that about fixed axes.
    fn rotary_inertia<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>);
    /// Adds the springs that bend and twist.
    fn bend<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, scheme: Scheme<I::F>);
}

/// Rows of the frames of elements in space.
#[derive(Clone, Copy, Debug)]
pub struct Frames<'a, R> {
    /// Up directions and tangents.
    pub director: &'a [R],
    /// Side directions.
    pub side: &'a [R],
}

impl Rod for Plane {
    #[inline(always)]
    fn place_axes<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
        let (q, frame) = (&*block.q, &mut *block.frame);
        for (body, dof) in model.coordinates.bodies.iter().enumerate() {
            let (sin, cos) = sin_cos(isa.load(&q[dof + 2]));
            isa.store(cos, &mut frame[2 * body]);
            isa.store(sin, &mut frame[2 * body + 1]);
        }
    }
    #[inline(always)]
    fn update_frames<I: Isa>(_: I, _: &Model, _: &mut Block<I::Row>) {}
    #[inline(always)]
    fn rotate_frames<I: Isa>(_: I, _: &Model, _: &mut Block<I::Row>, _: I::M) {}
    #[inline(always)]
    fn axes_before<I: Isa>(isa: I, block: &Block<I::Row>, body: usize) -> [Vec3<I::F>; 3] {
        let [cos, sin] = Vector::<_, 2>::load(isa, &block.frame[2 * body..]).0;
        planar_axes(cos, sin)
    }
    #[inline(always)]
    fn axes_after<I: Isa>(
        isa: I,
        model: &Model,
        block: &Block<I::Row>,
        body: usize,
    ) -> [Vec3<I::F>; 3] {
        let (sin, cos) = sin_cos(isa.load(&block.q[model.coordinates.bodies[body] + 2]));
        planar_axes(cos, sin)
    }
    #[inline(always)]
    fn normal<I: Isa>(
        _: I,
        _: Frames<'_, I::Row>,
        _: usize,
        t: Vector<I::F, 2>,
        _: usize,
    ) -> Vector<I::F, 2> {
        Vector([-t[1], t[0]])
    }
    #[inline(always)]
    fn rotary_inertia<I: Isa>(_: I, _: &Model, _: &mut Block<I::Row>) {}
    #[inline(always)]
    fn bend<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, scheme: Scheme<I::F>) {
        bend::assemble(isa, model, block, scheme);
    }
}

impl Rod for Space {
    #[inline(always)]
    fn place_axes<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
        let (director, frame) = (&*block.director, &mut *block.frame);
        for (body, rigid) in model.bodies.iter().enumerate() {
            let up = Vec3::load(isa, &director[6 * rigid.element..]);
            let t = Vector::load(isa, &director[6 * rigid.element + 3..]);
            let axes = &mut frame[9 * body..][..9];
            t.store(isa, axes);
            up.store(isa, &mut axes[3..]);
            t.cross(up).store(isa, &mut axes[6..]);
        }
    }
    #[inline(always)]
    fn update_frames<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
        frames::update_frames(isa, model, block);
    }
    #[inline(always)]
    fn rotate_frames<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, mask: I::M) {
        frames::rotate_frames(isa, model, block, mask);
    }
    #[inline(always)]
    fn axes_before<I: Isa>(isa: I, block: &Block<I::Row>, body: usize) -> [Vec3<I::F>; 3] {
        frames::body_axes(isa, block, body)
    }
    #[inline(always)]
    fn axes_after<I: Isa>(
        isa: I,
        model: &Model,
        block: &Block<I::Row>,
        body: usize,
    ) -> [Vec3<I::F>; 3] {
        let frame = &block.director[6 * model.bodies[body].element..][..6];
        let (up, tangent) = (Vec3::load(isa, frame), Vec3::load(isa, &frame[3..]));
        [tangent, up, tangent.cross(up)]
    }
    #[inline(always)]
    fn normal<I: Isa>(
        isa: I,
        frames: Frames<'_, I::Row>,
        element: usize,
        _: Vec3<I::F>,
        which: usize,
    ) -> Vec3<I::F> {
        match which {
            0 => Vec3::load(isa, &frames.director[6 * element..]),
            _ => Vec3::load(isa, &frames.side[3 * element..]),
        }
    }
    #[inline(always)]
    fn rotary_inertia<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
        frames::rotary_inertia(isa, model, block);
    }
    #[inline(always)]
    fn bend<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, scheme: Scheme<I::F>) {
        twist::assemble(isa, model, block, scheme);
    }
}

/// Tangent, up and side in the plane.
#[inline(always)]
fn planar_axes<F: Real>(cos: F, sin: F) -> [Vec3<F>; 3] {
    let (zero, one) = (cos.splat(0.0), cos.splat(1.0));
    [[cos, sin, zero], [-sin, cos, zero], [zero, zero, one]].map(Vector)
}
