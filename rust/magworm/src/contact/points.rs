//! Gaps and Jacobians of the contact points.

use super::{Mode, SLOTS};
use crate::elastic::{Places, gather};
use crate::lanes::{Isa, Real};
use crate::model::{Contact, GroundLaw, Model};
use crate::state::Block;

/// Fastest a point that starts inside the ground is pushed out [m/s].
const RECOVERY_M_S: f64 = 0.1;

/// Fills Jacobians, approach velocities and first guesses of the modes of all contact points.
#[inline(always)]
pub fn detect<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    law: &GroundLaw,
    block: &mut Block<W>,
) {
    let mut rows = [[isa.splat(0.0); 9]; 2];
    for (c, contact) in model.contacts.iter().enumerate() {
        jacobians(isa, block, contact, &mut rows);
        let [normal, tangential] = &rows;
        let (v, jacobian) = (&*block.v, &mut block.jacobian[2 * SLOTS * c..]);
        let (mut u_n, mut u_t) = (isa.splat(0.0), isa.splat(0.0));
        for slot in 0..contact.stencil.count {
            let rate = isa.load(&v[contact.stencil.dofs[slot]]);
            u_n = u_n + normal[slot] * rate;
            u_t = u_t + tangential[slot] * rate;
            isa.store(normal[slot], &mut jacobian[slot]);
            isa.store(tangential[slot], &mut jacobian[SLOTS + slot]);
        }
        let approach = (gap(isa, block, contact) / model.step_s).max(isa.splat(-RECOVERY_M_S));
        isa.store(approach, &mut block.approach[c]);
        first_guess(isa, law, block, c, u_n + approach, u_t);
    }
}

/// Height of the point over the ground: y − d t_x, with d the depth below the centre line.
#[inline(always)]
fn gap<const W: usize, I: Isa<W>>(isa: I, block: &Block<W>, contact: &Contact) -> I::F {
    let sole = contact.sole;
    let y = isa.load(&block.node[2 * sole.node + 1]);
    y - isa.load(&block.tangent[2 * sole.element]) * sole.depth_m
}

/// Rows J_n, J_t over the contact's unknowns. The point p = x − d n turns with its element,
/// δn = −t δθ and δθ = n·δe/|e|, so δp = δx + (d/|e|) t (n·δe).
#[inline(always)]
fn jacobians<const W: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    contact: &Contact,
    rows: &mut [[I::F; 9]; 2],
) {
    let sole = contact.sole;
    let e = sole.element;
    let places = Places { node: &block.node, q: &block.q };
    let t = [isa.load(&block.tangent[2 * e]), isa.load(&block.tangent[2 * e + 1])];
    let lever = isa.load(&block.inverse_length[e]) * sole.depth_m;
    let own = usize::from(sole.node != e);
    let normal = rows_along(isa, t, lever * t[1], 1, own);
    let tangential = rows_along(isa, t, lever * t[0], 0, own);
    gather(isa, places, &contact.stencil, &normal, &mut rows[0]);
    gather(isa, places, &contact.stencil, &tangential, &mut rows[1]);
}

/// Gradient of one component of the point over the two nodes: the node itself, and the turn.
#[inline(always)]
fn rows_along<const W: usize, I: Isa<W>>(
    isa: I,
    t: [I::F; 2],
    turn: I::F,
    axis: usize,
    own: usize,
) -> [[I::F; 2]; 2] {
    let across = [-(t[1] * turn), t[0] * turn];
    let mut gradient = [[-across[0], -across[1]], across];
    gradient[own][axis] = gradient[own][axis] + isa.splat(1.0);
    gradient
}

/// A point that was closed, or is about to pass through the ground, starts closed; it starts
/// sticking if it is slower than v_d, else sliding on.
#[inline(always)]
fn first_guess<const W: usize, I: Isa<W>>(
    isa: I,
    law: &GroundLaw,
    block: &mut Block<W>,
    c: usize,
    u_n: I::F,
    u_t: I::F,
) {
    let zero = isa.splat(0.0);
    let before = isa.load(&block.mode[c]);
    let was_closed = !before.eq(isa.splat(Mode::OPEN));
    let closed = was_closed | u_n.lt(zero);
    let slow = u_t.abs().le(isa.splat(law.transition_speed_m_s));
    let sliding = isa.splat(Mode::SLIDE_FORWARD).copysign(u_t);
    let moving = I::F::select(slow, isa.splat(Mode::STICK), sliding);
    isa.store(I::F::select(closed, moving, isa.splat(Mode::OPEN)), &mut block.mode[c]);
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
