//! Feet that rebound.

use crate::derivatives::energy_of_world;
use crate::report::Case;
use crate::world::{World, number};

const G: f64 = 9.81;
/// Height of a fall [m].
const FALL_M: f64 = 0.02;

/// A single rigid foot above level ground.
const FOOT: [(&str, &str); 4] =
    [("drive", ""), ("body.magnets", "1"), ("magnet.length_m", "0.014"), ("control.step_s", "1.0")];

/// Name, step and edit of scenes that take another way through the code.
const KINDS: [(&str, f64, (&str, &str)); 3] = [
    ("in space", 1e-4, ("dimensions", "3")),
    ("backward Euler", 1e-4, ("solver.integrator", "'euler'")),
    ("explicit", 1e-5, ("solver.integrator", "'explicit'")),
];

fn foot(edits: &[&[(&str, &str)]]) -> World {
    World::new("robot", &[&FOOT[..], &edits.concat()].concat())
}

/// Height of the lowest magnet above the place where its foot stands [m].
fn height_m(world: &World) -> f64 {
    world.block.q[world.model.bodies[0].dof + 1][0] - 0.0035
}

fn rises(world: &World) -> bool {
    world.block.v[world.model.bodies[0].dof + 1][0] > 0.0
}

/// Height to which a foot rebounds that falls flat [m].
fn rebound_m(e: f64, step_s: f64, edits: &[(&str, &str)]) -> f64 {
    let (e, step_s, height) = (number(e), number(step_s), number(FALL_M));
    let fall = [
        ("contact.restitution", e.as_str()),
        ("solver.step_s", &step_s),
        ("start.height_m", &height),
    ];
    let mut world = foot(&[&fall, edits]);
    while !rises(&world) {
        world.steps(1);
    }
    while rises(&world) {
        world.steps(1);
    }
    height_m(&world)
}

/// Kinetic, elastic and potential energy of a body in the plane [J]. Velocities stand half a step before places.
fn total_energy(world: &World) -> f64 {
    let (mass, [_, y]) = world.mass_and_centre();
    let height = y - 0.5 * world.model.step_s * world.drift()[1];
    world.kinetic() + energy_of_world(world) + G * mass * height
}

/// Greatest rise of the energy over its lowest value before, over that of the fall, of bodies dropped askew from 10 mm.
fn energies_gained(e: &str, step: &str) -> Vec<f64> {
    let mut gained = Vec::new();
    for base in ["incline-block", "robot"] {
        for angle in ["0.0", "5.0", "30.0", "80.0", "-40.0"] {
            for friction in ["0.1", "0.8", "3.0"] {
                let askew = [
                    ("ground.incline_deg", "0.0"),
                    ("ground.static_friction", friction),
                    ("ground.dynamic_friction", "0.1"),
                    ("material.damping_time_s", "5e-3"),
                    ("start.height_m", "0.01"),
                    ("start.angle_deg", angle),
                    ("drive", ""),
                    ("contact.restitution", e),
                    ("solver.step_s", step),
                ];
                gained.push(energy_gained(World::new(base, &askew)));
            }
        }
    }
    gained
}

fn energy_gained(mut world: World) -> f64 {
    let (mut lowest, mut rise) = (total_energy(&world), 0.0f64);
    for _ in 0..(0.5 / world.model.step_s) as usize {
        world.steps(1);
        let energy = total_energy(&world);
        rise = rise.max(energy - lowest);
        lowest = lowest.min(energy);
    }
    rise / (G * world.mass_and_centre().0 * 0.01)
}

/// How far the speed with which two feet part is off e times that with which they meet, as a part of it, and the
/// greatest change of their momentum over that of one.
fn feet_part(e: f64) -> [f64; 2] {
    let text = number(e);
    let feet = [
        ("drive", ""),
        ("gravity_m_s2", "0.0"),
        ("body.magnets", "2"),
        ("magnetic_terms.mutual", "false"),
        ("material.youngs_modulus_pa", "100"),
        ("material.damping_time_s", "0.0"),
        ("start.height_m", "0.1"),
        ("contact.between_feet", "true"),
        ("contact.restitution", &text),
        ("solver.step_s", "1e-4"),
        ("control.step_s", "1e-2"),
    ];
    let mut world = World::new("robot", &feet);
    let dofs = [0, 1].map(|body: usize| world.model.bodies[body].dof);
    let speed = |world: &World| world.block.v[dofs[1]][0] - world.block.v[dofs[0]][0];
    world.block.v[dofs[0]][0] = 0.3;
    world.block.v[dofs[1]][0] = -0.2;
    let (start, one) = (world.momenta().0[0], world.block.mass[dofs[0]][0] * 0.3);
    let (mut meeting, mut moved) = (speed(&world), 0.0f64);
    while world.normal_force() == 0.0 {
        meeting = speed(&world);
        assert!(meeting < 0.0, "they meet");
        world.steps(1);
        moved = moved.max((world.momenta().0[0] - start).abs() / one);
    }
    [speed(&world) / (-e * meeting) - 1.0, moved]
}

/// Places and velocities of a robot that stands on level ground without a drive, after a second.
fn standing(e: &str) -> Vec<f64> {
    let still = [("drive", ""), ("contact.restitution", e)];
    let mut world = World::new("robot", &still);
    world.steps(500);
    world.block.q.iter().chain(world.block.v.iter()).map(|row| row[0]).collect()
}

/// A foot that falls flat from 20 mm comes up again to e² of that, within an error in proportion to the step; feet that meet part
/// with e times their speed; no impact gives energy; what stands does not rebound.
#[test]
fn validates_rebound() {
    let mut case = Case::new("rebound", "Impact with restitution")
        .equation("h⁺ = e² h; Δu⁺ = −e Δu⁻; d(T + V)/dt ≤ 0")
        .source("Newton's law of impact; second law")
        .scene("robot", &FOOT)
        .note(
            "A single rigid foot dropped flat from 20 mm; two feet that meet in free flight; robot and block dropped askew from 10 \
            mm at 0°, 5°, 30°, 80° and −40° on ground with μ_s = 0.1, 0.8, 3 and μ_d = 0.1. The energy is read at places and \
            velocities that stand half a step apart, so what it rises by goes to 0 with the step.",
        );
    for e in [0.3, 0.6, 1.0] {
        let height =
            |step_s: f64, edits: &[(&str, &str)]| rebound_m(e, step_s, edits) / (e * e * FALL_M);
        // It turns round within the step of arrival, up to a step's way above the ground.
        let most = |step_s: f64| {
            let way_m = step_s * (2.0 * G * FALL_M).sqrt();
            1.0 + way_m * (0.5 * e * (1.0 - e) + 1.0 - e * e) / (e * e * FALL_M)
        };
        for step_s in [2e-3, 1e-4] {
            let name = format!("height over e² h, e = {e}, {} ms", 1e3 * step_s);
            case.inside(name, "1", height(step_s, &[]), 0.9995..=most(step_s));
        }
        for (name, step_s, edit) in KINDS {
            let name = format!("height over e² h, e = {e}, {name}");
            case.inside(name, "1", height(step_s, &[edit]), 0.9995..=most(step_s));
        }
        let [speed, momentum] = feet_part(e);
        case.at_most(format!("speed of feet that part, e = {e}"), "relative", speed.abs(), 1e-4);
        case.at_most(format!("momentum of both, e = {e}"), "relative", momentum, 1e-10);
    }
    let single = rebound_m(1.0, 1e-3, &[("solver.precision", "'single'")]) / FALL_M;
    case.inside("height over h, e = 1, single precision", "1", single, 0.98..=1.0);
    for e in ["0.5", "1.0"] {
        for (step, most) in [("2e-3", 0.15), ("5e-4", 0.005), ("1e-4", 2e-4)] {
            let name = format!("rise of the energy, e = {e}, Δt = {step} s");
            case.spread(name, "of the fall's energy", &energies_gained(e, step), most);
        }
    }
    assert_eq!(standing("0.0"), standing("1.0"));
    case.finish();
}
