//! Contact points at the start of a step: lever arm r, gap φ, velocity bias û, and whether they are active.
//!
//! ```text
//! û = (φ/τ) n + ½ Δt ω × (ω × c)      φ/Δt above the surface
//! r = c − R n
//! ```
//!
//! A rounded corner is a ball of radius R [m] about c, whose lowest point touches; R is 0 where it is sharp. On its arc goes
//! the centre of the ball: the lowest point stays below it however the body turns, so a ball rolls.

use super::jacobian::arc_velocity;
use super::law::ContactLaw;
use super::rebound;
use super::surface::{self, ContactFrame};
use super::touch::Touch;
use super::{ContactMode, ContactVector, Workspace};
use crate::lanes::{Components, Dim, Isa, Real};
use crate::model::{ContactPair, Foot, Frame, Model, Surface};
use crate::state::Block;

/// Largest speed at which a point that starts inside a surface is pushed out [m/s].
const MAX_CORRECTIVE_SPEED_M_S: f64 = 0.1;

/// Fills lever arms and biases of all contact points, and which of them are active.
pub fn detect<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(parameters) = &model.program.contact else { return };
    isa.vectorize(
        #[inline(always)]
        || {
            let law = ContactLaw::new(isa, parameters, model.step_s, block);
            for (c, pair) in model.contacts.iter().enumerate() {
                detect_point::<D, I>(isa, &law, block, c, pair, model.step_s);
                if let Some(restitution) = &parameters.restitution {
                    rebound::arrive::<D, I>(isa, restitution, block, c, pair);
                }
            }
        },
    );
}

#[inline(always)]
fn detect_point<D: Dim, I: Isa>(
    isa: I,
    law: &ContactLaw<I::F>,
    block: &mut Block<I::Row>,
    c: usize,
    pair: &ContactPair,
    step_s: f64,
) {
    let (centre, place) = arm_and_place::<D, I>(isa, block, pair);
    let gap = match pair.surface {
        Surface::FlatGround => {
            let radius_m = pair.point.radius_m;
            let gap = surface::gap_to_ground::<D, I::F>(place);
            meet_ground::<D, I>(isa, &mut block.contact, c, radius_m, centre);
            if radius_m > 0.0 { gap - radius_m } else { gap }
        }
        Surface::Foot(foot) => meet_foot::<D, I>(isa, block, c, pair, &foot, [centre, place]),
    };
    let inside = gap.lt(isa.splat(0.0));
    let time_s = I::F::select(inside, law.dissipation_time_s, isa.splat(step_s));
    let approach = (gap / time_s).max(isa.splat(-MAX_CORRECTIVE_SPEED_M_S));
    let [first, second] = pair.dofs();
    let velocities = &block.v;
    let [mut bias, u] = Touch::<D, I::F>::meet(
        isa,
        &mut block.contact,
        c,
        pair,
        #[inline(always)]
        |touch, _| {
            let mut arc = arc_velocity::<D, I>(isa, velocities, first, pair.rigid, centre, step_s);
            if let Some(arm) = touch.surface_arm {
                arc = arc - arc_velocity::<D, I>(isa, velocities, second, true, arm, step_s);
            }
            [touch.frame.components(arc), touch.velocity(isa, velocities, [first, second])]
        },
    );
    bias.normal = bias.normal + approach;
    // A velocity that is not a number compares as false, so it makes no point active.
    let closed = !isa.load(&block.contact_mode[c]).eq(isa.splat(ContactMode::Open.code()));
    let active = closed | (u.normal + bias.normal).le(isa.splat(0.0));
    let work = &mut block.contact;
    bias.store(isa, &mut work.bias, c);
    isa.store(I::F::select(active, isa.splat(1.0), isa.splat(0.0)), &mut work.active[c]);
}

/// Stores the arm of the lowest point of a ball about the end of an arm.
#[inline(always)]
fn meet_ground<D: Dim, I: Isa>(
    isa: I,
    work: &mut Workspace<I::Row>,
    c: usize,
    radius_m: f64,
    mut arm: D::Vector<I::F>,
) {
    if radius_m > 0.0 {
        let none = D::Tangent::splat(isa.splat(0.0));
        let upwards = ContactVector::new(isa.splat(radius_m), none);
        arm = arm - ContactFrame::<D, I::F>::Upright.vector(upwards);
    }
    arm.store(isa, &mut work.arm[D::AXES * c..]);
}

/// Stores the arms and the normal of the point where a ball about a place is nearest to a foot; its gap [m].
#[inline(always)]
fn meet_foot<D: Dim, I: Isa>(
    isa: I,
    block: &mut Block<I::Row>,
    c: usize,
    pair: &ContactPair,
    foot: &Foot,
    [arm, place]: [D::Vector<I::F>; 2],
) -> I::F {
    let Some(body) = pair.surface_body else { return isa.splat(0.0) };
    let frame = D::Frame::load(isa, &block.frame[D::Frame::<I::F>::COUNT * foot.body..]);
    let from_body = place - D::Vector::load(isa, &block.q[body.dof..]);
    let mut local = from_body;
    for axis in 0..D::AXES {
        local[axis] = from_body.dot(D::axis(frame, axis));
    }
    local[0] = local[0] - foot.centre_m;
    let (gap, outwards) = surface::nearest_of_foot::<D, I::F>(foot, local);
    let mut normal = D::axis(frame, 0) * outwards[0];
    for axis in 1..D::AXES {
        normal = normal + D::axis(frame, axis) * outwards[axis];
    }
    let radius = isa.splat(pair.point.radius_m);
    let (work, first) = (&mut block.contact, D::AXES * body.place);
    (arm - normal * radius).store(isa, &mut work.arm[D::AXES * c..]);
    (from_body - normal * radius).store(isa, &mut work.surface_arm[first..]);
    normal.store(isa, &mut work.surface_normal[first..]);
    gap - radius
}

/// Lever arm of a contact point from its body, and its place in the world [m].
#[inline(always)]
fn arm_and_place<D: Dim, I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    pair: &ContactPair,
) -> (D::Vector<I::F>, D::Vector<I::F>) {
    let place_m = pair.point.place_m;
    match pair.point.frame {
        Frame::Body(body) => {
            let axes = D::Frame::load(isa, &block.frame[D::Frame::<I::F>::COUNT * body..]);
            let arm = D::to_world(axes, place_m);
            (arm, D::Vector::load(isa, &block.q[pair.dof..]) + arm)
        }
        Frame::World => {
            let mut place = D::Vector::splat(isa.splat(0.0));
            for axis in 0..D::AXES {
                place[axis] = isa.splat(place_m[axis]);
            }
            (D::Vector::splat(isa.splat(0.0)), place)
        }
        Frame::Node(node) => {
            let mut place = D::Vector::load(isa, &block.node[D::AXES * node..]);
            let mut arm = D::Vector::splat(isa.splat(0.0));
            if pair.rigid {
                arm = place - D::Vector::load(isa, &block.q[pair.dof..]);
            }
            for axis in 0..D::AXES {
                place[axis] = place[axis] + place_m[axis];
            }
            (arm, place)
        }
    }
}
