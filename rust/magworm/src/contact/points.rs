//! Gaps and Jacobians of the contact points.

use super::{Ground, Mode, SLOTS};
use crate::lanes::{Isa, Real};
use crate::model::{Contact, Model, Sole};
use crate::state::Block;

/// Fastest a point that starts inside the ground is pushed out [m/s].
const RECOVERY_M_S: f64 = 0.1;

/// Fills Jacobians, approach velocities and first guesses of the modes of all contact points.
#[inline(always)]
pub fn detect<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    for (c, contact) in model.contacts.iter().enumerate() {
        let point = match contact.sole {
            Sole::Foot { body, along_m, depth_m } => {
                foot(isa, block, body, contact.stencil.dofs[0], along_m, depth_m)
            }
            Sole::Node { node, depth_m } => below_node(isa, block, contact, node, depth_m),
        };
        let (v, jacobian) = (&*block.v, &mut block.jacobian[2 * SLOTS * c..]);
        let (mut u_n, mut u_t) = (isa.splat(0.0), isa.splat(0.0));
        for slot in 0..contact.stencil.count {
            let rate = isa.load(&v[contact.stencil.dofs[slot]]);
            u_n = u_n + point.normal[slot] * rate;
            u_t = u_t + point.tangential[slot] * rate;
            isa.store(point.normal[slot], &mut jacobian[slot]);
            isa.store(point.tangential[slot], &mut jacobian[SLOTS + slot]);
        }
        let approach = (point.gap / model.step_s).max(isa.splat(-RECOVERY_M_S));
        isa.store(approach, &mut block.approach[c]);
        first_guess(isa, ground, block, c, u_n + approach, u_t);
    }
}

/// A contact point: its height over the ground, and how its velocity hangs on its unknowns.
struct Point<F> {
    gap: F,
    normal: [F; SLOTS],
    tangential: [F; SLOTS],
}

/// Toe or heel at (s, −d) in the magnet's frame: p = X + s t − d n with t = (cos θ, sin θ), n = ẑ × t, so
/// ∂p_y/∂θ = s cos θ + d sin θ and ∂p_x/∂θ = −s sin θ + d cos θ.
#[inline(always)]
fn foot<const W: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    body: usize,
    dof: usize,
    along_m: f64,
    depth_m: f64,
) -> Point<I::F> {
    let (zero, one) = (isa.splat(0.0), isa.splat(1.0));
    let cos = isa.load(&block.frame[2 * body]);
    let sin = isa.load(&block.frame[2 * body + 1]);
    Point {
        gap: isa.load(&block.q[dof + 1]) + sin * along_m - cos * depth_m,
        normal: [zero, one, cos * along_m + sin * depth_m],
        tangential: [one, zero, cos * depth_m - sin * along_m],
    }
}

/// A point straight below a node; where the node is the end of a magnet, it turns about its centre.
#[inline(always)]
fn below_node<const W: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    contact: &Contact,
    node: usize,
    depth_m: f64,
) -> Point<I::F> {
    let (zero, one) = (isa.splat(0.0), isa.splat(1.0));
    let (x, y) = (isa.load(&block.node[2 * node]), isa.load(&block.node[2 * node + 1]));
    let mut point =
        Point { gap: y - depth_m, normal: [zero, one, zero], tangential: [one, zero, zero] };
    if contact.stencil.body[0].is_some() {
        let dof = contact.stencil.body_dofs[0];
        point.normal[2] = x - isa.load(&block.q[dof]);
        point.tangential[2] = isa.load(&block.q[dof + 1]) - y;
    }
    point
}

/// A point that was closed, or is about to pass through the ground, starts closed. Its speed at the start
/// of the step decides: up to v_d it starts sticking and μ_s holds for the step, beyond it slides on
/// against μ_d. One coefficient per step keeps the law monotone, and its limit for small steps is the
/// paper's.
#[inline(always)]
fn first_guess<const W: usize, I: Isa<W>>(
    isa: I,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    c: usize,
    u_n: I::F,
    u_t: I::F,
) {
    let zero = isa.splat(0.0);
    let before = isa.load(&block.mode[c]);
    let was_closed = !before.eq(isa.splat(Mode::OPEN));
    let closed = was_closed | u_n.lt(zero);
    let slow = u_t.abs().le(ground.transition_speed);
    let sliding = isa.splat(Mode::SLIDE_FORWARD).copysign(u_t);
    // One that slid goes on until its velocity reverses: a guess that it sticks would ask for its whole
    // momentum within one step, which no friction has.
    let slid = before.abs().eq(isa.splat(Mode::SLIDE_FORWARD));
    let moving = I::F::select(slow & !slid, isa.splat(Mode::STICK), sliding);
    let guess = I::F::select(closed, moving, isa.splat(Mode::OPEN));
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    isa.store(I::F::select(running, guess, before), &mut block.mode[c]);
    let coefficient = I::F::select(slow, ground.static_friction, ground.dynamic_friction);
    isa.store(coefficient, &mut block.coefficient[c]);
    let stuck = before.eq(isa.splat(Mode::STICK));
    let normal = I::F::select(was_closed, isa.load(&block.normal[c]), zero);
    let tangential = I::F::select(stuck, isa.load(&block.tangential[c]), zero);
    isa.store(normal, &mut block.warm[2 * c]);
    isa.store(tangential, &mut block.warm[2 * c + 1]);
    isa.store(normal, &mut block.reckoned[c]);
    // No pass before the first: nothing to extrapolate from.
    isa.store(normal, &mut block.earlier[2 * c]);
    isa.store(normal, &mut block.earlier[2 * c + 1]);
}
