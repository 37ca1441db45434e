//! One solver step of a block, and one control step made of them.

use crate::contact;
use crate::drive::{DriveModel, Path, on_waypoints};
use crate::elastic;
use crate::integrate;
use crate::lanes::{Isa, Mask, Real};
use crate::model::Model;
use crate::scene::Parameter;
use crate::state::{Block, Status};

/// Advances a block by `steps` solver steps. Environments that break stand still.
#[inline(always)]
pub fn advance<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>, steps: u32) {
    for lane in 0..W {
        block.running[0][lane] = if block.status[lane] == Status::Running { 1.0 } else { 0.0 };
    }
    for _ in 0..steps {
        isa.vectorize(
            #[inline(always)]
            || step(isa, model, block),
        );
    }
}

/// One solver step.
#[inline(always)]
fn step<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    move_drive(isa, model, block);
    elastic::kinematics(isa, model, block);
    integrate::assemble(isa, model, block);
    solve(isa, model, block);
    commit(isa, model, block);
    block.counters.steps += 1;
}

/// Velocities at the end of the step, with contact where the scene has ground.
#[inline(always)]
fn solve<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    if let Some(law) = &model.program.ground {
        let factor = |parameter: Parameter| isa.load(&block.factors[parameter as usize]);
        let ground = contact::Ground::new(
            law,
            factor(Parameter::StaticFriction),
            factor(Parameter::DynamicFriction),
            model.step_s,
        );
        contact::detect(isa, model, &ground, block);
        contact::solve(isa, model, &ground, block);
        return;
    }
    block.factor.copy_from_slice(&block.matrix);
    model.band.factor(isa, &mut block.factor);
    block.next.copy_from_slice(&block.right);
    model.band.solve(isa, &block.factor, &mut block.next);
    block.counters.factorisations += 1;
    block.counters.solves += 1;
}

/// q ← q + Δt v⁺ in the lanes that run and stay sound; the others keep their last sound state.
#[inline(always)]
fn commit<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let finite = all_finite(isa, block);
    let intact = intact(isa, model, block);
    let above = above_ground(isa, model, block);
    let sound = finite & intact & above;
    if (running & !sound).any() {
        mark_broken(isa, block, running, [finite, intact, above]);
    }
    let go = running & sound;
    for dof in 0..model.coordinates.count {
        let (q, v) = (isa.load(&block.q[dof]), isa.load(&block.v[dof]));
        let next = isa.load(&block.next[dof]);
        isa.store(I::F::select(go, next, v), &mut block.v[dof]);
        isa.store(I::F::select(go, q + next * model.step_s, q), &mut block.q[dof]);
    }
    let count = isa.load(&block.step_count[0]);
    isa.store(I::F::select(go, count + 1.0, count), &mut block.step_count[0]);
}

#[inline(always)]
fn all_finite<const W: usize, I: Isa<W>>(isa: I, block: &Block<W>) -> I::M {
    let mut sum = isa.splat(0.0);
    for row in block.next.iter() {
        sum = sum + isa.load(row).abs();
    }
    // A speed beyond 1e6 m/s is on its way to infinity.
    sum.lt(isa.splat(1e6))
}

#[inline(always)]
fn intact<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &Block<W>) -> I::M {
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
fn above_ground<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &Block<W>) -> I::M {
    let mut lowest = isa.splat(0.0);
    if model.program.ground.is_some() {
        for node in 0..model.nodes() {
            lowest = lowest.min(isa.load(&block.node[2 * node + 1]));
        }
    }
    lowest.ge(isa.splat(-model.thickness_m))
}

#[inline(always)]
fn mark_broken<const W: usize, I: Isa<W>>(
    isa: I,
    block: &mut Block<W>,
    running: I::M,
    [finite, intact, above]: [I::M; 3],
) {
    let code = |status: Status| isa.splat(f64::from(status as u8));
    let reason = I::F::select(above, code(Status::Running), code(Status::Sunk));
    let reason = I::F::select(intact, reason, code(Status::Overstretched));
    let reason = I::F::select(finite, reason, code(Status::NotFinite));
    let mut row = [0.0; W];
    isa.store(I::F::select(running, reason, code(Status::Running)), &mut row);
    for lane in 0..W {
        if row[lane] != 0.0 {
            block.status[lane] = Status::from_code(row[lane] as u8).unwrap_or(Status::NotFinite);
            block.running[0][lane] = 0.0;
            // The impulses of the step that failed may be anything, NaN included.
            for rows in [&mut block.mode, &mut block.normal, &mut block.tangential] {
                rows.iter_mut().for_each(|row| row[lane] = 0.0);
            }
        }
    }
}

/// Puts the drive where it is at the end of the step.
#[inline(always)]
fn move_drive<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &mut Block<W>) {
    let Some(drive) = &model.program.drive else { return };
    let time = (isa.load(&block.step_count[0]) + 1.0) * model.step_s;
    let running = isa.load(&block.running[0]).eq(isa.splat(1.0));
    let stage = load_all(isa, &block.stage, [0, 1, 2, 3]);
    let moved = match &drive.path {
        Path::Controlled(limits) => {
            let [x, y, limit, _] = load_all(isa, &block.target, [0, 1, 2, 2]);
            let (x, vx) = limits.advance(stage[0], stage[2], x, limit, model.step_s);
            let (y, vy) = limits.advance(stage[1], stage[3], y, limit, model.step_s);
            [x, y, vx, vy]
        }
        Path::Constant { start_m, speed_m_s } => {
            let speed = isa.load(&block.factors[Parameter::DriveSpeed as usize]) * *speed_m_s;
            [speed * time + start_m[0], isa.splat(start_m[1]), speed, isa.splat(0.0)]
        }
        Path::Waypoints { time_s, point_m } => follow(isa, time_s, point_m, time),
    };
    for k in 0..4 {
        isa.store(I::F::select(running, moved[k], stage[k]), &mut block.stage[k]);
    }
}

/// Waypoints lane by lane: environments may have been reset at different times.
#[inline(always)]
fn follow<const W: usize, I: Isa<W>>(
    isa: I,
    time_s: &[f64],
    point_m: &[[f64; 2]],
    time: I::F,
) -> [I::F; 4] {
    let mut now = [0.0; W];
    isa.store(time, &mut now);
    let mut rows = [[0.0; W]; 4];
    for lane in 0..W {
        let (position, velocity) = on_waypoints(time_s, point_m, now[lane]);
        rows[0][lane] = position[0];
        rows[1][lane] = position[1];
        rows[2][lane] = velocity[0];
        rows[3][lane] = velocity[1];
    }
    load_all(isa, &rows, [0, 1, 2, 3])
}

/// Rows as vectors. Not `map`: closures of the standard library are not compiled for the lanes.
#[inline(always)]
fn load_all<const W: usize, I: Isa<W>>(isa: I, rows: &[[f64; W]], k: [usize; 4]) -> [I::F; 4] {
    [isa.load(&rows[k[0]]), isa.load(&rows[k[1]]), isa.load(&rows[k[2]]), isa.load(&rows[k[3]])]
}

/// x of the robot's centre: mean of its magnets.
#[inline(always)]
pub fn robot_centre<const W: usize, I: Isa<W>>(isa: I, model: &Model, block: &Block<W>) -> I::F {
    let mut sum = isa.splat(0.0);
    for &dof in &model.coordinates.bodies {
        sum = sum + isa.load(&block.q[dof]);
    }
    sum / (model.magnets().max(1) as f64)
}

/// Sets the targets of a controlled drive from actions in [−1, 1]: place relative to the robot's
/// centre now, height, travel speed. Values beyond are clipped.
pub fn command<const W: usize>(
    model: &Model,
    drive: &DriveModel,
    block: &mut Block<W>,
    lane: usize,
    action: [f64; 3],
) {
    let Path::Controlled(limits) = &drive.path else { return };
    let action = action.map(|a| a.clamp(-1.0, 1.0));
    let unit = |a: f64| 0.5 * (a + 1.0);
    block.target[0][lane] = block.centre_x(model, lane) + action[0] * limits.reach_m;
    block.target[1][lane] =
        limits.lowest_m + unit(action[1]) * (limits.highest_m - limits.lowest_m);
    block.target[2][lane] = unit(action[2]) * limits.speed_m_s;
    for k in 0..3 {
        block.action[k][lane] = action[k];
    }
}
