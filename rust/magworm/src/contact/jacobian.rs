//! The contact Jacobian J of a point at arm r of its body: J v, Jᵀ f and Jᵀ C J.
//!
//! ```text
//! J (V, ω) = V + ω × r,   Jᵀ f = (f, r × f)
//! ```
//!
//! V and ω are the body's velocity and angular velocity [m/s, rad/s]. A point on a node that no magnet carries has no r and
//! no ω.

use crate::lanes::{Components, Dim, Isa};

/// V + ω × r from the unknowns that begin at `first`.
#[inline(always)]
pub(super) fn point_velocity<D: Dim, I: Isa>(
    isa: I,
    velocities: &[I::Row],
    first: usize,
    rigid: bool,
    arm: D::Vector<I::F>,
) -> D::Vector<I::F> {
    let velocities = &velocities[first..][..if rigid { D::BODY } else { D::AXES }];
    let linear = D::Vector::load(isa, velocities);
    if !rigid {
        return linear;
    }
    let angular = D::Angular::load(isa, &velocities[D::AXES..]);
    linear + D::angular_cross(angular, arm)
}

/// ½ Δt ω × (ω × r), what an arc adds to the mean velocity of a point within a step. Without it a foot that rocks on its toe
/// would creep by ½ (ω Δt)² r a step.
#[inline(always)]
pub(super) fn arc_velocity<D: Dim, I: Isa>(
    isa: I,
    velocities: &[I::Row],
    first: usize,
    rigid: bool,
    arm: D::Vector<I::F>,
    step_s: f64,
) -> D::Vector<I::F> {
    if !rigid {
        return D::Vector::splat(isa.splat(0.0));
    }
    let angular = D::Angular::load(isa, &velocities[first + D::AXES..]);
    D::centripetal(angular, arm, 0.5 * step_s)
}

/// Adds Jᵀ f to the rows of a body.
#[inline(always)]
pub(super) fn add_force<D: Dim, I: Isa>(
    isa: I,
    rows: &mut [I::Row],
    rigid: bool,
    arm: D::Vector<I::F>,
    force: D::Vector<I::F>,
) {
    let rows = &mut rows[..if rigid { D::BODY } else { D::AXES }];
    for axis in 0..D::AXES {
        add(isa, &mut rows[axis], force[axis]);
    }
    if !rigid {
        return;
    }
    let torque = D::torque(arm, force);
    for k in 0..D::ROTATIONS {
        add(isa, &mut rows[D::AXES + k], torque[k]);
    }
}

/// Adds Jᵀ C J with the arms of J on the left and on the right, C by columns: entry (i, j) stands at `place` + i · stride + j.
#[inline(always)]
pub(super) fn add_block<D: Dim, I: Isa>(
    isa: I,
    matrix: &mut [I::Row],
    [place, stride]: [usize; 2],
    rigid: bool,
    [left, right]: [D::Vector<I::F>; 2],
    columns: &[D::Vector<I::F>; 3],
) {
    for row in 0..D::AXES {
        let entries = &mut matrix[place + row * stride..][..D::AXES];
        for column in 0..D::AXES {
            add(isa, &mut entries[column], columns[column][row]);
        }
    }
    if !rigid {
        return;
    }
    // C G with G ω = ω × r: its row i is r × (row i of C).
    let mut turned = [D::Angular::splat(right[0]); 3];
    for row in 0..D::AXES {
        let mut entries = columns[0];
        for column in 0..D::AXES {
            entries[column] = columns[column][row];
        }
        turned[row] = D::torque(right, entries);
        let of_force = &mut matrix[place + row * stride + D::AXES..][..D::ROTATIONS];
        for k in 0..D::ROTATIONS {
            add(isa, &mut of_force[k], turned[row][k]);
        }
    }
    let mut torques = [[turned[0]; 3]; 2];
    for column in 0..D::AXES {
        torques[0][column] = D::torque(left, columns[column]);
    }
    for column in 0..D::ROTATIONS {
        let mut force = columns[0];
        for row in 0..D::AXES {
            force[row] = turned[row][column];
        }
        torques[1][column] = D::torque(left, force);
    }
    for k in 0..D::ROTATIONS {
        let of_torque = &mut matrix[place + (D::AXES + k) * stride..][..D::BODY];
        for column in 0..D::AXES {
            add(isa, &mut of_torque[column], torques[0][column][k]);
        }
        for column in 0..D::ROTATIONS {
            add(isa, &mut of_torque[D::AXES + column], torques[1][column][k]);
        }
    }
}

#[inline(always)]
fn add<I: Isa>(isa: I, entry: &mut I::Row, value: I::F) {
    isa.store(isa.load(entry) + value, entry);
}
