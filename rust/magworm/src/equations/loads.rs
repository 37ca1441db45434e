//! Impulses of gravity and magnets.

use super::{hold, off_centre};
use crate::actuator::{Actuator, Layout, states};
use crate::elastic::Rod;
use crate::lanes::math::sin_cos;
use crate::lanes::{Components, Dim, Isa, Mask, Real, Space, Vec3, Vector};
use crate::model::{Carrier, Magnetics, Model, PairModel, RigidBody};
use crate::state::Block;

/// Components of a wrench in space.
const WRENCH: usize = 6;

/// Adds Δt m g to the right-hand side. Multipliers have no mass, and only bodies off their centre have a torque of weight.
#[inline(always)]
pub fn gravity<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(gravity) = model.program.gravity_m_s2 else { return };
    let dt = model.step_s;
    let (masses, rhs) = (&*block.mass, &mut *block.rhs);
    for &(dof, axis) in &model.translations {
        let push = isa.load(&masses[dof]) * (gravity[axis] * dt);
        isa.store(isa.load(&rhs[dof]) + push, &mut rhs[dof]);
    }
    off_centre::gravity::<D, I>(isa, model, block, gravity);
}

/// Adds Δt times the magnetic wrench on every body magnet.
#[inline(always)]
pub fn magnets<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
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
    let sources = Sources::of(isa, model, block);
    block.drive_load.iter_mut().for_each(|row| isa.store(isa.splat(0.0), row));
    for (body, RigidBody { dof, magnets, .. }) in model.bodies.iter().enumerate() {
        let mut wrench = [isa.splat(0.0); WRENCH];
        if let (true, Some(magnetics), Some(sources)) = (computes, &program.magnetics, &sources) {
            for magnet in magnets.clone() {
                let own = if D::AXES == 2 {
                    planar_wrench(isa, model, magnetics, sources, block, [body, magnet])
                } else {
                    spatial_wrench(isa, model, magnetics, sources, block, [body, magnet])
                };
                (0..D::BODY).for_each(|k| wrench[k] = wrench[k] + own[k]);
            }
        }
        if let Some(due) = due {
            hold::hold::<D, I>(isa, block, body, due, &mut wrench);
        }
        for row in block.drive_load.iter_mut() {
            isa.store(isa.load(row) - wrench[1], row);
        }
        if program.uniform_field.is_some() {
            for magnet in magnets.clone() {
                uniform_torque::<D, I>(isa, model, block, [body, magnet], &mut wrench);
            }
        }
        let dt = model.step_s;
        for k in 0..D::BODY {
            let entry = &mut block.rhs[dof + k];
            isa.store(isa.load(entry) + wrench[k] * dt, entry);
        }
    }
}

/// The drive magnets of a block in a step.
#[derive(Clone, Copy)]
struct Sources<'a, I: Isa> {
    layout: &'a Layout,
    /// x of the centre of the stage's robot [m].
    robot: I::F,
    /// x, y, z of the stage [m].
    stage: Vec3<I::F>,
    /// Sine and cosine of its yaw.
    yaw: (I::F, I::F),
    /// Factor of each component of a wrench.
    terms: [I::F; WRENCH],
}

impl<'a, I: Isa> Sources<'a, I> {
    /// Those of the stage; none where a scene has none.
    #[inline(always)]
    fn of(isa: I, model: &'a Model, block: &Block<I::Row>) -> Option<Self> {
        let magnetics = model.program.magnetics.as_ref()?;
        let mut actuators = states(&model.program.actuators, &block.stage);
        let stage = |(actuator, state): (&'a Actuator, _)| Some((actuator.stage()?, state));
        let (stage, state): (_, &[I::Row]) = actuators.find_map(stage)?;
        let [x, y, z, yaw] = stage.place_in(isa.splat(0.0), |row| isa.load(&state[row]));
        let robot = block.centre_x_of_lanes(isa, model, stage.robot);
        let (layout, stage) = (&stage.layout, Vector([x, y, z]));
        let mut terms = [isa.splat(0.0); WRENCH];
        for (factor, &(term, acts)) in terms.iter_mut().zip(&magnetics.terms) {
            *factor = isa.load(&block.factors[term as usize]) * acts;
        }
        Some(Self { layout, robot, stage, yaw: sin_cos(yaw), terms })
    }
}

#[inline(always)]
fn uniform_torque<D: Rod, I: Isa>(
    isa: I,
    model: &Model,
    block: &Block<I::Row>,
    [body, magnet]: [usize; 2],
    wrench: &mut [I::F; WRENCH],
) {
    let Some(field) = &model.program.uniform_field else { return };
    let moment = model.magnets[magnet].direction.in_space(&D::axes_before(isa, block, body));
    let [x, y, z] = field.field_t;
    let field_t = Vector([isa.splat(x), isa.splat(y), isa.splat(z)]);
    let remanence = isa.load(&block.remanence[magnet]);
    let torque = field.magnets[magnet].torque(field_t, moment, remanence);
    for k in 0..D::ROTATIONS {
        // In the plane about z alone.
        wrench[D::AXES + k] = wrench[D::AXES + k] + torque[3 - D::ROTATIONS + k];
    }
}

/// (F_x, F_y, T_z) of all drive magnets on a magnet of a body, about the body's middle.
#[inline(always)]
fn planar_wrench<I: Isa>(
    isa: I,
    model: &Model,
    magnetics: &Magnetics,
    sources: &Sources<'_, I>,
    block: &mut Block<I::Row>,
    [body, target]: [usize; 2],
) -> [I::F; WRENCH] {
    let (magnet, dof) = (&model.magnets[target], model.bodies[body].dof);
    let mut total = [isa.splat(0.0); WRENCH];
    let (mut x, mut y) = (isa.load(&block.q[dof]), isa.load(&block.q[dof + 1]));
    let cos = isa.load(&block.frame[2 * body]);
    let sin = isa.load(&block.frame[2 * body + 1]);
    let arm = magnet.offset_m.map(|[a, u, _]| [cos * a - sin * u, sin * a + cos * u]);
    if let Some(arm) = arm {
        (x, y) = (x + arm[0], y + arm[1]);
    }
    let Sources { layout, robot, stage: Vector([stage_x, stage_y, _]), terms, .. } = *sources;
    let remanence = isa.load(&block.remanence[target]);
    for pair in &magnetics.pairs[target] {
        let source = &model.magnets[pair.source];
        let Carrier::Actuator { magnet: which, .. } = source.on else { continue };
        let dx = x - layout.position(which, stage_x, robot);
        let strength = remanence * source.remanence_t;
        let wrench = match &magnetics.models[pair.model] {
            PairModel::Cuboid(pair) => pair.wrench(dx, y - stage_y, cos, sin, strength),
            PairModel::ObliqueCuboid(pair) => pair.wrench(dx, y - stage_y, cos, sin, strength),
            PairModel::Dipole(pair) => {
                let [cos, sin] = magnet.direction.frame(cos, sin);
                pair.wrench(dx, y - stage_y, cos, sin, strength)
            }
            PairModel::SpatialCuboid(_) | PairModel::SpatialDipole(_) => continue,
        };
        for axis in 0..3 {
            total[axis] = total[axis] + wrench[axis] * terms[axis];
        }
        block.counters.wrenches += 1;
    }
    if let Some([x, y]) = arm {
        total[2] = total[2] + (x * total[1] - y * total[0]);
    }
    total
}

/// Force and torque of all drive magnets on a magnet of a body, about the body's middle; they stand turned about the vertical
/// by the stage's yaw.
#[inline(always)]
fn spatial_wrench<I: Isa>(
    isa: I,
    model: &Model,
    magnetics: &Magnetics,
    sources: &Sources<'_, I>,
    block: &mut Block<I::Row>,
    [body, target]: [usize; 2],
) -> [I::F; WRENCH] {
    let Sources { layout, robot, stage, yaw: (sin, cos), terms } = *sources;
    let (magnet, dof) = (&model.magnets[target], model.bodies[body].dof);
    let mut total = [isa.splat(0.0); WRENCH];
    let remanence = isa.load(&block.remanence[target]);
    let [tangent, up, side] = Space::axes_before(isa, block, body);
    let arm = magnet
        .offset_m
        .map(|offset_m| Space::to_world(Vector::load(isa, &block.frame[9 * body..]), offset_m));
    let mut place = Vec3::load(isa, &block.q[dof..]);
    if let Some(arm) = arm {
        place = place + arm;
    }
    let axes = [turned(tangent, cos, -sin), turned(up, cos, -sin), turned(side, cos, -sin)];
    for pair in &magnetics.pairs[target] {
        let source = &model.magnets[pair.source];
        let Carrier::Actuator { magnet: which, .. } = source.on else { continue };
        let [x, z] = layout.place(which, stage[0], stage[2], robot, sin, cos);
        let offset = turned(place - Vector([x, stage[1], z]), cos, -sin);
        let wrench = match &magnetics.models[pair.model] {
            PairModel::SpatialCuboid(pair) => {
                pair.wrench(offset.0, [axes[0].0, axes[1].0, axes[2].0])
            }
            PairModel::SpatialDipole(pair) => {
                pair.wrench(&offset.0, &magnet.direction.in_space(&axes).0)
            }
            PairModel::Cuboid(_) | PairModel::ObliqueCuboid(_) | PairModel::Dipole(_) => continue,
        };
        let [fx, fy, fz, tx, ty, tz] = wrench;
        let strength = remanence * source.remanence_t;
        let force = turned(Vector([fx, fy, fz]), cos, sin);
        let torque = turned(Vector([tx, ty, tz]), cos, sin);
        for axis in 0..3 {
            total[axis] = total[axis] + force[axis] * strength * terms[axis];
            total[3 + axis] = total[3 + axis] + torque[axis] * strength * terms[3 + axis];
        }
        block.counters.wrenches += 1;
    }
    if let Some(arm) = arm {
        let moment = arm.cross(Vector([total[0], total[1], total[2]]));
        (0..3).for_each(|k| total[3 + k] = total[3 + k] + moment[k]);
    }
    total
}

/// A vector turned about the vertical, anticlockwise seen from above: x goes towards −z.
#[inline(always)]
fn turned<F: Real>(a: Vec3<F>, cos: F, sin: F) -> Vec3<F> {
    Vector([a[0] * cos + a[2] * sin, a[1], a[2] * cos - a[0] * sin])
}
