//! A free body without any symmetry.

use crate::report::{Case, orders};
use crate::space_flight::changes;
use crate::space_world::Vector;
use crate::world::{ROD, World, number};

/// A magnet with a soft tail that is bent, bent aside and twisted.
const TAILED: [(&str, &str); 9] = [
    ("dimensions", "3"),
    ("body.length_m", "0.03"),
    ("body.elements", "6"),
    ("magnet", "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}"),
    ("body.magnets", "[{position_m=0.004,polarity=1}]"),
    ("material.damping_time_s", "2e-3"),
    ("start.bends_deg", "[70]"),
    ("start.bends_aside_deg", "[0, 50]"),
    ("start.twists_deg", "[40]"),
];

/// Flies and tumbles at 37 rad/s about no axis of its own.
fn thrown(integrator: &str, step_s: f64) -> World {
    let step = number(step_s);
    let edits =
        [("solver.integrator", integrator), ("solver.step_s", &step), ("control.step_s", &step)];
    let mut world = World::new(ROD, &[&TAILED[..], &edits].concat());
    let rate = Vector::new(20.0, -10.0, 30.0);
    let centre = world.centre().1;
    world.set_flow(|place| Vector::new(0.3, -0.2, 0.25) + rate.cross(&(place - centre)), rate);
    world.steps(1);
    world
}

/// No torque acts from outside: both momenta stay over six turns, whatever the body does in itself.
#[test]
fn validates_space_momenta_of_an_asymmetric_body() {
    const TIME_S: f64 = 1.0;
    let mut case = Case::new("space_momenta_of_an_asymmetric_body", "Free body without symmetry")
        .equation("Σ m v = const., Σ m x × v + Σ R I Rᵀ ω + Σ I_t θ̇ t = const.")
        .source("Newton, Euler; no force from outside")
        .scene(ROD, &TAILED)
        .note(
            "A magnet with a soft tail, which starts bent, bent aside and twisted, tumbles at 37 rad/s for 1 s and \
            swings its tail. Angular momentum is less what the elements' spins carry, as in the case above; the implicit \
            scheme loses it in proportion to Δt.",
        );
    let [linear, _, bare] = changes(&mut thrown("'explicit'", 1e-5), (TIME_S / 1e-5) as u32);
    case.at_most("change of momentum, explicit", "", linear, 1e-11);
    case.at_most("change of angular momentum, explicit", "", bare, 2e-8);
    let steps = [4e-4, 2e-4, 1e-4];
    let lost = steps.map(|step_s| {
        let [linear, _, bare] = changes(&mut thrown("'newmark'", step_s), (TIME_S / step_s) as u32);
        case.at_most(format!("change of momentum, implicit, Δt = {step_s} s"), "", linear, 1e-11);
        case.at_most(
            format!("change of angular momentum, implicit, Δt = {step_s} s"),
            "",
            bare,
            6.0 * step_s,
        );
        bare
    });
    let lowest = orders(&lost).into_iter().fold(f64::INFINITY, f64::min);
    case.inside("lowest order of that change in Δt", "", lowest, 0.7..=4.0);
    case.finish();
}
