//! Free flight: momentum, angular momentum, energy.

use crate::report::{Case, orders, short};
use crate::world::{ROD, World, number};
use magworm::internals::Anchor;

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
    let mut case = Case::new("free_fall", "Free fall")
        .equation("v = −g t, and y = −½ g t (t + Δt) for q⁺ = q + Δt v⁺")
        .source("Newton; the second is the sum of the first over the steps")
        .scene(ROD, &[&MAGNETS[..], &[("gravity_m_s2", "9.81")]].concat())
        .note("1000 steps of a straight rod with two magnets; what is left is rounding.");
    for (integrator, step) in [("'newmark'", 2e-3), ("'explicit'", 1e-5)] {
        let text = number(step);
        let mut edits = with(integrator, &text, &MAGNETS);
        edits.push(("gravity_m_s2", "9.81"));
        let mut world = World::new(ROD, &edits);
        let before = world.mass_and_centre().1;
        world.steps(1000);
        let (time, after) = (1000.0 * step, world.mass_and_centre().1);
        let fall = after[1] - before[1] + 0.5 * 9.81 * time * (time + step);
        let speed = world.fastest(1) - 9.81 * time;
        let scheme = integrator.trim_matches('\'');
        case.inside(format!("(v − g t)/t, {scheme}"), "m/s²", speed / time, -1e-10..=1e-10);
        case.inside(format!("height less the formula's, {scheme}"), "m", fall, -1e-11..=1e-11);
        case.at_most(format!("sideways speed, {scheme}"), "m/s", world.fastest(0), 1e-12);
    }
    case.finish();
}

/// A deformed, flying, turning rod with two magnets, after one step and after `steps` more: changes of momentum and of
/// angular momentum as parts of what they were.
fn changes(integrator: &str, step: &str, damping: &str, steps: u32) -> [f64; 2] {
    let more = [MAGNETS[0], MAGNETS[1], ("material.damping_time_s", damping)];
    let mut world = World::new(ROD, &with(integrator, step, &more));
    deform(&mut world);
    world.set_motion([0.3, -0.2], 5.0);
    world.steps(1);
    let ([px, py], angular) = world.momenta();
    world.steps(steps);
    let ([qx, qy], turned) = world.momenta();
    [(qx - px).hypot(qy - py) / px.hypot(py), turned / angular - 1.0]
}

/// A deformed, flying, turning rod with two magnets keeps its momentum to rounding under both schemes. The
/// explicit one keeps its angular momentum too: forces act between points at the places they are
/// computed for. The implicit one damps the turning of tension: it loses spin in proportion to the step.
#[test]
fn validates_momentum_in_free_flight() {
    let mut case = Case::new("momentum_in_free_flight", "Momentum in free flight")
        .equation("Σ m v = const., Σ m x × v + Σ I ω = const.")
        .source("Newton; no force from outside")
        .scene(ROD, &[&MAGNETS[..], &[("material.damping_time_s", "2e-3")]].concat())
        .note(
            "A rod with two magnets, its nodes displaced by up to a tenth of an element, flies \
            at 0.36 m/s and turns at 5 rad/s for 5000 steps. The angular momentum is about the \
            origin. Linear momentum is kept to rounding by both schemes, angular momentum by the \
            explicit one. The implicit scheme damps the turning of tension by a retardation time of \
            Δt/100, which is a torque: it loses spin in proportion to Δt, at long steps \
            with a higher power, by its dissipation.",
        );
    for (integrator, step) in [("'newmark'", "5e-4"), ("'explicit'", "1e-5")] {
        for damping in ["0.0", "2e-3"] {
            let [linear, angular] = changes(integrator, step, damping, 5000);
            let scheme = integrator.trim_matches('\'');
            case.at_most(
                format!("change of momentum, {scheme}, τ = {damping} s"),
                "",
                linear,
                1e-9,
            );
            if scheme == "explicit" {
                let what = format!("change of angular momentum, {scheme}, τ = {damping} s");
                case.inside(what, "", angular, -1e-8..=1e-8);
            }
        }
    }
    let steps = [("1e-3", 500), ("5e-4", 1000), ("2.5e-4", 2000), ("1.25e-4", 4000)];
    let lost = steps.map(|(step, count)| changes("'newmark'", step, "2e-3", count)[1]);
    let rows = steps.iter().zip(lost).map(|((step, _), lost)| vec![(*step).into(), short(lost)]);
    case.table(
        "Implicit scheme, change of angular momentum in 0.5 s:",
        &["Δt [s]", "change"],
        rows.collect(),
    );
    let lowest = orders(&lost).into_iter().fold(f64::INFINITY, f64::min);
    case.inside("lowest order of that change in Δt", "", lowest, 0.7..=4.0);
    case.finish();
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
    let mut case = Case::new(
        "rigid_rotation_is_undamped",
        "Kelvin–Voigt damping leaves rotation alone",
    )
    .equation("dE/dt = −τ Σ k ṡ² = 0 where the strains s do not change")
    .source("σ = E (ε + τ ε̇) is objective")
    .scene(ROD, &with("'explicit'", "1e-5", &more))
    .note(
        "A rod with two magnets turns at 4 rad/s. After 0.5 s, when the stretching that the \
            centrifugal force brings has settled, its energy is compared over 1 s, 0.6 turns.",
    );
    // What is left of the stretching oscillation after 0.5 s.
    case.inside("change of the kinetic energy", "", energy, -1e-5..=1e-5);
    case.inside("change of the angular momentum", "", momentum, -1e-9..=1e-9);
    case.finish();
}

/// Length of the rod [m].
const LENGTH_M: f64 = 0.1;

/// A free rod that turns at 4 rad/s, once it has stretched, over 0.2 s: −L̇/L [1/s] and ω² [1/s²].
fn spun(integrator: &str, step: f64) -> [f64; 2] {
    let more = [("material.damping_time_s", "2e-3"), ("start.x_m", "-0.05")];
    let mut world = World::new(ROD, &with(integrator, &number(step), &more));
    world.set_motion([0.0, 0.0], 4.0);
    world.run(0.5);
    let before = world.momenta().1;
    world.run(0.2);
    let after = world.momenta().1;
    let inertia = world.mass_and_centre().0 * LENGTH_M * LENGTH_M / 12.0;
    [-(after / before).ln() / 0.2, (before / inertia) * (after / inertia)]
}

/// Under the implicit schemes a turning rod loses spin by truncation alone, at a rate that has a closed form. The torque of
/// the geometric stiffness, d ω ∫ T dx with d = Δt under backward Euler and Δt/100 under Newmark's scheme, and a tension T
/// that is more than the centrifugal one: to keep its length in a step the rod's ends move inwards by ½ ω² Δt, which a
/// scheme takes for a strain rate that lasts Δt + τ. Hence −L̇/L = d ω² (1 + 6 c² (Δt + τ) Δt/L²), c² = E/ρ.
#[test]
fn validates_implicit_rotation_loses_only_its_truncation() {
    let (tau, c2) = (2e-3, 100.0);
    let mut case =
        Case::new("implicit_rotation_loses_only_its_truncation", "Spin under the implicit schemes")
            .equation("−L̇/L = d ω² (1 + 6 (E/ρ) (Δt + τ) Δt/L²), d = Δt (Euler), Δt/100 (Newmark)")
            .source(
                "Leading terms of the schemes' truncation error for a rotating, extensible rod, \
            derived in the test",
            )
            .scene(ROD, &[("material.damping_time_s", "2e-3"), ("solver.step_s", "2e-3")])
            .note(
                "d is the time by which the scheme damps the turning of tension. The second term comes of \
            the linearised strain: to keep its length in a step the rod's ends move inwards by ½ω²Δt, which \
            the scheme takes for a strain rate.",
            );
    for (name, integrator, share) in [("Euler", "'euler'", 1.0), ("Newmark", "'newmark'", 0.01)] {
        for step in [2e-3, 5e-4] {
            let [lost, omega2] = spun(integrator, step);
            let stretch = 6.0 * c2 * (step + tau) * step / (LENGTH_M * LENGTH_M);
            let expected = share * step * omega2 * (1.0 + stretch);
            // Next order in ωΔt and the mesh's moment of inertia, 1 + 1/(2·20²) and so on.
            case.relative(format!("−L̇/L, {name}, Δt = {step} s"), "1/s", [lost, expected], 0.05);
        }
    }
    case.finish();
}
