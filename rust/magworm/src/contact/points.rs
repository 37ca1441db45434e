//! Gaps and Jacobians of the contact points.

use super::{Mode, SLOTS};
use crate::elastic::gather;
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
    for (c, contact) in model.contacts.iter().enumerate() {
        let [normal, tangential] = jacobians(isa, model, block, contact);
        let (mut u_n, mut u_t) = (isa.splat(0.0), isa.splat(0.0));
        for slot in 0..contact.stencil.count {
            let v = isa.load(&block.v[contact.stencil.dofs[slot]]);
            u_n = u_n + normal[slot] * v;
            u_t = u_t + tangential[slot] * v;
            isa.store(normal[slot], &mut block.jacobian[2 * SLOTS * c + slot]);
            isa.store(tangential[slot], &mut block.jacobian[2 * SLOTS * c + SLOTS + slot]);
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
    isa.load(&block.node[2 * sole.node + 1])
        - isa.load(&block.tangent[2 * sole.element]) * sole.depth_m
}

/// Rows J_n, J_t over the contact's unknowns. The point p = x − d n turns with its element,
/// δn = −t δθ and δθ = n·δe/|e|, so δp = δx + (d/|e|) t (n·δe).
#[inline(always)]
fn jacobians<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    block: &Block<W>,
    contact: &Contact,
) -> [[I::F; 9]; 2] {
    let sole = contact.sole;
    let e = sole.element;
    let t = [isa.load(&block.tangent[2 * e]), isa.load(&block.tangent[2 * e + 1])];
    let lever = isa.load(&block.inverse_length[e]) * sole.depth_m;
    let at_head = sole.node == e;
    [1, 0].map(|axis| {
        let turn = lever * t[axis];
        let across = [-(t[1] * turn), t[0] * turn];
        let mut gradient = [across.map(|x| -x), across];
        let own = &mut gradient[usize::from(!at_head)][axis];
        *own = *own + 1.0;
        gather(isa, model, block, &contact.stencil, gradient)
    })
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
    let moving =
        I::F::select(slow, isa.splat(Mode::STICK), isa.splat(Mode::SLIDE_FORWARD).copysign(u_t));
    isa.store(I::F::select(closed, moving, isa.splat(Mode::OPEN)), &mut block.mode[c]);
    let stuck = before.eq(isa.splat(Mode::STICK));
    let normal = I::F::select(was_closed, isa.load(&block.normal[c]), zero);
    let tangential = I::F::select(stuck, isa.load(&block.tangential[c]), zero);
    isa.store(normal, &mut block.warm[2 * c]);
    isa.store(tangential, &mut block.warm[2 * c + 1]);
    isa.store(normal, &mut block.reckoned[c]);
}
