//! A foot that rocks on one edge.

use crate::report::{Case, short};
use crate::world::{RIGID_FOOT, World, number};

/// Half of the foot's length, and its height below the centre [m].
const EDGE_M: [f64; 2] = [0.007, 0.0035];
const TILTED: (&str, &str) = ("start.angle_deg", "45.0");
/// Where the fall ends: before the other edge lands.
const LOWEST_RAD: f64 = 0.2;

/// Where the edge at the head is [m].
fn edge(world: &World) -> [f64; 2] {
    let [x, y, angle] = world.block.planar_pose(&world.model, 0, 0);
    let (sin, cos) = angle.sin_cos();
    [x - EDGE_M[0] * cos + EDGE_M[1] * sin, y - EDGE_M[0] * sin - EDGE_M[1] * cos]
}

/// Way of the edge along the ground [m], and what the fall's energy is off by, as a part of it.
fn fall(step: f64) -> [f64; 2] {
    let text = number(step);
    let mut world =
        World::new("robot", &[&RIGID_FOOT[..], &[TILTED, ("solver.step_s", &text)]].concat());
    let (mass, [_, height]) = world.mass_and_centre();
    let start = edge(&world);
    while world.block.planar_pose(&world.model, 0, 0)[2] > LOWEST_RAD {
        world.steps(1);
    }
    // Half a step of the fall: positions stand half a step after velocities.
    let rate = world.block.planar_velocity(&world.model, 0, 0)[1];
    let fallen = height - world.mass_and_centre().1[1] + 0.5 * step * rate;
    [edge(&world)[0] - start[0], world.kinetic() / (mass * 9.81 * fallen) - 1.0]
}

/// A foot let go at 45° falls about the edge that it stands on: with friction enough the edge stays where it is, and what
/// gravity gives becomes kinetic energy. Were the arc of a step taken for its tangent, the edge would creep by
/// ½ (ωΔt)² r a step, 0.05 mm in this fall at 2 ms.
#[test]
fn validates_foot_rocks_on_its_edge() {
    let mut case = Case::new("foot_rocks_on_its_edge", "Foot that falls about an edge")
        .equation("x_edge = const., T = m g (h₀ − h)")
        .source("Rigid body about a fixed axis; friction that sticks and a pivot do no work")
        .scene("robot", &[&RIGID_FOOT[..], &[TILTED]].concat())
        .note(
            "One rigid foot, 14 mm long and 7 mm high, from 45° to 11°. The contact spring under the edge gives by some \
            micrometres on the way.",
        );
    let steps = [4e-3, 2e-3, 1e-3, 5e-4];
    let found = steps.map(fall);
    let rows = steps
        .iter()
        .zip(found)
        .map(|(step, [way, energy])| vec![format!("{step}"), short(way * 1e6), short(energy)]);
    case.table("Way of the edge:", &["Δt [s]", "way [µm]", "energy, relative"], rows.collect());
    case.at_most("way of the edge, Δt = 0.002 s", "m", found[1][0].abs(), 1e-5);
    case.inside("energy, Δt = 0.002 s", "relative", found[1][1], -5e-3..=5e-3);
    case.finish();
}
