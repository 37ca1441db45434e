//! Initial states: the body at rest, straight or bent, and what each environment draws at random.

mod laid;

pub use crate::draws::Draws;
use laid::{Bent, Laid, Straight};

use crate::actuate;
use crate::lanes::math::radians;
use crate::lanes::{Number, Row};
use crate::model::{Anchor, MassPart, Model, Shape};
use crate::scene::Parameter;
use crate::state::{Block, Status};

/// Pose of the body at the start; its shape is always the scene's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StartPose {
    /// Place of the head end along x [m].
    pub x_m: f64,
    /// Height of the lowest point over the ground [m].
    pub height_m: f64,
    /// Rotation about the head end in the plane x–y, anticlockwise [rad].
    pub angle_rad: f64,
    /// Place of the head end along z, in space [m].
    pub z_m: f64,
    /// Rotation about the vertical through the head end after that, in space [rad]; anticlockwise from above.
    pub yaw_rad: f64,
}

/// The scene's start pose.
pub fn scene_start(model: &Model) -> StartPose {
    let start = &model.scene.start;
    StartPose {
        x_m: start.x_m,
        height_m: start.height_m,
        angle_rad: radians(start.angle_deg),
        z_m: start.z_m,
        yaw_rad: radians(start.yaw_deg),
    }
}

impl<R: Row> Block<R> {
    /// A block whose robots lie at rest, unused until they are [`reset`].
    pub fn new(model: &Model) -> Self {
        let mut block = Self::zeros(model);
        (0..R::LANES).for_each(|lane| rest(model, &mut block, lane));
        block
    }
}

/// Puts one lane to rest with the scene's own parameters, unused until [`reset`].
fn rest<R: Row>(model: &Model, block: &mut Block<R>, lane: usize) {
    clear(block, lane);
    for row in block.factors.iter_mut() {
        row[lane] = R::Number::of(1.0);
    }
    for (row, is_in) in block.present.iter_mut().zip(model.present()) {
        row[lane] = R::Number::of(f64::from(u8::from(is_in)));
    }
    lay(model, block, lane, scene_start(model));
    apply_parameters(model, block, lane);
    block.status[lane] = Status::Unused;
}

/// Starts an episode in one lane.
pub fn reset<R: Row>(
    model: &Model,
    block: &mut Block<R>,
    lane: usize,
    start: StartPose,
    factors: &[f64],
    present: &[bool],
    mut draws: Draws,
) {
    clear(block, lane);
    for (k, &factor) in factors.iter().enumerate() {
        block.factors[k][lane] = R::Number::of(factor);
    }
    for variation in &model.scene.reset.vary {
        let drawn = draws.uniform(variation.low, variation.high);
        let factor = &mut block.factors[variation.parameter as usize][lane];
        *factor = R::Number::of(factor.f64() * drawn);
    }
    for (body, &is_in) in present.iter().enumerate() {
        block.present[body][lane] = R::Number::of(f64::from(u8::from(is_in)));
    }
    lay(model, block, lane, start);
    apply_parameters(model, block, lane);
    actuate::place(model, block, lane, &mut draws);
    block.status[lane] = Status::Running;
}

/// Zeroes the state of one lane.
fn clear<R: Row>(block: &mut Block<R>, lane: usize) {
    for rows in block.state_rows_mut() {
        rows.iter_mut().for_each(|row| row[lane] = R::Number::default());
    }
    block.step_count[lane] = 0;
}

/// Lays the body of one lane down.
fn lay<R: Row>(model: &Model, block: &mut Block<R>, lane: usize, start: StartPose) {
    match &model.shape {
        None => put(model, block, lane, &Straight::new(model, start)),
        Some(shape) => {
            put(model, block, lane, &Bent::new(model, shape, start));
            for (row, [_, _, twist]) in block.twist.iter_mut().zip(&shape.strains) {
                row[lane] = R::Number::of(*twist);
            }
            relax(model, block, lane, shape);
        }
    }
}

/// Lets rubber that relaxes do so in the shape that it is laid in; a straight body is without strain.
fn relax<R: Row>(model: &Model, block: &mut Block<R>, lane: usize, shape: &Shape) {
    let ways = model.sizes().rotations;
    let strains = shape.measured(model.scene.solver.curvature);
    let strains = strains.flat_map(|strain| strain.into_iter().take(ways));
    let branches = model.program.relaxation.branches.len();
    let of_branches = strains.flat_map(|strain| std::iter::repeat_n(strain, branches));
    for (row, strain) in block.bend_dashpot.iter_mut().zip(of_branches) {
        row[lane] = R::Number::of(strain);
    }
}

/// Puts nodes, magnets and frames where they are laid.
fn put<R: Row>(model: &Model, block: &mut Block<R>, lane: usize, laid: &impl Laid) {
    let axes = model.dimensions();
    for (node, anchor) in model.coordinates.anchors.iter().enumerate() {
        let place = laid.node(node);
        for axis in 0..axes {
            match *anchor {
                Anchor::Free { dof } => block.q[dof + axis][lane] = R::Number::of(place[axis]),
                Anchor::Fixed => {
                    block.fixed_position[axes * node + axis][lane] = R::Number::of(place[axis])
                }
                Anchor::Rigid { .. } => {}
            }
        }
    }
    for (body, &dof) in model.coordinates.bodies.iter().enumerate() {
        let element = model.bodies[body].element;
        let middle = laid.middle(element);
        for axis in 0..axes {
            block.q[dof + axis][lane] = R::Number::of(middle[axis]);
        }
        if axes == 2 {
            block.q[dof + 2][lane] = R::Number::of(laid.angle_rad(element));
        }
    }
    for (element, rows) in block.director.chunks_exact_mut(6).enumerate() {
        let (up, tangent) = (laid.up(element), laid.tangent(element));
        for axis in 0..3 {
            rows[axis][lane] = R::Number::of(up[axis]);
            rows[3 + axis][lane] = R::Number::of(tangent[axis]);
        }
    }
}

/// Derives masses and remanences of one lane from its factors and magnets. Also after a snapshot.
pub fn apply_parameters<R: Row>(model: &Model, block: &mut Block<R>, lane: usize) {
    let factor = |block: &Block<R>, p: Parameter| block.factors[p as usize][lane].f64();
    let mass_factor = factor(block, Parameter::Mass);
    for rows in [&mut block.mass, &mut block.off_centre] {
        rows.iter_mut().for_each(|row| row[lane] = R::Number::default());
    }
    let present = &block.present;
    let add = |rows: &mut [R], part: &MassPart| {
        let is_in = part.cavity.is_some_and(|magnet| present[magnet][lane] == R::Number::of(1.0));
        let cavity = if is_in { part.magnet } else { part.fill };
        let mass = &mut rows[part.row][lane];
        *mass = R::Number::of(mass.f64() + mass_factor * (part.rubber + cavity));
    };
    let inertia = model.bodies.iter().flat_map(|body| &body.inertia);
    model.rubber.iter().chain(inertia).for_each(|part| add(&mut block.mass, part));
    let moments = model.off_centre().flat_map(|body| &body.parts);
    moments.for_each(|part| add(&mut block.off_centre, part));
    let remanence_factor = factor(block, Parameter::Remanence);
    for (row, magnet) in model.magnets[..model.magnets()].iter().enumerate() {
        let is_in = block.present[row][lane].f64();
        let remanence_t = remanence_factor * magnet.remanence_t * is_in;
        block.remanence[row][lane] = R::Number::of(remanence_t);
    }
}
