//! The explicit scheme with Lagrange multipliers over long times.

use crate::report::Case;
use crate::world::{ROD, World};
use magworm::internals::Anchor;

const EXPLICIT: [(&str, &str); 3] =
    [("solver.integrator", "'explicit'"), ("solver.step_s", "1e-5"), ("control.step_s", "1e-5")];

/// Largest distance of a magnet's end from the node tied to it [m].
fn drift_m(world: &World) -> f64 {
    let model = &world.model;
    model
        .coordinates
        .ties
        .iter()
        .map(|tie| {
            let [x, y, theta] = world.block.planar_pose(model, tie.body, 0);
            let arm = f64::from(tie.side) * model.bodies[tie.body].half_length_m;
            let Anchor::Free { dof } = model.coordinates.anchors[tie.node] else {
                return f64::INFINITY;
            };
            let q = |k: usize| world.block.q[dof + k][0];
            (q(0) - x - arm * theta.cos()).hypot(q(1) - y - arm * theta.sin())
        })
        .fold(0.0, f64::max)
}

/// Energy of a planar discrete rod (Bergou 2008), written down here from the node positions.
fn elastic(world: &World) -> f64 {
    crate::derivatives::energy_of_world(world)
}

/// The ends of the magnets stay on the magnets: a step leaves ½ω²rΔt² and takes back what the last one left, so
/// the drift neither grows nor passes ½ω²rΔt² with the fastest ω so far. A rod with a little damping, let go from
/// the horizontal, stays below 1e-9 m over 1e5 steps of 5 µs.
#[test]
fn validates_constraint_drift() {
    let edits = [
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "5e-6"),
        ("gravity_m_s2", "9.81"),
        ("material.damping_time_s", "1e-3"),
        ("body.clamp", "'head'"),
        (
            "magnet",
            "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}",
        ),
        ("body.magnets", "[{position_m=0.02,polarity=1},{position_m=0.07,polarity=-1}]"),
    ];
    let mut world = World::new(ROD, &edits);
    let (mut worst, mut fastest) = (0.0f64, 0.0f64);
    for _ in 0..10_000 {
        world.steps(10);
        worst = worst.max(drift_m(&world));
        let rate = |body| world.block.planar_velocity(&world.model, body, 0)[2].abs();
        fastest = fastest.max(rate(0)).max(rate(1));
    }
    let bound = 0.5 * fastest * fastest * 4e-3 * 5e-6f64.powi(2);
    let mut case = Case::new("constraint_drift", "Drift of the rigid magnets")
        .equation("distance of a magnet's end from its node ≤ ½ω²rΔt², r half the magnet")
        .source("A step along the velocity leaves ½ω²rΔt² and takes back what the last one left")
        .scene(ROD, &edits)
        .note(
            "The explicit scheme ties the nodes to the magnets by multipliers on the \
            velocities. A rod with two magnets, let go from the horizontal, over 1e5 steps.",
        );
    case.at_most("greatest distance", "m", worst, 1e-9);
    // 1e-15 m of rounding; the fastest ω may fall between two looks.
    case.at_most("the same over ½ω²rΔt²", "", (worst - 1e-15) / bound, 1.5);
    case.finish();
}

/// An undamped rod that falls from the horizontal keeps its energy: symplectic Euler oscillates by O(ωΔt) of the
/// elastic energy of its fastest mode and does not drift. Compared are means over two windows of 0.25 s, 1 s apart.
#[test]
fn validates_explicit_energy() {
    let falling = [("gravity_m_s2", "9.81"), ("body.clamp", "'head'"), ("body.length_m", "0.05")];
    let mut case = Case::new("explicit_energy", "Energy of a rod that falls")
        .equation("Σ ½ m v² + Σ m g y + elastic energy = const.")
        .source("As above")
        .scene(ROD, &[&EXPLICIT[..], &falling].concat())
        .note(
            "An undamped rod is let go from the horizontal. Means over 0.25 s, 0.75 s apart, \
            are compared; the drift is a part of the energy that is exchanged.",
        );
    for magnets in [false, true] {
        let mut edits = EXPLICIT.to_vec();
        edits.extend(falling);
        if magnets {
            edits.push((
                "magnet",
                "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}",
            ));
            edits.push(("body.magnets", "[{position_m=0.02,polarity=1}]"));
        }
        let mut world = World::new(ROD, &edits);
        let potential = |w: &World| -> f64 {
            let (mass, [_, y]) = w.mass_and_centre();
            9.81 * mass * y
        };
        let mut deepest = 0.0f64;
        let mut mean = |w: &mut World| -> f64 {
            let mut sum = 0.0;
            for _ in 0..250 {
                w.steps(100);
                deepest = deepest.min(potential(w));
                sum += w.kinetic() + elastic(w) + potential(w);
            }
            sum / 250.0
        };
        let first = mean(&mut world);
        world.run(0.5);
        let second = mean(&mut world);
        // O(ωΔt): about 1e-3 in a step, but without sign; a hundredth of that in the mean.
        let name = if magnets { "rod with a magnet" } else { "rod" };
        case.inside(format!("drift, {name}"), "", (second - first) / deepest, -1e-4..=1e-4);
    }
    case.finish();
}
