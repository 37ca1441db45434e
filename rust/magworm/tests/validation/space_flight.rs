//! Free flight in space.

use crate::report::{Case, orders, short};
use crate::space_world::Vector;
use crate::world::{ROD, World};
use magworm::internals::Anchor;
use nalgebra::Rotation3;

const MAGNETS: [(&str, &str); 3] = [
    ("dimensions", "3"),
    ("magnet", "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}"),
    ("body.magnets", "[{position_m=0.02,polarity=1},{position_m=0.07,polarity=-1}]"),
];

/// A rod whose nodes are off by up to a tenth of an element and whose elements are rolled, flying and tumbling.
pub fn flying(integrator: &str, step: &str, damping: &str) -> World {
    let edits = [
        ("solver.integrator", integrator),
        ("solver.step_s", step),
        ("control.step_s", step),
        ("material.damping_time_s", damping),
    ];
    let mut world = World::new(ROD, &[&MAGNETS[..], &edits].concat());
    let coordinates = world.model.coordinates.clone();
    for (node, anchor) in coordinates.anchors.iter().enumerate() {
        let tied = coordinates.ties.iter().any(|tie| tie.node == node);
        if let (Anchor::Free { dof }, false) = (anchor, tied) {
            let k = node as f64;
            world.block.q[*dof][0] += 2e-4 * (1.0 + 3.0 * k).sin();
            world.block.q[dof + 1][0] += 5e-4 * (2.0 + 1.7 * k).sin();
            world.block.q[dof + 2][0] += 5e-4 * (0.5 + 2.1 * k).sin();
        }
    }
    world.refresh();
    for element in 0..world.last() {
        if coordinates.twists[element].is_some() {
            let (up, tangent) = (world.up(element), world.frame_tangent(element));
            let angle = 0.1 * (1.3 * element as f64).sin();
            let rolled = Rotation3::new(tangent * angle) * up;
            world.set_frame(element, rolled, tangent);
        }
    }
    let rate = Vector::new(4.0, -3.0, 5.0);
    world.set_flow(|place| Vector::new(0.3, -0.2, 0.25) + rate.cross(&place), rate);
    world.steps(1);
    world
}

/// Changes of momentum and angular momentum over `steps`, as parts of what they were. The last is that of the angular
/// momentum less Σ ∫ I θ̇ dt: an element's spin θ̇ keeps its value as the tangent turns, as of a rod without rotary
/// inertia across it.
pub fn changes(world: &mut World, steps: u32) -> [f64; 3] {
    let (linear, angular) = world.momenta_in_space();
    let twists = world.model.coordinates.twists.clone();
    let mut carried = Vector::zeros();
    for _ in 0..steps {
        let before: Vec<Vector> = (0..world.last()).map(|e| world.tangent(e)).collect();
        world.steps(1);
        for (element, dof) in twists.iter().enumerate() {
            if let Some(dof) = *dof {
                let spin = world.block.mass[dof][0] * world.block.v[dof][0];
                carried += (world.tangent(element) - before[element]) * spin;
            }
        }
    }
    let (after, turned) = world.momenta_in_space();
    let change = turned - angular;
    [
        (after - linear).norm() / linear.norm(),
        change.norm() / angular.norm(),
        (change - carried).norm() / angular.norm(),
    ]
}

/// A deformed rod with two magnets flies and tumbles: momentum to rounding under both schemes, angular momentum under
/// the explicit one but for the spin of its elements, in proportion to the step under the implicit one.
#[test]
fn validates_space_momentum_in_free_flight() {
    let mut case = Case::new("space_momentum_in_free_flight", "Momentum in free flight in space")
        .equation("Σ m v = const., Σ m x × v + Σ R I Rᵀ ω + Σ I_t θ̇ t = const.")
        .source("Newton, Euler; no force from outside")
        .scene(ROD, &MAGNETS)
        .note(
            "A rod with two magnets, its nodes off by up to a tenth of an element and its elements \
            rolled by 0.1 rad, flies at 0.44 m/s and tumbles at 7 rad/s for 5000 steps of 10 µs. An element has \
            rotary inertia about its tangent alone, and its spin θ̇ keeps its value as the tangent turns \
            (Bergou 2008): Σ I θ̇ ṫ is what the angular momentum changes by, of the order of (h/L)². The row \
            *less that* takes it off. The implicit scheme loses angular momentum in proportion to Δt, at long steps with a \
            higher power.",
        );
    for damping in ["0.0", "2e-3"] {
        let [linear, angular, bare] = changes(&mut flying("'explicit'", "1e-5", damping), 5000);
        case.at_most(format!("change of momentum, explicit, τ = {damping} s"), "", linear, 1e-12);
        case.at_most(
            format!("change of angular momentum, explicit, τ = {damping} s"),
            "",
            angular,
            2e-3,
        );
        case.at_most(format!("the same less that, explicit, τ = {damping} s"), "", bare, 1e-8);
    }
    let steps = [("1e-3", 200), ("5e-4", 400), ("2.5e-4", 800), ("1.25e-4", 1600)];
    let lost = steps.map(|(step, count)| {
        let [linear, _, bare] = changes(&mut flying("'newmark'", step, "2e-3"), count);
        case.at_most(format!("change of momentum, implicit, Δt = {step} s"), "", linear, 1e-12);
        bare
    });
    let rows = steps.iter().zip(lost).map(|((step, _), lost)| vec![(*step).into(), short(lost)]);
    case.table(
        "Implicit scheme, change of angular momentum in 0.2 s, less that of the spins:",
        &["Δt [s]", "change"],
        rows.collect(),
    );
    let lowest = orders(&lost).into_iter().fold(f64::INFINITY, f64::min);
    case.inside("lowest order of that change in Δt", "", lowest, 0.7..=4.0);
    case.finish();
}
