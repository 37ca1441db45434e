//! Impulses of body magnets on each other, see [`crate::model::Mutual`].
//!
//! With d from the source to the target, force F and torque T on the target come from the pair at their distance; its body feels
//! them about its middle, and the body of the source F' = −F and T' = −T − D × F, D from its middle to that of the other.

use super::off_centre::{along, world};
use crate::elastic::Rod;
use crate::lanes::{Components, Isa, Mask, Plane, Real, Space, Vec3, Vector};
use crate::magnetic::reaction;
use crate::model::{Model, PairByDistance, PairModel};
use crate::scene::Parameter;
use crate::state::Block;

/// Two cuboids that bodies carry, in the plane or in space.
pub trait Cuboids: Rod {
    /// Force and torque on the target along x, y, z. `offset`: from the source; `frames`: of the bodies of both.
    fn wrench<F: Real>(
        model: &PairModel,
        offset: Self::Vector<F>,
        frames: [Self::Frame<F>; 2],
        strength: F,
    ) -> (Self::Vector<F>, Self::Angular<F>);
}

/// Adds Δt times the wrenches of body magnets on each other.
#[inline(always)]
pub fn mutual<D: Cuboids, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(mutual) = &model.program.mutual else { return };
    let factor = isa.load(&block.factors[Parameter::Mutual as usize]);
    for pair in &mutual.pairs {
        let source = Placed::<D, I>::of(isa, model, block, pair.source);
        let target = Placed::<D, I>::of(isa, model, block, pair.target);
        let strength = source.remanence * target.remanence * (factor * pair.share);
        let (force, torque) =
            wrench::<D, I>(isa, &mutual.kinds[pair.kind], [&source, &target], strength);
        let on_target = (force, torque + D::torque(target.arm, force));
        let on_source = reaction::<D, I::F>(target.middle - source.middle, on_target);
        push::<D, I>(isa, model.step_s, block, target.dof, on_target);
        push::<D, I>(isa, model.step_s, block, source.dof, on_source);
    }
    block.counters.wrenches += mutual.pairs.len() as u64;
}

/// A magnet of a body in a step.
struct Placed<D: Rod, I: Isa> {
    /// First unknown of its body.
    dof: usize,
    /// Middle and frame of its body.
    middle: D::Vector<I::F>,
    frame: D::Frame<I::F>,
    /// From there to its centre, and its direction.
    arm: D::Vector<I::F>,
    direction: D::Vector<I::F>,
    remanence: I::F,
}

impl<D: Rod, I: Isa> Placed<D, I> {
    #[inline(always)]
    fn of(isa: I, model: &Model, block: &Block<I::Row>, magnet: usize) -> Self {
        let held = &model.magnets[magnet];
        let body = model.mesh.magnets[magnet].body;
        let dof = model.bodies[body].dof;
        let frame = D::Frame::load(isa, &block.frame[D::Frame::<I::F>::COUNT * body..]);
        let arm = match held.offset_m {
            Some(offset_m) => D::to_world(frame, offset_m),
            None => D::Vector::splat(isa.splat(0.0)),
        };
        Self {
            dof,
            middle: D::Vector::load(isa, &block.q[dof..]),
            frame,
            arm,
            direction: D::to_world(frame, held.direction.vector()),
            remanence: isa.load(&block.remanence[magnet]),
        }
    }
}

/// Force and torque on the target about its centre. What a pair is depends on the distance in each lane alone, so that bits do
/// not depend on other lanes; what no lane needs is left out.
#[inline(always)]
fn wrench<D: Cuboids, I: Isa>(
    isa: I,
    kind: &PairByDistance,
    [source, target]: [&Placed<D, I>; 2],
    strength: I::F,
) -> (D::Vector<I::F>, D::Angular<I::F>) {
    let offset = (target.middle + target.arm) - (source.middle + source.arm);
    let square = offset.norm_squared();
    let mut force = D::Vector::splat(isa.splat(0.0));
    let mut torque = D::Angular::splat(isa.splat(0.0));
    for near in &kind.near {
        let [least_m2, beyond_m2] = near.range_m2;
        let here = square.ge(isa.splat(least_m2)) & square.lt(isa.splat(beyond_m2));
        if here.any() {
            let frames = [source.frame, target.frame];
            let (f, t) = D::wrench(&near.model, offset, frames, strength);
            force = D::Vector::select(here, f, force);
            torque = D::Angular::select(here, t, torque);
        }
    }
    let far = square.ge(isa.splat(kind.far_m2));
    if far.any() {
        let (a, b) = (source.direction, target.direction);
        let (f, t) = kind.far.wrench::<D, I::F>(offset, a, b, strength);
        force = D::Vector::select(far, f, force);
        torque = D::Angular::select(far, t, torque);
    }
    (force, torque)
}

/// Adds Δt times a wrench to the right-hand side of a body.
#[inline(always)]
fn push<D: Rod, I: Isa>(
    isa: I,
    step_s: f64,
    block: &mut Block<I::Row>,
    dof: usize,
    (force, torque): (D::Vector<I::F>, D::Angular<I::F>),
) {
    let rhs = &mut block.rhs[dof..][..D::BODY];
    for k in 0..D::AXES {
        isa.store(isa.load(&rhs[k]) + force[k] * step_s, &mut rhs[k]);
    }
    for k in 0..D::ROTATIONS {
        let row = &mut rhs[D::AXES + k];
        isa.store(isa.load(row) + torque[k] * step_s, row);
    }
}

impl Cuboids for Plane {
    #[inline(always)]
    fn wrench<F: Real>(
        model: &PairModel,
        Vector([dx, dy]): Vector<F, 2>,
        [Vector([c, s]), Vector([other_c, other_s])]: [Vector<F, 2>; 2],
        strength: F,
    ) -> (Vector<F, 2>, Vector<F, 1>) {
        let (x, y) = (c * dx + s * dy, c * dy - s * dx);
        let (cos, sin) = (c * other_c + s * other_s, c * other_s - s * other_c);
        let [fx, fy, torque] = match model {
            PairModel::Cuboid(pair) => pair.wrench(x, y, cos, sin, strength),
            PairModel::ObliqueCuboid(pair) => pair.wrench(x, y, cos, sin, strength),
            _ => [strength.splat(0.0); 3],
        };
        (Vector([c * fx - s * fy, s * fx + c * fy]), Vector([torque]))
    }
}

impl Cuboids for Space {
    #[inline(always)]
    fn wrench<F: Real>(
        model: &PairModel,
        offset: Vec3<F>,
        [source, target]: [Vector<F, 9>; 2],
        strength: F,
    ) -> (Vec3<F>, Vec3<F>) {
        let (source, [tangent, up, side]) = (axes(source), axes(target));
        let [fx, fy, fz, tx, ty, tz] = match model {
            PairModel::SpatialCuboid(pair) => {
                let turned =
                    [along(&source, tangent).0, along(&source, up).0, along(&source, side).0];
                pair.wrench(along(&source, offset).0, turned)
            }
            _ => [strength.splat(0.0); 6],
        };
        let (force, torque) = (Vector([fx, fy, fz]), Vector([tx, ty, tz]));
        (world(&source, force) * strength, world(&source, torque) * strength)
    }
}

/// Tangent, up and side of a frame.
#[inline(always)]
fn axes<F: Real>(Vector([a, b, c, d, e, f, g, h, i]): Vector<F, 9>) -> [Vec3<F>; 3] {
    [Vector([a, b, c]), Vector([d, e, f]), Vector([g, h, i])]
}
