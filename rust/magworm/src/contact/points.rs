//! Gaps and Jacobians of the contact points.

use super::guess::first_guess;
use super::{Ground, MOST_DIRECTIONS, SLOTS, jacobian_rows};
use crate::elastic::{axes, cross};
use crate::lanes::{Isa, Real};
use crate::model::{Contact, Model, Sole, body_size};
use crate::state::Block;

/// Fastest a point that starts inside the ground is pushed out [m/s].
const RECOVERY_M_S: f64 = 0.1;

/// Fills Jacobians, approach velocities and first guesses of the modes of all contact points.
pub fn detect<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    isa.vectorize(
        #[inline(always)]
        || detect_all::<W, D, I>(isa, model, ground, block),
    );
}

#[inline(always)]
fn detect_all<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
) {
    let zero = isa.splat(0.0);
    for (c, contact) in model.contacts.iter().enumerate() {
        let mut point = Point { gap: zero, directions: [[zero; SLOTS]; MOST_DIRECTIONS] };
        match contact.sole {
            Sole::Foot { body, along_m, depth_m, across_m } => {
                let dof = contact.stencil.dofs[0];
                if D == 2 {
                    foot(isa, block, body, dof, [along_m, depth_m], &mut point);
                } else {
                    corner(isa, block, body, dof, [along_m, -depth_m, across_m], &mut point);
                }
            }
            Sole::Node { node, depth_m } => {
                below_node::<W, D, I>(isa, block, contact, node, depth_m, &mut point);
            }
        }
        let (v, jacobian) = (&*block.v, &mut block.jacobian[jacobian_rows(D) * c..]);
        let mut u = [zero; MOST_DIRECTIONS];
        for direction in 0..D {
            for slot in 0..contact.stencil.count {
                let rate = isa.load(&v[contact.stencil.dofs[slot]]);
                u[direction] = u[direction] + point.directions[direction][slot] * rate;
                let entry = &mut jacobian[body_size(D) * direction + slot];
                isa.store(point.directions[direction][slot], entry);
            }
        }
        let approach = (point.gap / block.dt_s).max(isa.splat(-RECOVERY_M_S));
        isa.store(approach, &mut block.approach[c]);
        first_guess::<W, D, I>(isa, ground, block, c, u[0] + approach, [u[1], u[2]]);
    }
}

/// A contact point: its height over the ground, and how its velocity upwards, along x and along z hangs on
/// its unknowns.
struct Point<F> {
    gap: F,
    directions: [[F; SLOTS]; MOST_DIRECTIONS],
}

/// Toe or heel in the plane at (s, −d) in the magnet's frame: p = X + s t − d n with t = (cos θ, sin θ),
/// n = ẑ × t, so ∂p_y/∂θ = s cos θ + d sin θ and ∂p_x/∂θ = −s sin θ + d cos θ.
#[inline(always)]
fn foot<const W: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    body: usize,
    dof: usize,
    [along_m, depth_m]: [f64; 2],
    point: &mut Point<I::F>,
) {
    let one = isa.splat(1.0);
    let cos = isa.load(&block.frame[2 * body]);
    let sin = isa.load(&block.frame[2 * body + 1]);
    point.gap = isa.load(&block.q[dof + 1]) + sin * along_m - cos * depth_m;
    point.directions[0][1] = one;
    point.directions[0][2] = cos * along_m + sin * depth_m;
    point.directions[1][0] = one;
    point.directions[1][2] = cos * depth_m - sin * along_m;
}

/// Corner of a foot in space at r = Σ places · axes from its magnet.
#[inline(always)]
fn corner<const W: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    body: usize,
    dof: usize,
    places_m: [f64; 3],
    point: &mut Point<I::F>,
) {
    let frame = axes(isa, block, body);
    let mut r = [isa.splat(0.0); 3];
    for axis in 0..3 {
        r[axis] = frame[0][axis] * places_m[0]
            + frame[1][axis] * places_m[1]
            + frame[2][axis] * places_m[2];
    }
    point.gap = isa.load(&block.q[dof + 1]) + r[1];
    lever(isa, &r, point);
}

/// Directions of a point at arm r from a magnet: its velocity along a is a·(V + ω × r) = a·V + (r × a)·ω.
#[inline(always)]
fn lever<const W: usize, I: Isa<W>>(isa: I, r: &[I::F; 3], point: &mut Point<I::F>) {
    for (direction, axis) in [(0, 1), (1, 0), (2, 2)] {
        let mut a = [isa.splat(0.0); 3];
        a[axis] = isa.splat(1.0);
        let turn = cross(r, &a);
        point.directions[direction][..3].copy_from_slice(&a);
        point.directions[direction][3..].copy_from_slice(&turn);
    }
}

/// A point straight below a node; where the node is the end of a magnet, it turns about its centre.
#[inline(always)]
fn below_node<const W: usize, const D: usize, I: Isa<W>>(
    isa: I,
    block: &Block<W>,
    contact: &Contact,
    node: usize,
    depth_m: f64,
    point: &mut Point<I::F>,
) {
    let one = isa.splat(1.0);
    let y = isa.load(&block.node[D * node + 1]);
    point.gap = y - depth_m;
    for (direction, axis) in [(0, 1), (1, 0), (2, 2)].into_iter().take(D) {
        point.directions[direction][axis] = one;
    }
    if contact.stencil.body[0].is_none() {
        return;
    }
    let dof = contact.stencil.body_dofs[0];
    let x = isa.load(&block.node[D * node]);
    let arm_x = x - isa.load(&block.q[dof]);
    if D == 2 {
        point.directions[0][2] = arm_x;
        point.directions[1][2] = isa.load(&block.q[dof + 1]) - y;
    } else {
        let z = isa.load(&block.node[D * node + D - 1]);
        let arm_z = z - isa.load(&block.q[dof + D - 1]);
        lever(isa, &[arm_x, y - isa.load(&block.q[dof + 1]), arm_z], point);
    }
}
