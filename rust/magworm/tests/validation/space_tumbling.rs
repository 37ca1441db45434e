//! A free rigid body that tumbles.

use crate::report::{Axes, Case, Figure, farthest_from, orders};
use crate::space_world::Vector;
use crate::world::{ROD, World, number};
use magworm::internals::Anchor;
use nalgebra::{Matrix3, Rotation3};

/// R(t) of a free rigid body with moments of inertia `moments` about its axes: Ṙ = [ω]R, ω = R I⁻¹ Rᵀ L with L constant,
/// by Runge–Kutta of fourth order.
fn tumble(moments: Vector, start: Matrix3<f64>, momentum: Vector, time: f64) -> Matrix3<f64> {
    let rate = |r: &Matrix3<f64>| {
        let body = (r.transpose() * momentum).component_div(&moments);
        (r * body).cross_matrix() * r
    };
    let parts = 20_000;
    let h = time / f64::from(parts);
    let mut r = start;
    for _ in 0..parts {
        let a = rate(&r);
        let b = rate(&(r + a * (0.5 * h)));
        let c = rate(&(r + b * (0.5 * h)));
        let d = rate(&(r + c * h));
        r += (a + (b + c) * 2.0 + d) * (h / 6.0);
    }
    r
}

/// A rod that is one magnet, spun about its middle axis: it turns over once and again (Dzhanibekov).
fn spun(integrator: &str, step: f64) -> World {
    let step = number(step);
    let edits = [
        ("dimensions", "3"),
        ("solver.integrator", integrator),
        ("solver.step_s", step.as_str()),
        ("control.step_s", &step),
        ("body.length_m", "0.01"),
        ("body.width_m", "0.006"),
        ("body.elements", "1"),
        ("body.thickness_m", "0.003"),
        (
            "magnet",
            "{length_m=0.01,width_m=0.006,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}",
        ),
        ("body.magnets", "[{position_m=0.005,polarity=1}]"),
    ];
    let mut world = World::new(ROD, &edits);
    let rate = Vector::new(0.3, 0.2, 20.0);
    let centre = world.centre().1;
    world.set_flow(|place| rate.cross(&(place - centre)), rate);
    world
}

fn end_kg(world: &World, node: usize) -> f64 {
    match world.model.coordinates.anchors[node] {
        Anchor::Free { dof } => world.block.mass[dof][0],
        _ => 0.0,
    }
}

/// Torque-free motion of a rigid body against Euler's equations, solved here. The middle axis is unstable, so the body
/// turns over; with the momentum kept to rounding the error is that of the rotation over a step, of first order.
#[test]
fn validates_space_tumbling_of_a_magnet() {
    const TIME_S: f64 = 0.6;
    let mut case = Case::new("space_tumbling_of_a_magnet", "Tumbling of a free magnet")
        .equation("I ω̇ + ω × I ω = 0")
        .source("L. Euler (1758); solved in the test by Runge–Kutta 4 with 20000 steps")
        .scene(ROD, &[("dimensions", "3"), ("body.magnets", "[{position_m=0.005,polarity=1}]")])
        .note(
            "The rod is one rigid magnet, 10 × 6 × 2 mm in 1 mm of rubber, spun at 20 rad/s about its middle \
            axis with 1.8 % beside it: it turns over within 0.6 s. Tied by multipliers the ends stray by ½ ω² r Δt² in a step.",
        );
    let mut figure =
        Figure::new("Tumbling: error after 0.6 s", "step [s]", "error [rad]", Axes::LogLog)
            .slope(1.0);
    for integrator in ["'newmark'", "'explicit'"] {
        let scheme = integrator.trim_matches('\'');
        let steps = [1e-3, 5e-4, 2.5e-4, 1.25e-4];
        let mut gained = Vec::new();
        let errors = steps.map(|step| {
            let mut world = spun(integrator, step);
            let dof = world.model.coordinates.bodies[0] + 3;
            // Nodes that are tied, not eliminated, have the mass of the rubber at the ends.
            let ends: f64 = (0..2).map(|node| end_kg(&world, node)).sum();
            let across = Vector::new(0.0, 1.0, 1.0) * (ends * 0.005f64.powi(2));
            let moments = Vector::from_fn(|k, _| world.block.mass[dof + k][0]) + across;
            let momentum = moments.component_mul(&Vector::new(0.3, 0.2, 20.0));
            let energy = world.kinetic_in_space();
            let exact = tumble(moments, Matrix3::identity(), momentum, TIME_S);
            world.run(TIME_S);
            gained.push(world.kinetic_in_space() / energy - 1.0);
            let pose = world.block.magnet_pose(&world.model, 0, 0).orientation;
            let pose = pose.to_rotation_matrix();
            if step == steps[3] {
                let kept = (world.momenta_in_space().1 - momentum).norm() / momentum.norm();
                // Nodes that a multiplier ties stray by the centripetal ½ ω² r Δt² in a step.
                let band = if scheme == "explicit" { 1e-6 } else { 1e-11 };
                case.at_most(format!("change of angular momentum, {scheme}"), "", kept, band);
                case.tell(
                    format!("cosine of the angle turned by its up, {scheme}"),
                    "",
                    exact[(1, 1)],
                );
            }
            let exact = Rotation3::from_matrix_unchecked(exact);
            (pose.inverse() * exact).angle()
        });
        case.at_most(format!("error of the pose, {scheme}, Δt = 0.125 ms"), "rad", errors[3], 0.05);
        case.inside(
            format!("order in Δt, {scheme}"),
            "",
            farthest_from(1.0, &orders(&errors)),
            0.8..=1.2,
        );
        let last = gained[gained.len() - 1];
        case.inside(format!("change of energy, {scheme}, Δt = 0.125 ms"), "", last, -5e-3..=5e-3);
        let order = farthest_from(1.0, &orders(&gained));
        case.inside(format!("order of the change of energy, {scheme}"), "", order, 0.7..=1.3);
        figure.points(scheme, steps.into_iter().zip(errors).map(|(s, e)| [s, e]));
    }
    case.figure(figure);
    case.finish();
}
