//! Impulses of gravity and magnets.

use crate::drive::DriveModel;
use crate::lanes::Isa;
use crate::model::{Magnetics, Model, PairModel};
use crate::state::Block;

/// Adds Δt m g to the right-hand side. Multipliers have no mass and rotations no weight.
#[inline(always)]
pub fn gravity<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let Some(gravity) = model.program.gravity_m_s2 else { return };
    for &(dof, axis) in &model.translations {
        let push = isa.load(&block.mass[dof]) * (gravity[axis] * model.step_s);
        isa.store(isa.load(&block.right[dof]) + push, &mut block.right[dof]);
    }
}

/// Adds Δt times the magnetic wrench on every body magnet.
#[inline(always)]
pub fn magnets<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let program = &model.program;
    if program.magnetics.is_none() && program.uniform_field.is_none() {
        return;
    }
    let robot = crate::step::robot_centre(isa, model, block);
    for body in 0..model.magnets() {
        let dof = model.coordinates.bodies[body];
        let mut wrench = [isa.splat(0.0); 3];
        if let (Some(magnetics), Some(drive)) = (&program.magnetics, &program.drive) {
            wrench = drive_wrench(isa, magnetics, drive, block, body, dof, robot);
        }
        if let Some(field) = &program.uniform_field {
            let [bx, by] = [isa.splat(field.field_t[0]), isa.splat(field.field_t[1])];
            let cos = isa.load(&block.frame[2 * body]);
            let sin = isa.load(&block.frame[2 * body + 1]);
            let remanence = isa.load(&block.remanence[body]);
            wrench[2] = wrench[2] + field.magnet.torque(bx, by, cos, sin, remanence);
        }
        for k in 0..3 {
            let entry = &mut block.right[dof + k];
            isa.store(isa.load(entry) + wrench[k] * model.step_s, entry);
        }
    }
}

#[inline(always)]
fn drive_wrench<const W: usize, I: Isa<W>>(
    isa: I,
    magnetics: &Magnetics,
    drive: &DriveModel,
    block: &mut Block<W>,
    body: usize,
    dof: usize,
    robot: I::F,
) -> [I::F; 3] {
    let (x, y) = (isa.load(&block.q[dof]), isa.load(&block.q[dof + 1]));
    let cos = isa.load(&block.frame[2 * body]);
    let sin = isa.load(&block.frame[2 * body + 1]);
    let (stage_x, stage_y) = (isa.load(&block.stage[0]), isa.load(&block.stage[1]));
    let remanence = isa.load(&block.remanence[body]) * magnetics.drive_remanence_t;
    let mut total = [isa.splat(0.0); 3];
    for k in 0..drive.layout.offset_m.len() {
        let dx = x - drive.layout.position(k, stage_x, robot);
        let strength = remanence * drive.layout.polarity[k];
        let wrench = match &magnetics.pair {
            PairModel::Cuboid(pair) => pair.wrench(dx, y - stage_y, cos, sin, strength),
            PairModel::Dipole(pair) => pair.wrench(dx, y - stage_y, cos, sin, strength),
        };
        for axis in 0..3 {
            total[axis] = total[axis] + wrench[axis] * magnetics.terms[axis];
        }
        block.counters.wrenches += 1;
    }
    total
}
