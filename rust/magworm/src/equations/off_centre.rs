//! Rigid bodies whose centre of mass lies beside the middle of their element.
//!
//! The unknowns of a body are the place X of the middle of its element and its rotation. With its first moment of mass
//! S = m r [kg·m], r from X to the centre of mass, and its inertia I about X, momentum and angular momentum about X are
//!
//! p = m v + ω × S,   L = I ω + S × v,
//!
//! so S couples velocity and rotation in M, and weight has the torque S × g. After a step the centre of mass has moved
//! straight, with its own velocity v_c = v + ω × r, and the body has turned about it with its angular momentum there, I_c ω;
//! X and v follow from both. That is the centrifugal force, and free flight keeps both momenta to rounding.

use crate::elastic::Rod;
use crate::lanes::{Components, Isa, Real, Vec3, Vector};
use crate::model::{Model, OffCentre};
use crate::state::Block;

/// Pairs of axes whose products of inertia stand in three rows, in this order.
const PRODUCTS: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

/// Adds what S brings to both sides, and in space the products of inertia.
#[inline(always)]
pub fn inertia<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    for body in model.off_centre() {
        let axes = D::axes_before(isa, block, body.body);
        let s = first_moment::<D, I>(isa, block, body, &axes);
        let velocity = vector::<D, I>(isa, &block.v, body.dof);
        let rate = rotation::<D, I>(isa, &block.v, body);
        let (push, spin) = (rate.cross(s), s.cross(velocity));
        (0..D::AXES).for_each(|k| add(isa, push[k], &mut block.rhs[body.dof + k]));
        for (dof, k) in rotations::<D>(body) {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            add(isa, spin[k], &mut block.rhs[dof]);
            set(isa, model, block, dof, body.dof + next, -s[last]);
            set(isa, model, block, dof, body.dof + last, s[next]);
        }
        add_products::<D, I>(isa, model, block, body, &axes, rate);
    }
}

/// Adds the torque Δt S × g of the weight.
#[inline(always)]
pub fn gravity<D: Rod, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    gravity_m_s2: [f64; 3],
) {
    let pull = Vector(gravity_m_s2.map(|g| isa.splat(g * model.step_s)));
    for body in model.off_centre() {
        let axes = D::axes_before(isa, block, body.body);
        let torque = first_moment::<D, I>(isa, block, body, &axes).cross(pull);
        rotations::<D>(body).for_each(|(dof, k)| add(isa, torque[k], &mut block.rhs[dof]));
    }
}

/// Moves bodies and their velocities over a step as their centres of mass move, in the lanes of `go`; places and frames are
/// already those at its end, as if X had moved straight.
#[inline(always)]
pub fn carry<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, go: I::M) {
    for body in model.off_centre() {
        let before = D::axes_before(isa, block, body.body);
        let after = D::axes_after(isa, model, block, body.body);
        let share = one_over(isa.load(&block.mass[body.dof]));
        let from = first_moment::<D, I>(isa, block, body, &before) * share;
        let to = first_moment::<D, I>(isa, block, body, &after) * share;
        let rate = rotation::<D, I>(isa, &block.end_velocity, body);
        let swing = rate.cross(from);
        let rate = if D::AXES == 2 {
            rate
        } else {
            turned_rate(isa, block, body, share, rate, [&before, &after])
        };
        let swung = rate.cross(to);
        for k in 0..D::AXES {
            let velocity = isa.load(&block.end_velocity[body.dof + k]) + swing[k] - swung[k];
            let place = isa.load(&block.q[body.dof + k]);
            let place = place + (swing[k] * model.step_s - (to[k] - from[k]));
            keep(isa, go, place, &mut block.q[body.dof + k]);
            keep(isa, go, velocity, &mut block.v[body.dof + k]);
        }
        rotations::<D>(body).for_each(|(dof, k)| keep(isa, go, rate[k], &mut block.v[dof]));
    }
}

/// The angular velocity after a step, by the angular momentum about the centre of mass before it.
#[inline(always)]
fn turned_rate<I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: &OffCentre,
    share: I::F,
    rate: Vec3<I::F>,
    [before, after]: [&[Vec3<I::F>; 3]; 2],
) -> Vec3<I::F> {
    let inertia = central_inertia(isa, block, body, share);
    let momentum = world(before, along(&inertia, along(before, rate)));
    world(after, solved(&inertia, along(after, momentum)))
}

/// Inertia about the centre of mass along the body's own axes.
#[inline(always)]
fn central_inertia<I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: &OffCentre,
    share: I::F,
) -> [Vec3<I::F>; 3] {
    let s = Vec3::load(isa, &block.off_centre[body.row..]);
    let square = s.norm_squared() * share;
    let mut inertia = [Vec3::splat(isa.splat(0.0)); 3];
    for k in 0..3 {
        inertia[k][k] = isa.load(&block.mass[body.dof + 3 + k]) - (square - s[k] * s[k] * share);
    }
    for (row, (k, l)) in PRODUCTS.into_iter().enumerate() {
        let entry = isa.load(&block.off_centre[body.row + 3 + row]) + s[k] * s[l] * share;
        (inertia[k][l], inertia[l][k]) = (entry, entry);
    }
    inertia
}

/// Adds I_kl (a_k a_lᵀ + a_l a_kᵀ) to the inertia of a body with the axes a, and its part of the momentum.
#[inline(always)]
fn add_products<D: Rod, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    body: &OffCentre,
    axes: &[Vec3<I::F>; 3],
    rate: Vec3<I::F>,
) {
    let first = body.dof + D::AXES;
    for (at, (k, l)) in PRODUCTS.into_iter().take(D::PRODUCTS).enumerate() {
        let entry = isa.load(&block.off_centre[body.row + 3 + at]);
        let (by_k, by_l) = (axes[k].dot(rate) * entry, axes[l].dot(rate) * entry);
        for row in 0..3 {
            add(isa, axes[k][row] * by_l + axes[l][row] * by_k, &mut block.rhs[first + row]);
            for column in 0..=row {
                let both = axes[k][row] * axes[l][column] + axes[l][row] * axes[k][column];
                let place = model.system.at(first + row, first + column);
                add(isa, both * entry, &mut block.matrix[place]);
            }
        }
    }
}

/// S in x, y, z.
#[inline(always)]
fn first_moment<D: Rod, I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: &OffCentre,
    axes: &[Vec3<I::F>; 3],
) -> Vec3<I::F> {
    world(axes, vector::<D, I>(isa, &block.off_centre, body.row))
}

/// A vector of the first D components, 0 beyond.
#[inline(always)]
fn vector<D: Rod, I: Isa>(isa: I, rows: &[I::Row], first: usize) -> Vec3<I::F> {
    let mut vector = Vec3::splat(isa.splat(0.0));
    (0..D::AXES).for_each(|k| vector[k] = isa.load(&rows[first + k]));
    vector
}

/// Unknowns of the rotations of a body, each with its axis: in the plane that about z alone.
#[inline(always)]
fn rotations<D: Rod>(body: &OffCentre) -> impl Iterator<Item = (usize, usize)> + use<D> {
    let first = body.dof + D::AXES;
    (0..D::ROTATIONS).map(move |k| (first + k, 3 - D::ROTATIONS + k))
}

/// Angular velocity of a body, 0 about the axes that it does not turn about.
#[inline(always)]
fn rotation<D: Rod, I: Isa>(isa: I, rows: &[I::Row], body: &OffCentre) -> Vec3<I::F> {
    let mut rate = Vec3::splat(isa.splat(0.0));
    rotations::<D>(body).for_each(|(dof, k)| rate[k] = isa.load(&rows[dof]));
    rate
}

/// 1/m; 1 for a robot without mass.
#[inline(always)]
fn one_over<F: Real>(mass: F) -> F {
    let one = mass.splat(1.0);
    one / F::select(mass.gt(mass.splat(0.0)), mass, one)
}

#[inline(always)]
fn add<I: Isa>(isa: I, value: I::F, row: &mut I::Row) {
    isa.store(isa.load(row) + value, row);
}

#[inline(always)]
fn keep<I: Isa>(isa: I, mask: I::M, value: I::F, row: &mut I::Row) {
    isa.store(I::F::select(mask, value, isa.load(row)), row);
}

#[inline(always)]
fn set<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, a: usize, b: usize, value: I::F) {
    isa.store(value, &mut block.matrix[model.system.at(a, b)]);
}

/// Σ a_k v_k: from the axes a to x, y, z.
#[inline(always)]
pub(super) fn world<F: Real>(axes: &[Vec3<F>; 3], v: Vec3<F>) -> Vec3<F> {
    axes[0] * v[0] + axes[1] * v[1] + axes[2] * v[2]
}

/// A v by the rows of A: components along axes, or the momentum that an inertia has.
#[inline(always)]
pub(super) fn along<F: Real>(rows: &[Vec3<F>; 3], v: Vec3<F>) -> Vec3<F> {
    Vector([rows[0].dot(v), rows[1].dot(v), rows[2].dot(v)])
}

/// x of A x = b for a symmetric positive A, by L D Lᵀ; 0 where A is 0, as for a robot without mass.
#[inline(always)]
fn solved<F: Real>(a: &[Vec3<F>; 3], b: Vec3<F>) -> Vec3<F> {
    let by_0 = one_over(a[0][0]);
    let (l1, l2) = (a[1][0] * by_0, a[2][0] * by_0);
    let by_1 = one_over(a[1][1] - l1 * a[1][0]);
    let below = a[2][1] - l2 * a[1][0];
    let l3 = below * by_1;
    let by_2 = one_over(a[2][2] - l2 * a[2][0] - l3 * below);
    let y1 = b[1] - l1 * b[0];
    let y2 = b[2] - l2 * b[0] - l3 * y1;
    let x2 = y2 * by_2;
    let x1 = y1 * by_1 - l3 * x2;
    Vector([b[0] * by_0 - l1 * x1 - l2 * x2, x1, x2])
}
