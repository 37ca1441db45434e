//! Coulomb's cone in space, linearised (Newton's iteration, see [`super`]): a force along the direction d in which a
//! point slides and a viscous one across it.

use super::guess::{along, length};
use super::law::{After, Ground, Point, load2};
use super::store_unless;
use crate::lanes::{Isa, Real};
use crate::model::Model;
use crate::state::Block;

/// Sine of the angle by which a direction of sliding may have turned before friction is linearised anew.
const TURNED: f64 = 0.02;

/// Friction of sliding points about their velocity in the pass before: the direction p across it, and the
/// viscosity F/|u| of a motion along p.
#[inline(always)]
pub(super) fn linearise<const W: usize, I: Isa<W>>(
    isa: I,
    model: &Model,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    stale: I::M,
) {
    for c in 0..model.contacts.len() {
        let slip = load2::<W, 3, I>(isa, &block.slip, 2 * c);
        let across = [-slip[1], slip[0]];
        let viscosity = viscosity(isa, ground, block, c, isa.load(&block.speed[c]));
        // u = (λ⁰ − ξ)/w, and ξ has no part across the direction.
        let warm = load2::<W, 3, I>(isa, &block.warm, 3 * c + 1);
        let about = along::<I::F, 3>(warm, across) / ground.weight;
        let rows = [across[0], across[1], viscosity, about];
        for k in 0..4 {
            let row = &mut block.across[4 * c + k];
            isa.store(I::F::select(stale, rows[k], isa.load(row)), row);
        }
    }
}

/// w F/|ξ| = F/|u| of a point that slides, no greater than the penalty; `speed` is |ξ|/w.
#[inline(always)]
fn viscosity<const W: usize, I: Isa<W>>(
    isa: I,
    ground: &Ground<I::F>,
    block: &Block<W>,
    c: usize,
    speed: I::F,
) -> I::F {
    let friction = ground.friction(isa.load(&block.coefficient[c]), isa.load(&block.reckoned[c]));
    let slowest = friction / ground.weight;
    friction / speed.max(slowest).max(isa.splat(1e-30))
}

/// Whether friction is to be linearised anew: about another speed or direction.
#[inline(always)]
pub(super) fn outdated<const W: usize, I: Isa<W>>(
    isa: I,
    ground: &Ground<I::F>,
    block: &Block<W>,
    c: usize,
    point: &Point<I::F>,
    after: &After<I::F>,
) -> I::M {
    let speed = length::<I::F, 3>(point.held) / ground.weight;
    let viscosity = viscosity(isa, ground, block, c, speed);
    let assumed = isa.load(&block.across[4 * c + 2]);
    let p = load2::<W, 3, I>(isa, &block.across, 4 * c);
    assumed.gt(viscosity * 2.0)
        | assumed.lt(viscosity * 0.5)
        | along::<I::F, 3>(after.slip, p).abs().gt(isa.splat(TURNED))
}

/// How far the friction that a sliding point had in this pass is from that of the velocity found
/// [N·s]; takes that velocity over.
#[inline(always)]
pub(super) fn veer<const W: usize, I: Isa<W>>(
    isa: I,
    ground: &Ground<I::F>,
    block: &mut Block<W>,
    c: usize,
    point: &Point<I::F>,
    after: &After<I::F>,
    done: I::M,
) -> I::F {
    let friction = ground.friction(point.coefficient, point.reckoned);
    let p = load2::<W, 3, I>(isa, &block.across, 4 * c);
    let across = along::<I::F, 3>(point.u_t, p);
    let viscous =
        isa.load(&block.across[4 * c + 2]) * (across - isa.load(&block.across[4 * c + 3]));
    let mut stray = point.slip;
    for t in 0..2 {
        stray[t] = (after.slip[t] - point.slip[t]) * friction - p[t] * viscous;
    }
    store_unless(isa, done, across, &mut block.across[4 * c + 3]);
    let speed = length::<I::F, 3>(point.held) / ground.weight;
    store_unless(isa, done, speed, &mut block.speed[c]);
    length::<I::F, 3>(stray)
}
