//! Forces on body magnets, as a step takes them.

use super::snapshot::{read_lane, write_lane};
use crate::lanes::{Row, Scalar};
use crate::model::{Model, Phase, body_size};
use crate::state::Block;
use crate::step::run_phase;

/// Force [N] and torque about its middle [N·m] of drive and field on each body of one lane, as the next step takes them:
/// (F_x, F_y, T_z) in the plane, (F_x, F_y, F_z, T_x, T_y, T_z) in space. They come from the phases of a step, run on a copy of
/// the lane.
pub(super) fn magnet_wrenches<R: Row>(model: &Model, block: &Block<R>, lane: usize) -> Vec<f64> {
    let mut state = Vec::new();
    write_lane(block, lane, &mut state);
    let mut copy = Block::<[f64; 1]>::new(model);
    read_lane(model, &mut copy, 0, &state);
    run_phase(Scalar, model, &mut copy, Phase::Kinematics);
    copy.right.iter_mut().for_each(|row| row[0] = 0.0);
    run_phase(Scalar, model, &mut copy, Phase::Magnets);
    let size = body_size(model.dimensions());
    let impulses = model.coordinates.bodies.iter().flat_map(|&dof| &copy.right[dof..dof + size]);
    impulses.map(|impulse| impulse[0] / model.step_s).collect()
}
