//! Free flight: momentum, angular momentum, energy.

use crate::world::{ROD, World, number};
use magworm::model::Anchor;

const MAGNETS: [(&str, &str); 2] = [
    ("magnet", "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}"),
    ("body.magnets", "[{position_m=0.02,polarity=1},{position_m=0.07,polarity=-1}]"),
];

fn with<'a>(
    integrator: &'a str,
    step: &'a str,
    more: &[(&'a str, &'a str)],
) -> Vec<(&'a str, &'a str)> {
    let mut edits =
        vec![("solver.integrator", integrator), ("solver.step_s", step), ("control.step_s", step)];
    edits.extend_from_slice(more);
    edits
}

/// Displaces the free nodes across and along by up to a tenth of an element.
fn deform(world: &mut World) {
    let coordinates = &world.model.coordinates;
    let tied = |node: usize| coordinates.ties.iter().any(|tie| tie.node == node);
    let untied = coordinates.anchors.iter().enumerate().filter(|(node, _)| !tied(*node));
    let free: Vec<usize> = untied
        .filter_map(|(_, anchor)| match *anchor {
            Anchor::Free { dof } => Some(dof),
            _ => None,
        })
        .collect();
    for (k, dof) in free.into_iter().enumerate() {
        world.block.q[dof][0] += 2e-4 * (1.0 + 3.0 * k as f64).sin();
        world.block.q[dof + 1][0] += 5e-4 * (2.0 + 1.7 * k as f64).sin();
    }
}

/// Free fall: v = −g t exactly, and both schemes, q⁺ = q + Δt v⁺, give y = −½ g t (t + Δt). A straight rod
/// with magnets stays straight. 1e-12 is rounding over 1000 steps.
#[test]
fn validates_free_fall() {
    for (integrator, step) in [("'implicit'", 2e-3), ("'explicit'", 1e-5)] {
        let text = number(step);
        let mut edits = with(integrator, &text, &MAGNETS);
        edits.push(("gravity_m_s2", "9.81"));
        let mut world = World::new(ROD, &edits);
        let before = world.mass_and_centre().1;
        world.steps(1000);
        let (time, after) = (1000.0 * step, world.mass_and_centre().1);
        let fall = after[1] - before[1] + 0.5 * 9.81 * time * (time + step);
        let speed = world.fastest(1) - 9.81 * time;
        println!("free fall {integrator}: speed error {speed:.1e} m/s, height error {fall:.1e} m");
        assert!((speed / time).abs() < 1e-10 && fall.abs() < 1e-11 && world.fastest(0) < 1e-12);
    }
}

/// A deformed, flying, turning rod with two magnets keeps its momentum to rounding under both schemes. The
/// explicit one keeps its angular momentum too: forces act between points at the places they are
/// computed for. (The implicit one turns forces with the elements within a step.)
#[test]
fn validates_momentum_in_free_flight() {
    for (integrator, step) in [("'implicit'", "5e-4"), ("'explicit'", "1e-5")] {
        for damping in ["0.0", "2e-3"] {
            let more = [MAGNETS[0], MAGNETS[1], ("material.damping_time_s", damping)];
            let mut world = World::new(ROD, &with(integrator, step, &more));
            deform(&mut world);
            world.set_motion([0.3, -0.2], 5.0);
            world.steps(1);
            let ([px, py], angular) = world.momenta();
            world.steps(5000);
            let ([qx, qy], turned) = world.momenta();
            let linear = (qx - px).hypot(qy - py) / px.hypot(py);
            let angular = turned / angular - 1.0;
            println!(
                "free flight {integrator} τ {damping}: momentum {linear:.1e}, angular momentum {angular:.1e}"
            );
            assert!(linear < 1e-9);
            assert!(integrator == "'implicit'" || angular.abs() < 1e-8);
        }
    }
}

/// Kelvin–Voigt damping leaves rigid rotation alone: under the explicit scheme a turning rod, once the stretch
/// that the centrifugal force brings has settled, keeps its kinetic energy whatever τ.
#[test]
fn validates_rigid_rotation_is_undamped() {
    let more = [
        MAGNETS[0],
        MAGNETS[1],
        ("material.damping_time_s", "2e-3"),
        ("material.youngs_modulus_pa", "50e3"),
    ];
    let mut world = World::new(ROD, &with("'explicit'", "1e-5", &more));
    world.set_motion([0.0, 0.0], 4.0);
    world.run(0.5);
    let (before, angular) = (world.kinetic(), world.momenta().1);
    world.run(1.0);
    let (energy, momentum) = (world.kinetic() / before - 1.0, world.momenta().1 / angular - 1.0);
    println!(
        "rigid rotation, explicit, 0.6 turns: energy {energy:.1e}, angular momentum {momentum:.1e}"
    );
    // What is left of the stretching oscillation after 0.5 s.
    assert!(energy.abs() < 1e-5 && momentum.abs() < 1e-9);
}

/// Under the linearly implicit scheme a turning rod loses spin by truncation alone, at a rate that has a closed form:
/// ω²Δt (backward Euler) + 6 c² (Δt + τ) Δt² ω²/L² with c² = E/ρ. The second term comes of the linearised strain: to
/// keep its length in a step the rod's ends move inwards by ½ω²Δt, which the scheme takes for a strain rate.
#[test]
fn validates_implicit_rotation_loses_only_its_truncation() {
    let (tau, length, c2) = (2e-3, 0.1, 100.0);
    for step in [2e-3, 5e-4] {
        let text = number(step);
        let edits = with(
            "'implicit'",
            &text,
            &[("material.damping_time_s", "2e-3"), ("start.x_m", "-0.05")],
        );
        let mut world = World::new(ROD, &edits);
        world.set_motion([0.0, 0.0], 4.0);
        world.run(0.5);
        let before = world.momenta().1;
        world.run(0.2);
        let after = world.momenta().1;
        let inertia = world.mass_and_centre().0 * length * length / 12.0;
        let omega2 = (before / inertia) * (after / inertia);
        let lost = -(after / before).ln() / 0.2;
        let expected = omega2 * (step + 6.0 * c2 * (step + tau) * step * step / (length * length));
        println!(
            "rigid rotation, implicit {step} s: loses {lost:.4e} 1/s, expected {expected:.4e} 1/s"
        );
        // Next order in ωΔt and the mesh's moment of inertia, 1 + 1/(2·20²) and so on.
        assert!((lost / expected - 1.0).abs() < 0.05);
    }
}
