//! Forces on body magnets, as a step takes them.

use crate::lanes::{Number, Row, Scalar};
use crate::model::{Model, Phase};
use crate::reset::apply_parameters;
use crate::state::Block;
use crate::step::run_phase;

/// Force [N] and torque about its middle [N·m] of drive, field and other magnets on each body of one lane, as the next step takes them:
/// (F_x, F_y, T_z) in the plane, (F_x, F_y, F_z, T_x, T_y, T_z) in space. They come from the phases of a step, run on a copy of
/// the lane.
pub(super) fn magnet_wrenches<R: Row>(model: &Model, block: &Block<R>, lane: usize) -> Vec<f64> {
    let mut copy = Block::<[f64; 1]>::new(model);
    for (rows, from) in copy.state_rows_mut().into_iter().zip(block.state_rows()) {
        rows.iter_mut().zip(from.iter()).for_each(|(row, from)| row[0] = from[lane].f64());
    }
    copy.step_count[0] = block.step_count[lane];
    copy.status[0] = block.status[lane];
    apply_parameters(model, &mut copy, 0);
    run_phase(Scalar, model, &mut copy, Phase::Kinematics);
    copy.rhs.iter_mut().for_each(|row| row[0] = 0.0);
    for phase in [Phase::Magnets, Phase::Mutual] {
        run_phase(Scalar, model, &mut copy, phase);
    }
    let size = model.sizes().body();
    let impulses = model.coordinates.bodies.iter().flat_map(|&dof| &copy.rhs[dof..dof + size]);
    impulses.map(|impulse| impulse[0] / model.step_s).collect()
}
