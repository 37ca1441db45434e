//! A body that slides and turns at once: the direction of friction turns with it.

use crate::report::{Axes, Case, Figure, farthest_from, orders};
use crate::space_world::Vector;
use crate::world::{World, number};

const G: f64 = 9.81;
const FRICTION: f64 = 0.6;
const HALF_M: f64 = 0.027;
/// One rigid magnet as long as the rod, which stands on the points below its two ends.
const DUMBBELL: [(&str, &str); 5] = [
    ("dimensions", "3"),
    ("ground.incline_deg", "0.0"),
    ("magnet", "{length_m=0.054,width_m=0.010,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}"),
    ("body.magnets", "[{position_m=0.027,polarity=1}]"),
    ("body.elements", "1"),
];

/// Velocity along x and z [m/s] and rate about the vertical [rad/s] at the start.
const START: [f64; 3] = [0.5, 0.2, 12.0];

/// x, z, yaw and their rates: half the weight on either end, each with Coulomb's friction against its velocity.
fn rates(state: [f64; 6], gyration_m2: f64) -> [f64; 6] {
    let [_, _, yaw, vx, vz, rate] = state;
    let (sin, cos) = yaw.sin_cos();
    let mut out = [vx, vz, rate, 0.0, 0.0, 0.0];
    for side in [-HALF_M, HALF_M] {
        // An arm (cos, −sin) along x and z turns towards (−sin, −cos).
        let (ux, uz) = (vx - rate * side * sin, vz - rate * side * cos);
        let speed = ux.hypot(uz).max(1e-12);
        let [fx, fz] = [ux, uz].map(|u| -0.5 * FRICTION * G * u / speed);
        out[3] += fx;
        out[4] += fz;
        out[5] += side * (-sin * fx - cos * fz) / gyration_m2;
    }
    out
}

/// Where it comes to rest: x, z [m] and yaw [rad].
fn rest(gyration_m2: f64) -> [f64; 3] {
    let h = 1e-6;
    let plus =
        |y: [f64; 6], k: [f64; 6], c: f64| -> [f64; 6] { std::array::from_fn(|i| y[i] + c * k[i]) };
    let mut y = [0.0, 0.0, 0.0, START[0], START[1], START[2]];
    while y[3].hypot(y[4]) + HALF_M * y[5].abs() > 1e-4 {
        let a = rates(y, gyration_m2);
        let b = rates(plus(y, a, 0.5 * h), gyration_m2);
        let c = rates(plus(y, b, 0.5 * h), gyration_m2);
        let d = rates(plus(y, c, h), gyration_m2);
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    [y[0], y[1], y[2]]
}

/// The same by the simulator, and the square of the radius of gyration.
fn thrown(step_s: f64) -> ([f64; 3], f64) {
    let step = number(step_s);
    let edits = [("solver.step_s", step.as_str()), ("control.step_s", &step)];
    let mut world = World::new("incline-block", &[&DUMBBELL[..], &edits].concat());
    world.run(0.1);
    let (mass, before) = world.centre();
    let dof = world.model.coordinates.bodies[0];
    let gyration_m2 = world.block.mass[dof + 4][0] / mass;
    let velocity = Vector::new(START[0], 0.0, START[1]);
    world.set_flow(|_| velocity, Vector::y() * START[2]);
    world.run(0.3);
    assert!(world.quickest().0 < 1e-9, "still sliding at {} m/s", world.quickest().0);
    let went = world.centre().1 - before;
    ([went.x, went.z, world.block.robot_pose(&world.model, 0, 0)[2]], gyration_m2)
}

/// A rigid rod on two points slides and turns: half the weight is on either whatever it does, so its motion is a set of
/// ordinary differential equations, solved here. A step moves with its final velocity: first order.
#[test]
fn validates_space_sliding_and_turning() {
    let mut case = Case::new("space_sliding_and_turning", "Rod that slides and turns")
        .equation("m v̇ = −½ μ_d m g Σ u/|u|, I ω̇ = −½ μ_d m g Σ (r × u/|u|)·ŷ, u = v + ω × r of either end")
        .source("Coulomb; solved in the test by Runge–Kutta 4 with steps of 1 µs")
        .scene("incline-block", &DUMBBELL)
        .note(
            "A rigid rod of 54 mm on the points below its ends is thrown with 0.54 m/s and 12 rad/s. As it \
            slows down the directions of its two points turn and part.",
        );
    let steps = [1e-3, 5e-4, 2.5e-4, 1.25e-4];
    let exact = rest(thrown(1e-3).1);
    let mut figure =
        Figure::new("Sliding and turning", "step [s]", "error / way", Axes::LogLog).slope(1.0);
    let way = exact[0].hypot(exact[1]);
    let errors = steps.map(|step| {
        let [x, z, yaw] = thrown(step).0;
        if step == steps[3] {
            let both = [[x, z], [exact[0], exact[1]]].map(|place| place.map(|m| m * 1e3));
            case.place("where it stops (x, z), Δt = 0.125 ms", "mm", both, 0.1);
            case.relative("angle that it turns by, Δt = 0.125 ms", "rad", [yaw, exact[2]], 5e-3);
        }
        (x - exact[0]).hypot(z - exact[1]) / way
    });
    case.inside("order in Δt", "", farthest_from(1.0, &orders(&errors)), 0.8..=1.2);
    figure.points("place of rest", steps.into_iter().zip(errors).map(|(s, e)| [s, e]));
    case.figure(figure);
    case.finish();
}
