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
use crate::elastic::vector::{cross, dot};
use crate::lanes::{Isa, Real};
use crate::model::{Model, OffCentre};
use crate::state::Block;

/// Pairs of axes whose products of inertia stand in three rows, in this order.
const PRODUCTS: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

/// Adds what S brings to both sides, and in space the products of inertia.
#[inline(always)]
pub fn inertia<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    for body in &model.off_centre {
        let axes = D::axes_before(isa, block, body.body);
        let s = first_moment::<D, I>(isa, block, body, &axes);
        let velocity = vector::<D, I>(isa, &block.v, body.dof);
        let rate = rotation::<D, I>(isa, &block.v, body);
        let (push, spin) = (cross(&rate, &s), cross(&s, &velocity));
        (0..D::AXES).for_each(|k| add(isa, push[k], &mut block.right[body.dof + k]));
        for (dof, k) in rotations::<D>(body) {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            add(isa, spin[k], &mut block.right[dof]);
            set(isa, model, block, dof, body.dof + next, -s[last]);
            set(isa, model, block, dof, body.dof + last, s[next]);
        }
        add_products::<D, I>(isa, model, block, body, &axes, &rate);
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
    let pull = gravity_m_s2.map(|g| isa.splat(g * model.step_s));
    for body in &model.off_centre {
        let axes = D::axes_before(isa, block, body.body);
        let torque = cross(&first_moment::<D, I>(isa, block, body, &axes), &pull);
        rotations::<D>(body).for_each(|(dof, k)| add(isa, torque[k], &mut block.right[dof]));
    }
}

/// Moves bodies and their velocities over a step as their centres of mass move, in the lanes of `go`; places and frames are
/// already those at its end, as if X had moved straight.
#[inline(always)]
pub fn carry<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, go: I::M) {
    for body in &model.off_centre {
        let (before, after) =
            (D::axes_before(isa, block, body.body), D::axes_after(isa, model, block, body.body));
        let share = one_over(isa.load(&block.mass[body.dof]));
        let from = first_moment::<D, I>(isa, block, body, &before).map(|s| s * share);
        let to = first_moment::<D, I>(isa, block, body, &after).map(|s| s * share);
        let rate = rotation::<D, I>(isa, &block.next, body);
        let swing = cross(&rate, &from);
        let rate = if D::AXES == 2 {
            rate
        } else {
            turned_rate(isa, block, body, share, &rate, [&before, &after])
        };
        let swung = cross(&rate, &to);
        for k in 0..D::AXES {
            let velocity = isa.load(&block.next[body.dof + k]) + swing[k] - swung[k];
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
    rate: &[I::F; 3],
    [before, after]: [&[[I::F; 3]; 3]; 2],
) -> [I::F; 3] {
    let inertia = central_inertia(isa, block, body, share);
    let momentum = world(before, &product(&inertia, &within(before, rate)));
    world(after, &solved(&inertia, &within(after, &momentum)))
}

/// Inertia about the centre of mass along the body's own axes.
#[inline(always)]
fn central_inertia<I: Isa>(
    isa: I,
    block: &Block<I::Row>,
    body: &OffCentre,
    share: I::F,
) -> [[I::F; 3]; 3] {
    let s = [0, 1, 2].map(|k| isa.load(&block.off_centre[body.row + k]));
    let square = dot(&s, &s) * share;
    let mut inertia = [[isa.splat(0.0); 3]; 3];
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
    axes: &[[I::F; 3]; 3],
    rate: &[I::F; 3],
) {
    let first = body.dof + D::AXES;
    for (at, (k, l)) in PRODUCTS.into_iter().take(D::PRODUCTS).enumerate() {
        let entry = isa.load(&block.off_centre[body.row + 3 + at]);
        let (by_k, by_l) = (dot(&axes[k], rate) * entry, dot(&axes[l], rate) * entry);
        for row in 0..3 {
            add(isa, axes[k][row] * by_l + axes[l][row] * by_k, &mut block.right[first + row]);
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
    axes: &[[I::F; 3]; 3],
) -> [I::F; 3] {
    world(axes, &vector::<D, I>(isa, &block.off_centre, body.row))
}

/// A vector of the first D components, 0 beyond.
#[inline(always)]
fn vector<D: Rod, I: Isa>(isa: I, rows: &[I::Row], first: usize) -> [I::F; 3] {
    let mut vector = [isa.splat(0.0); 3];
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
fn rotation<D: Rod, I: Isa>(isa: I, rows: &[I::Row], body: &OffCentre) -> [I::F; 3] {
    let mut rate = [isa.splat(0.0); 3];
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
fn world<F: Real>(axes: &[[F; 3]; 3], v: &[F; 3]) -> [F; 3] {
    [0, 1, 2].map(|i| axes[0][i] * v[0] + axes[1][i] * v[1] + axes[2][i] * v[2])
}

/// Components along the axes.
#[inline(always)]
fn within<F: Real>(axes: &[[F; 3]; 3], v: &[F; 3]) -> [F; 3] {
    [0, 1, 2].map(|k| dot(&axes[k], v))
}

#[inline(always)]
fn product<F: Real>(a: &[[F; 3]; 3], x: &[F; 3]) -> [F; 3] {
    [0, 1, 2].map(|k| dot(&a[k], x))
}

/// x of A x = b for a symmetric positive A, by L D Lᵀ; 0 where A is 0, as for a robot without mass.
#[inline(always)]
fn solved<F: Real>(a: &[[F; 3]; 3], b: &[F; 3]) -> [F; 3] {
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
    [b[0] * by_0 - l1 * x1 - l2 * x2, x1, x2]
}
