//! One solver step of a block: its phases in their order, and the commit.

mod steps;

pub use steps::Steps;

use crate::actuate;
use crate::contact;
use crate::elastic::{self, Rod};
use crate::equations::{self, Cuboids};
use crate::guard;
use crate::lanes::{Isa, Number, Plane, Real, Row, Space};
use crate::model::{Model, Phase};
use crate::state::{Block, Status};

/// Advances a block by `steps` solver steps. Environments that break stand still; no environment that still runs has
/// ended sunk, overstretched or too fast.
#[inline(always)]
pub fn advance<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, steps: u32) {
    mark_running(block);
    match model.dimensions() {
        2 => advance_in::<Plane, I>(isa, model, block, steps),
        _ => advance_in::<Space, I>(isa, model, block, steps),
    }
}

fn mark_running<R: Row>(block: &mut Block<R>) {
    for lane in 0..R::LANES {
        block.running[0][lane] =
            R::Number::of(if block.status[lane] == Status::Running { 1.0 } else { 0.0 });
    }
}

#[inline(always)]
fn advance_in<D: Cuboids, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, steps: u32) {
    for _ in 0..steps {
        step::<D, I>(isa, model, block);
    }
    isa.vectorize(
        #[inline(always)]
        || guard::stop_unsound::<D, I>(isa, model, block),
    );
}

/// One solver step in D dimensions.
fn step<D: Cuboids, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    for &phase in &model.phases {
        run::<D, I>(isa, model, block, phase);
    }
    block.counters.steps += 1;
}

/// One phase of a step. The phases of a model one after another, each once, are a step.
pub fn run_phase<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, phase: Phase) {
    mark_running(block);
    match model.dimensions() {
        2 => run::<Plane, I>(isa, model, block, phase),
        _ => run::<Space, I>(isa, model, block, phase),
    }
}

/// One phase in D dimensions, compiled for the instruction set on its own: as one function all phases would take a
/// compiler minutes. Contact compiles its parts one by one.
fn run<D: Cuboids, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, phase: Phase) {
    match phase {
        Phase::Kinematics => isa.vectorize(
            #[inline(always)]
            || elastic::kinematics::<D, I>(isa, model, block),
        ),
        Phase::Inertia => isa.vectorize(
            #[inline(always)]
            || equations::inertia::<D, I>(isa, model, block),
        ),
        Phase::Gravity => isa.vectorize(
            #[inline(always)]
            || equations::gravity::<D, I>(isa, model, block),
        ),
        Phase::Magnets => isa.vectorize(
            #[inline(always)]
            || equations::magnets::<D, I>(isa, model, block),
        ),
        Phase::Mutual => isa.vectorize(
            #[inline(always)]
            || equations::mutual::<D, I>(isa, model, block),
        ),
        Phase::Springs => isa.vectorize(
            #[inline(always)]
            || equations::springs::<D, I>(isa, model, block),
        ),
        Phase::System => solve(isa, model, block),
        Phase::ContactPoints => contact::detect::<D, I>(isa, model, block),
        Phase::Condensation => model.system.condense(isa, &mut block.matrix, &mut block.rhs),
        Phase::Contact => contact::solve::<D, I>(isa, model, block),
        Phase::Recovery => {
            model.system.recover(isa, &block.matrix, &block.rhs, &mut block.end_velocity);
        }
        Phase::Commit => isa.vectorize(
            #[inline(always)]
            || commit::<D, I>(isa, model, block),
        ),
        Phase::Drive => isa.vectorize(
            #[inline(always)]
            || actuate::advance::<D, I>(isa, model, block),
        ),
    }
}

/// Velocities at the end of a step without ground.
fn solve<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    model.system.kept().factor(isa, &mut block.matrix);
    block.end_velocity.copy_from_slice(&block.rhs);
    model.system.kept().solve(isa, &block.matrix, &mut block.end_velocity);
    block.counters.factorisations += 1;
}

/// q ← q + Δt v⁺ in the lanes that run and stay sound; the others keep their last sound state. In space the
/// rotations of q are but integrals of their rates; the frames turn by them.
#[inline(always)]
fn commit<D: Rod, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let go = guard::may_go_on::<D, I>(isa, model, block);
    for lane in 0..I::Row::LANES {
        block.step_count[lane] += u64::from(block.running[0][lane].f64() == 1.0);
    }
    let dissipation = model.scene.solver.integrator.coefficients().numerical_dissipation;
    let size = model.coordinates.count;
    let (places, velocities) = (&mut block.q[..size], &mut block.v[..size]);
    let (ends, of_springs) = (&block.end_velocity[..size], &mut block.spring_velocity[..size]);
    for dof in 0..size {
        let (q, v) = (isa.load(&places[dof]), isa.load(&velocities[dof]));
        let (end, of_spring) = (isa.load(&ends[dof]), isa.load(&of_springs[dof]));
        let averaged = end + (v - end) * dissipation;
        isa.store(I::F::select(go, averaged, of_spring), &mut of_springs[dof]);
        isa.store(I::F::select(go, end, v), &mut velocities[dof]);
        isa.store(I::F::select(go, q + end * model.step_s, q), &mut places[dof]);
    }
    D::rotate_frames(isa, model, block, go);
    equations::carry::<D, I>(isa, model, block, go);
}
