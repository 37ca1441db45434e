//! One solver step of a block, and one control step made of them.

use crate::contact;
use crate::drive::{DriveModel, Path, StageModel, on_waypoints, stage_axes};
use crate::elastic;
use crate::equations;
use crate::lanes::math::sin_cos;
use crate::lanes::{Isa, Mask, Number, Real, Row};
use crate::model::{Model, Phase};
use crate::scene::Parameter;
use crate::state::{Block, Status};
use std::f64::consts::TAU;

/// Advances a block by `steps` solver steps. Environments that break stand still.
#[inline(always)]
pub fn advance<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, steps: u32) {
    mark_running(block);
    match model.dimensions() {
        2 => advance_in::<2, I>(isa, model, block, steps),
        _ => advance_in::<3, I>(isa, model, block, steps),
    }
}

fn mark_running<R: Row>(block: &mut Block<R>) {
    for lane in 0..R::LANES {
        block.running[0][lane] =
            R::Number::of(if block.status[lane] == Status::Running { 1.0 } else { 0.0 });
    }
}

#[inline(always)]
fn advance_in<const D: usize, I: Isa>(
    isa: I,
    model: &Model,
    block: &mut Block<I::Row>,
    steps: u32,
) {
    for _ in 0..steps {
        step::<D, I>(isa, model, block);
    }
}

/// One solver step in D dimensions.
fn step<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    for &phase in &model.phases {
        run::<D, I>(isa, model, block, phase);
    }
    block.counters.steps += 1;
}

/// One phase of a step. The phases of a model one after another, each once, are a step.
pub fn run_phase<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, phase: Phase) {
    mark_running(block);
    match model.dimensions() {
        2 => run::<2, I>(isa, model, block, phase),
        _ => run::<3, I>(isa, model, block, phase),
    }
}

/// One phase in D dimensions, compiled for the instruction set on its own: as one function all phases would take a
/// compiler minutes. Contact compiles its parts one by one.
fn run<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>, phase: Phase) {
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
            || equations::gravity(isa, model, block),
        ),
        Phase::Magnets => isa.vectorize(
            #[inline(always)]
            || equations::magnets::<D, I>(isa, model, block),
        ),
        Phase::Springs => isa.vectorize(
            #[inline(always)]
            || equations::springs::<D, I>(isa, model, block),
        ),
        Phase::System => solve(isa, model, block),
        Phase::ContactPoints => contact::detect::<D, I>(isa, model, block),
        Phase::Condensation => model.system.condense(isa, &mut block.matrix, &mut block.right),
        Phase::Contact => contact::solve::<D, I>(isa, model, block),
        Phase::Recovery => {
            model.system.recover(isa, &block.matrix, &block.right, &mut block.next);
        }
        Phase::Commit => isa.vectorize(
            #[inline(always)]
            || commit::<D, I>(isa, model, block),
        ),
        Phase::Drive => isa.vectorize(
            #[inline(always)]
            || move_drive::<D, I>(isa, model, block),
        ),
    }
}

/// Velocities at the end of a step without ground.
fn solve<I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    model.system.kept().factor(isa, &mut block.matrix);
    block.next.copy_from_slice(&block.right);
    model.system.kept().solve(isa, &block.matrix, &mut block.next);
    block.counters.factorisations += 1;
}

/// q ← q + Δt v⁺ in the lanes that run and stay sound; the others keep their last sound state. In space the
/// rotations of q are but integrals of their rates; the frames turn by them.
#[inline(always)]
fn commit<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let finite = all_finite(isa, block);
    let intact = intact(isa, model, block);
    let above = above_ground::<D, I>(isa, model, block);
    let sound = finite & intact & above;
    if (running & !sound).any() {
        mark_broken(isa, block, running, [finite, intact, above]);
    }
    let go = running & sound;
    let count = isa.load(&block.step_count[0]);
    isa.store(I::F::select(go, count + 1.0, count), &mut block.step_count[0]);
    let (lag, size) = (model.scene.solver.integrator.coefficients().lag, model.coordinates.count);
    let (places, speeds) = (&mut block.q[..size], &mut block.v[..size]);
    let (ends, lags) = (&block.next[..size], &mut block.lagged[..size]);
    for dof in 0..size {
        let (q, v) = (isa.load(&places[dof]), isa.load(&speeds[dof]));
        let (next, lagged) = (isa.load(&ends[dof]), isa.load(&lags[dof]));
        isa.store(I::F::select(go, next + (v - next) * lag, lagged), &mut lags[dof]);
        isa.store(I::F::select(go, next, v), &mut speeds[dof]);
        isa.store(I::F::select(go, q + next * model.step_s, q), &mut places[dof]);
    }
    if D == 3 {
        elastic::turn(isa, model, block, go);
    }
}

#[inline(always)]
fn all_finite<I: Isa>(isa: I, block: &Block<I::Row>) -> I::M {
    let mut sum = isa.splat(0.0);
    for row in block.next.iter() {
        sum = sum + isa.load(row).abs();
    }
    // A speed beyond 1e6 m/s is on its way to infinity.
    sum.lt(isa.splat(1e6))
}

#[inline(always)]
fn intact<I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::M {
    let mut intact = isa.splat(0.0).eq(isa.splat(0.0));
    for spring in &model.stretch {
        let length = isa.load(&block.length[spring.element]);
        intact = intact
            & length.lt(isa.splat(3.0 * spring.rest_m))
            & length.gt(isa.splat(0.1 * spring.rest_m));
    }
    intact
}

#[inline(always)]
fn above_ground<const D: usize, I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::M {
    let mut lowest = isa.splat(0.0);
    if model.program.ground.is_some() {
        for node in 0..model.nodes() {
            lowest = lowest.min(isa.load(&block.node[D * node + 1]));
        }
    }
    lowest.ge(isa.splat(-model.thickness_m))
}

#[inline(always)]
fn mark_broken<I: Isa>(
    isa: I,
    block: &mut Block<I::Row>,
    running: I::M,
    [finite, intact, above]: [I::M; 3],
) {
    let code = |status: Status| isa.splat(f64::from(status as u8));
    let reason = I::F::select(above, code(Status::Running), code(Status::Sunk));
    let reason = I::F::select(intact, reason, code(Status::Overstretched));
    let reason = I::F::select(finite, reason, code(Status::NotFinite));
    let mut row = I::Row::zeros();
    isa.store(I::F::select(running, reason, code(Status::Running)), &mut row);
    for lane in 0..I::Row::LANES {
        let code = row[lane].f64();
        if code != 0.0 {
            block.status[lane] = Status::from_code(code as u8).unwrap_or(Status::NotFinite);
            block.running[0][lane] = Number::of(0.0);
            // The impulses of the step that failed may be anything, NaN included.
            for rows in [&mut block.mode, &mut block.normal, &mut block.pad] {
                rows.iter_mut().for_each(|row| row[lane] = Number::of(0.0));
            }
        }
    }
}

/// Puts the drive where it is at the end of the step.
#[inline(always)]
fn move_drive<const D: usize, I: Isa>(isa: I, model: &Model, block: &mut Block<I::Row>) {
    let Some(drive) = &model.program.drive else { return };
    let axes = stage_axes(D);
    let time = isa.load(&block.step_count[0]) * model.step_s;
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let zero = isa.splat(0.0);
    let (mut place, mut speed) = ([zero; 4], [zero; 4]);
    match &drive.path {
        Path::Controlled(limits) => {
            let greatest = isa.load(&block.target[axes]);
            for axis in 0..axes {
                let limit = if axis == 3 {
                    greatest * (limits.yaw_speed_rad_s / limits.speed_m_s)
                } else {
                    greatest
                };
                (place[axis], speed[axis]) = StageModel::advance(
                    limits.acceleration(axis),
                    isa.load(&block.stage[axis]),
                    isa.load(&block.stage[axes + axis]),
                    isa.load(&block.target[axis]),
                    limit,
                    model.step_s,
                );
            }
        }
        Path::Constant { start, speed_m_s } => {
            speed[0] = isa.load(&block.factors[Parameter::DriveSpeed as usize]) * *speed_m_s;
            place[0] = speed[0] * time + start[0];
            for axis in 1..axes {
                place[axis] = isa.splat(start[axis]);
            }
        }
        Path::Waypoints { time_s, point } => {
            follow(isa, time_s, point, time, &mut place, &mut speed);
        }
    }
    for axis in 0..axes {
        for (row, value) in [(axis, place[axis]), (axes + axis, speed[axis])] {
            let row = &mut block.stage[row];
            isa.store(I::F::select(running, value, isa.load(row)), row);
        }
    }
}

/// Waypoints lane by lane: environments may have been reset at different times.
#[inline(always)]
fn follow<I: Isa>(
    isa: I,
    time_s: &[f64],
    point: &[[f64; 4]],
    time: I::F,
    place: &mut [I::F; 4],
    speed: &mut [I::F; 4],
) {
    let mut now = I::Row::zeros();
    isa.store(time, &mut now);
    let mut rows = [I::Row::zeros(); 8];
    for lane in 0..I::Row::LANES {
        let (position, velocity) = on_waypoints(time_s, point, now[lane].f64());
        for axis in 0..4 {
            rows[axis][lane] = Number::of(position[axis]);
            rows[4 + axis][lane] = Number::of(velocity[axis]);
        }
    }
    for axis in 0..4 {
        place[axis] = isa.load(&rows[axis]);
        speed[axis] = isa.load(&rows[4 + axis]);
    }
}

/// x of the robot's centre: mean of its magnets.
#[inline(always)]
pub fn robot_centre<I: Isa>(isa: I, model: &Model, block: &Block<I::Row>) -> I::F {
    let mut sum = isa.splat(0.0);
    for &dof in &model.coordinates.bodies {
        sum = sum + isa.load(&block.q[dof]);
    }
    sum / (model.magnets().max(1) as f64)
}

/// Sets the targets of a controlled drive from actions in [−1, 1]. In the plane: place relative to the
/// robot's centre now, height, travel speed. In space: place along the robot's heading and to its side, height,
/// travel speed, yaw against its heading where the stage has it. Values beyond are clipped.
pub fn command<R: Row>(
    model: &Model,
    drive: &DriveModel,
    block: &mut Block<R>,
    lane: usize,
    action: &[f64],
) {
    let Path::Controlled(limits) = &drive.path else { return };
    let action = |k: usize| action.get(k).map_or(0.0, |a| a.clamp(-1.0, 1.0));
    let unit = |a: f64| 0.5 * (a + 1.0);
    let size = limits.action_size(model.dimensions());
    let along = action(0) * limits.reach_m;
    let height = |a: f64| limits.lowest_m + unit(a) * (limits.highest_m - limits.lowest_m);
    let targets = if model.dimensions() == 2 {
        let speed = unit(action(2)) * limits.speed_m_s;
        [block.centre_x(model, lane) + along, height(action(1)), speed, 0.0, 0.0]
    } else {
        let [x, z, heading] = block.robot_pose(model, lane);
        let (sin, cos) = sin_cos(heading);
        let aside = action(1) * limits.lateral_reach_m;
        let yaw = heading + action(4) * limits.yaw_reach_rad;
        // On the branch where the stage is, so that it never turns back by a whole turn.
        let turns = ((block.stage[3][lane].f64() - yaw) / TAU).round();
        let place =
            [x + along * cos + aside * sin, height(action(2)), z + aside * cos - along * sin];
        let speed = unit(action(3)) * limits.speed_m_s;
        [place[0], place[1], place[2], yaw + turns * TAU, speed]
    };
    for (row, target) in block.target.iter_mut().zip(targets) {
        row[lane] = R::Number::of(target);
    }
    for k in 0..size {
        block.action[k][lane] = R::Number::of(action(k));
    }
}
