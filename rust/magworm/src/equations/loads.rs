//! Impulses of gravity and magnets.

use super::hold;
use crate::actuator::{Actuator, Layout, states};
use crate::elastic;
use crate::lanes::math::sin_cos;
use crate::lanes::{Isa, Mask, Real};
use crate::model::{Magnetics, Model, PairModel, body_size};
use crate::state::Block;

/// Components of a wrench in space.
const WRENCH: usize = 6;

/// Adds Δt m g to the right-hand side. Multipliers have no mass and rotations no weight.
#[inline(always)]
pub fn gravity<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(gravity) = model.program.gravity_m_s2 else { return };
    let dt = model.step_s;
    let (masses, right) = (&*block.mass, &mut *block.right);
    for &(dof, axis) in &model.translations {
        let push = isa.load(&masses[dof]) * (gravity[axis] * dt);
        isa.store(isa.load(&right[dof]) + push, &mut right[dof]);
    }
}

/// Adds Δt times the magnetic wrench on every body magnet.
#[inline(always)]
pub fn magnets<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let program = &model.program;
    if program.magnetics.is_none() && program.uniform_field.is_none() {
        return;
    }
    let interval = program.magnetics.as_ref().map_or(1, |magnetics| magnetics.interval);
    let due = if interval > 1 { Some(hold::due(isa, block, interval)) } else { None };
    let computes = match due {
        Some(due) => due.any(),
        None => true,
    };
    let sources = Sources::of::<D>(isa, model, block);
    for body in 0..model.magnets() {
        let dof = model.coordinates.bodies[body];
        let mut wrench = [isa.splat(0.0); WRENCH];
        if let (true, Some(magnetics), Some(sources)) = (computes, &program.magnetics, &sources) {
            if D == 2 {
                planar_wrench(isa, magnetics, sources, block, [body, dof], &mut wrench);
            } else {
                spatial_wrench(isa, magnetics, sources, block, [body, dof], &mut wrench);
            }
        }
        if let Some(due) = due {
            hold::hold::<D, I>(isa, block, body, due, &mut wrench);
        }
        if program.uniform_field.is_some() {
            uniform_torque::<D, I>(isa, model, block, body, &mut wrench);
        }
        let dt = model.step_s;
        for k in 0..body_size(D) {
            let entry = &mut block.right[dof + k];
            isa.store(isa.load(entry) + wrench[k] * dt, entry);
        }
    }
}

/// The drive magnets of a block in a step.
#[derive(Clone, Copy)]
struct Sources<'a, I: Isa> {
    layout: &'a Layout,
    /// x of the robot's centre [m].
    robot: I::F,
    /// x, y, in space z of the stage [m].
    stage: [I::F; 3],
    /// Sine and cosine of its yaw in space.
    yaw: (I::F, I::F),
}

impl<'a, I: Isa> Sources<'a, I> {
    /// Those of the stage; none where a scene has none.
    #[inline(always)]
    fn of<const D: usize>(isa: I, model: &'a Model, block: &Block<I::Row>) -> Option<Self> {
        let mut actuators = states(&model.program.actuators, &block.stage);
        let stage = |(actuator, state): (&'a Actuator, _)| Some((actuator.stage()?, state));
        let (stage, state): (_, &[I::Row]) = actuators.find_map(stage)?;
        let at = |row: usize| isa.load(&state[row]);
        let zero = isa.splat(0.0);
        let yaw = if D == 3 { sin_cos(at(3)) } else { (zero, zero) };
        let z = if D == 3 { at(2) } else { zero };
        let robot = block.centre_x_of_lanes(isa, model);
        Some(Self { layout: &stage.layout, robot, stage: [at(0), at(1), z], yaw })
    }
}

#[inline(always)]
fn uniform_torque<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    block: &Block<I::Row>,
    body: usize,
    wrench: &mut [I::F; WRENCH],
) {
    let Some(field) = &model.program.uniform_field else { return };
    let [bx, by, bz] =
        [isa.splat(field.field_t[0]), isa.splat(field.field_t[1]), isa.splat(field.field_t[2])];
    let remanence = isa.load(&block.remanence[body]);
    if D == 2 {
        let cos = isa.load(&block.frame[2 * body]);
        let sin = isa.load(&block.frame[2 * body + 1]);
        wrench[2] = wrench[2] + field.magnets[body].torque(bx, by, cos, sin, remanence);
    } else {
        let [_, up, _] = elastic::axes(isa, block, body);
        let torque = field.magnets[body].torque_in_space([bx, by, bz], &up, remanence);
        for k in 0..3 {
            wrench[3 + k] = wrench[3 + k] + torque[k];
        }
    }
}

/// (F_x, F_y, T_z) of all drive magnets.
#[inline(always)]
fn planar_wrench<I: Isa>(
    isa: I,
    magnetics: &Magnetics,
    sources: &Sources<'_, I>,
    block: &mut Block<I::Row>,
    [body, dof]: [usize; 2],
    total: &mut [I::F; WRENCH],
) {
    let (x, y) = (isa.load(&block.q[dof]), isa.load(&block.q[dof + 1]));
    let cos = isa.load(&block.frame[2 * body]);
    let sin = isa.load(&block.frame[2 * body + 1]);
    let Sources { layout, robot, stage: [stage_x, stage_y, _], .. } = *sources;
    let remanence = isa.load(&block.remanence[body]) * magnetics.drive_remanence_t;
    for pair in &magnetics.pairs[body] {
        let dx = x - layout.position(pair.source, stage_x, robot);
        let strength = remanence * layout.polarity[pair.source];
        let wrench = match &magnetics.models[pair.model] {
            PairModel::Cuboid(pair) => pair.wrench(dx, y - stage_y, cos, sin, strength),
            PairModel::Dipole(pair) => pair.wrench(dx, y - stage_y, cos, sin, strength),
            PairModel::SpatialCuboid(_) | PairModel::SpatialDipole(_) => continue,
        };
        for axis in 0..3 {
            total[axis] = total[axis] + wrench[axis] * magnetics.terms[axis];
        }
        block.counters.wrenches += 1;
    }
}

/// Force and torque of all drive magnets, which stand turned about the vertical by the stage's yaw.
#[inline(always)]
fn spatial_wrench<I: Isa>(
    isa: I,
    magnetics: &Magnetics,
    sources: &Sources<'_, I>,
    block: &mut Block<I::Row>,
    [body, dof]: [usize; 2],
    total: &mut [I::F; WRENCH],
) {
    let Sources { layout, robot, stage, yaw: (sin, cos) } = *sources;
    let remanence = isa.load(&block.remanence[body]) * magnetics.drive_remanence_t;
    let mut axes = elastic::axes(isa, block, body);
    for k in 0..3 {
        axes[k] = turned(&axes[k], cos, -sin);
    }
    for pair in &magnetics.pairs[body] {
        let [x, z] = layout.place(pair.source, stage[0], stage[2], robot, sin, cos);
        let offset = [
            isa.load(&block.q[dof]) - x,
            isa.load(&block.q[dof + 1]) - stage[1],
            isa.load(&block.q[dof + 2]) - z,
        ];
        let offset = turned(&offset, cos, -sin);
        let wrench = match &magnetics.models[pair.model] {
            PairModel::SpatialCuboid(pair) => pair.wrench(offset, axes),
            PairModel::SpatialDipole(pair) => pair.wrench(&offset, &axes[1]),
            PairModel::Cuboid(_) | PairModel::Dipole(_) => continue,
        };
        let strength = remanence * layout.polarity[pair.source];
        let force = turned(&[wrench[0], wrench[1], wrench[2]], cos, sin);
        let torque = turned(&[wrench[3], wrench[4], wrench[5]], cos, sin);
        for axis in 0..3 {
            total[axis] = total[axis] + force[axis] * strength * magnetics.terms[axis];
            total[3 + axis] = total[3 + axis] + torque[axis] * strength * magnetics.terms[3 + axis];
        }
        block.counters.wrenches += 1;
    }
}

/// A vector turned about the vertical, anticlockwise seen from above: x goes towards −z.
#[inline(always)]
fn turned<F: Real>(a: &[F; 3], cos: F, sin: F) -> [F; 3] {
    [a[0] * cos + a[2] * sin, a[1], a[2] * cos - a[0] * sin]
}
