//! Gaps and velocities of the contact points.

use super::{Ground, Mode, Vector, load_vector, store_vector};
use crate::elastic::{axes, cross};
use crate::lanes::{Isa, Real};
use crate::model::{Contact, Model, Sole, body_size};
use crate::state::Block;

/// Fastest a point that starts inside the ground is pushed out [m/s].
const RECOVERY_M_S: f64 = 0.1;

/// Fills arms and approach velocities of all contact points, and which of them touch.
pub fn detect<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(law) = &model.program.ground else { return };
    isa.vectorize(
        #[inline(always)]
        || {
            let ground = Ground::of(isa, law, model.step_s, block);
            for (c, contact) in model.contacts.iter().enumerate() {
                detect_point::<D, I>(isa, &ground, block, c, contact, model.step_s);
            }
        },
    );
}

#[inline(always)]
fn detect_point<const D: usize, I: Isa>(
    isa: I,
    ground: &Ground<I::F>,
    block: &mut Block<I::Row>,
    c: usize,
    contact: &Contact,
    step_s: f64,
) {
    let mut arm = [isa.splat(0.0); 3];
    let gap = match contact.sole {
        Sole::Foot { body, along_m, depth_m, across_m } => {
            if D == 2 {
                sole_in_plane(isa, block, body, [along_m, -depth_m], &mut arm);
            } else {
                corner(isa, block, body, [along_m, -depth_m, across_m], &mut arm);
            }
            isa.load(&block.q[contact.dof + 1]) + arm[1]
        }
        Sole::Node { node, depth_m } => {
            if contact.rigid {
                for axis in 0..D {
                    arm[axis] = isa.load(&block.node[D * node + axis])
                        - isa.load(&block.q[contact.dof + axis]);
                }
            }
            isa.load(&block.node[D * node + 1]) - depth_m
        }
    };
    for axis in 0..D {
        isa.store(arm[axis], &mut block.contact.arm[D * c + axis]);
    }
    // Above the ground there is no damper yet.
    let inside = gap.lt(isa.splat(0.0));
    let lead_s = I::F::select(inside, ground.lead_s, isa.splat(step_s));
    let approach = (gap / lead_s).max(isa.splat(-RECOVERY_M_S));
    let u = point_velocity::<D, I>(isa, &block.v, contact.dof, contact.rigid, &arm);
    let mut bias = arc::<D, I>(isa, &block.v, contact.dof, contact.rigid, &arm, 0.5 * step_s);
    bias[0] = bias[0] + approach;
    // What touched, or would pass through the ground at the speed that it has. What is not a number does neither.
    let was_closed = !isa.load(&block.mode[c]).eq(isa.splat(Mode::OPEN));
    let zero = isa.splat(0.0);
    let closed = was_closed | (u[0] + bias[0]).le(zero);
    let work = &mut block.contact;
    store_vector::<D, I>(isa, zero.eq(zero), &bias, &mut work.bias, c);
    isa.store(I::F::select(closed, isa.splat(1.0), zero), &mut work.touching[c]);
}

/// Velocity of a point at the start of the step.
#[inline(always)]
pub(super) fn start_velocity<const D: usize, I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    c: usize,
    contact: &Contact,
) -> Vector<I::F> {
    let arm = load_vector::<D, I>(isa, &block.contact.arm, c);
    point_velocity::<D, I>(isa, &block.v, contact.dof, contact.rigid, &arm)
}

/// What the rotation of a body within the step adds to the mean velocity of its point, ½ Δt ω × (ω × r): it
/// moves on an arc, not along the tangent. Without it a foot that rocks on its toe would creep by ½ (ω Δt)² r a step.
#[inline(always)]
fn arc<const D: usize, I: Isa>(
    isa: I,
    velocities: &[I::Row],
    first: usize,
    rigid: bool,
    arm: &[I::F; 3],
    half_step_s: f64,
) -> Vector<I::F> {
    let zero = isa.splat(0.0);
    if !rigid {
        return [zero; 3];
    }
    if D == 2 {
        let turn = isa.load(&velocities[first + 2]);
        let squared = turn * turn * half_step_s;
        return [-(squared * arm[1]), -(squared * arm[0]), zero];
    }
    let mut turn = [zero; 3];
    for axis in 0..3 {
        turn[axis] = isa.load(&velocities[first + 3 + axis]);
    }
    let bent = cross(&turn, &cross(&turn, arm));
    [bent[1] * half_step_s, bent[0] * half_step_s, bent[2] * half_step_s]
}

/// Toe or heel in the plane, given in the axes of its magnet.
#[inline(always)]
fn sole_in_plane<I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: usize,
    [along_m, up_m]: [f64; 2],
    arm: &mut [I::F; 3],
) {
    let cos = isa.load(&block.frame[2 * body]);
    let sin = isa.load(&block.frame[2 * body + 1]);
    arm[0] = cos * along_m - sin * up_m;
    arm[1] = sin * along_m + cos * up_m;
}

/// Corner of a foot in space, given in the axes of its magnet.
#[inline(always)]
fn corner<I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: usize,
    places_m: [f64; 3],
    arm: &mut [I::F; 3],
) {
    let frame = axes(isa, block, body);
    for axis in 0..3 {
        arm[axis] = frame[0][axis] * places_m[0]
            + frame[1][axis] * places_m[1]
            + frame[2][axis] * places_m[2];
    }
}

/// Velocity of a point at an arm from the unknowns that start at `first`, V + ω × r: upwards, along x, along z.
#[inline(always)]
pub(super) fn point_velocity<const D: usize, I: Isa>(
    isa: I,
    velocities: &[I::Row],
    first: usize,
    rigid: bool,
    arm: &[I::F; 3],
) -> Vector<I::F> {
    let velocities = &velocities[first..][..if rigid { body_size(D) } else { D }];
    let mut velocity = [isa.splat(0.0); 3];
    for axis in 0..D {
        velocity[axis] = isa.load(&velocities[axis]);
    }
    if rigid && D == 2 {
        let turn = isa.load(&velocities[2]);
        velocity[0] = velocity[0] - turn * arm[1];
        velocity[1] = velocity[1] + turn * arm[0];
    } else if rigid {
        let mut turn = [isa.splat(0.0); 3];
        for axis in 0..3 {
            turn[axis] = isa.load(&velocities[3 + axis]);
        }
        let moved = cross(&turn, arm);
        for axis in 0..3 {
            velocity[axis] = velocity[axis] + moved[axis];
        }
    }
    [velocity[1], velocity[0], velocity[2]]
}
