//! Guards: what a robot must not do, and what becomes of one that does.
//!
//! Before a step is committed its velocities must be finite, and the robot that it began with sound; so nothing that is
//! committed is infinite or no number. After the last step of a call the robot must be sound where it is now, and slow:
//! none is rewarded for a control step that it ended broken.

use crate::elastic::{self, Rod};
use crate::lanes::{Dim, Isa, Mask, Number, Real, Row};
use crate::model::Model;
use crate::state::{Block, Status};

/// A sum of all speeds beyond it is on its way to infinity [m/s].
const INFINITE: f64 = 1e6;
/// Greatest and least length of an element, in rest lengths.
const LONGEST: f64 = 3.0;
const SHORTEST: f64 = 0.1;

/// The running lanes whose step may be committed; the others are marked as broken and keep their last sound state.
#[inline(always)]
pub fn may_go_on<D: Dim, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) -> I::M {
    let finite = next_is_finite(isa, block);
    let intact = is_intact(isa, model, block);
    let above = is_above_ground::<D, I>(isa, model, block);
    mark(
        isa,
        block,
        [(finite, Status::NotFinite), (intact, Status::Overstretched), (above, Status::Sunk)],
    )
}

/// Marks the lanes that are no longer sound where they are now.
#[inline(always)]
pub fn stop_unsound<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    elastic::place::<D, I>(isa, model, block);
    let intact = is_intact(isa, model, block);
    let above = is_above_ground::<D, I>(isa, model, block);
    let slow = is_slow::<D, I>(isa, model, block);
    mark(
        isa,
        block,
        [(intact, Status::Overstretched), (above, Status::Sunk), (slow, Status::TooFast)],
    );
}

#[inline(always)]
fn next_is_finite<I: Isa>(isa: I, block: &Block<I::Row>) -> I::M {
    let mut sum = isa.splat(0.0);
    for row in block.end_velocity.iter() {
        sum = sum + isa.load(row).abs();
    }
    sum.lt(isa.splat(INFINITE))
}

#[inline(always)]
fn is_intact<I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::M {
    let mut intact = isa.splat(0.0).eq(isa.splat(0.0));
    for spring in &model.stretch {
        let length = isa.load(&block.length[spring.element]);
        intact = intact
            & length.lt(isa.splat(LONGEST * spring.rest_m))
            & length.gt(isa.splat(SHORTEST * spring.rest_m));
    }
    intact
}

#[inline(always)]
fn is_above_ground<D: Dim, I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::M {
    let mut lowest = isa.splat(0.0);
    if model.program.contact.is_some() {
        for node in 0..model.nodes() {
            lowest = lowest.min(isa.load(&block.node[D::AXES * node + 1]));
        }
    }
    lowest.ge(isa.splat(-model.thickness_m))
}

/// Whether no free node and no magnet moves faster than the scene allows.
#[inline(always)]
fn is_slow<D: Dim, I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::M {
    let mut fastest = isa.splat(0.0);
    for translations in model.translations.chunks_exact(D::AXES) {
        let mut square = isa.splat(0.0);
        for &(dof, _) in translations {
            let speed = isa.load(&block.v[dof]);
            square = square + speed * speed;
        }
        fastest = fastest.max(square);
    }
    let limit = model.scene.solver.fastest_m_s;
    fastest.le(isa.splat(limit * limit))
}

/// The running lanes that pass all guards. The others are marked with the status of the first that they fail.
#[inline(always)]
fn mark<I: Isa, const N: usize>(
    isa: I,
    block: &mut Block<I::Row>,
    guards: [(I::M, Status); N],
) -> I::M {
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let mut sound = running;
    for (passed, _) in guards {
        sound = sound & passed;
    }
    if (running & !sound).any() {
        let code = |status: Status| isa.splat(f64::from(status as u8));
        let mut reason = code(Status::Running);
        for (passed, status) in guards.into_iter().rev() {
            reason = I::F::select(passed, reason, code(status));
        }
        let mut codes = I::Row::zeros();
        isa.store(I::F::select(running, reason, code(Status::Running)), &mut codes);
        stop(block, codes);
    }
    sound
}

/// Stops the lanes that have a code other than that of [`Status::Running`].
fn stop<R: Row>(block: &mut Block<R>, codes: R) {
    for lane in 0..R::LANES {
        let code = codes[lane].f64() as u8;
        if code != Status::Running as u8 {
            block.status[lane] = Status::from_code(code).unwrap_or(Status::NotFinite);
            block.running[0][lane] = R::Number::default();
            clean(block, lane);
        }
    }
}

/// What a step writes into the state before it is known to be sound may be anything, NaN included.
fn clean<R: Row>(block: &mut Block<R>, lane: usize) {
    for rows in [
        &mut block.contact_mode,
        &mut block.normal_impulse,
        &mut block.tangential_spring,
        &mut block.wrench,
    ] {
        rows.iter_mut().for_each(|row| row[lane] = R::Number::default());
    }
    for row in block.twist.iter_mut().filter(|row| !row[lane].f64().is_finite()) {
        row[lane] = R::Number::default();
    }
    for frame in block.director.chunks_exact_mut(6) {
        if frame.iter().any(|row| !row[lane].f64().is_finite()) {
            for (row, value) in frame.iter_mut().zip([0.0, 1.0, 0.0, 1.0, 0.0, 0.0]) {
                row[lane] = R::Number::of(value);
            }
        }
    }
}
