//! Neighbouring feet that touch each other.

use crate::report::Case;
use crate::world::World;
use magworm::Status;
use magworm::internals::lanes::Scalar;
use magworm::internals::{Phase, run_phase};

/// Two feet in free flight on soft rubber.
const FEET: [(&str, &str); 8] = [
    ("drive", ""),
    ("gravity_m_s2", "0.0"),
    ("body.magnets", "2"),
    ("material.youngs_modulus_pa", "1e3"),
    ("material.damping_time_s", "0.005"),
    ("magnetic_terms.mutual", "false"),
    ("start.height_m", "0.1"),
    ("contact.between_feet", "true"),
];
/// Pull on each of them [N].
const FORCE_N: f64 = 0.05;
/// Steps in which the pull grows to that. It acts for half as many more: later the pair would give way sideways, as a column does.
const GROWS: usize = 200;

/// A step with a force along x on the first foot, and the opposite one on the second.
fn pulled_step(world: &mut World, force_n: f64) {
    for phase in world.model.phases.clone() {
        run_phase(Scalar, &world.model, &mut world.block, phase);
        if phase == Phase::Springs {
            let impulse = force_n * world.model.step_s;
            world.block.rhs[world.model.bodies[0].dof][0] += impulse;
            world.block.rhs[world.model.bodies[1].dof][0] -= impulse;
        }
    }
}

/// Distance of the middles of the feet along x [m].
fn distance_m(world: &World) -> f64 {
    let x = |body: usize| world.block.q[world.model.bodies[body].dof][0];
    x(1) - x(0)
}

/// What the rubber between the magnets pushes them apart with [N]: EA (1 − l/l₀) of the first element behind the first one.
fn rubber_n(world: &World) -> f64 {
    let first = world.model.bodies[0].element;
    let behind = world.model.stretch.iter().find(|spring| spring.element > first);
    let spring = behind.expect("rubber between the magnets");
    let ends = [spring.element, spring.element + 1]
        .map(|node| world.block.node_position(&world.model, node, 0));
    spring.stiffness_n_m * (spring.rest_m - (ends[1] - ends[0]).norm())
}

/// Force between two feet that are pulled together, and how far they are apart over their length, where that force and the
/// rubber between them hold the pull.
fn pulled(space: bool) -> ([f64; 2], f64) {
    let edits = [("dimensions", if space { "3" } else { "2" }), ("solver.step_s", "5e-4")];
    let mut world = World::new("robot", &[&FEET[..], &edits].concat());
    for step in 0..3 * GROWS / 2 {
        pulled_step(&mut world, FORCE_N * (step.min(GROWS) as f64 / GROWS as f64));
    }
    assert_eq!(world.block.status[0], Status::Running);
    let foot_m = 2.0 * world.model.mesh.feet[0].half_m[0];
    ([world.normal_force() + rubber_n(&world), FORCE_N], distance_m(&world) / foot_m)
}

/// How deep corners of the first foot are in the second one, or the other way round, as if their edges were sharp [m].
fn depth_m(world: &World) -> f64 {
    let pose = |body: usize| world.block.planar_pose(&world.model, body, 0);
    let foot = world.model.mesh.feet[0];
    let half = foot.half_m.map(|half_m| half_m + foot.radius_m);
    let depth = |[x, y, angle]: [f64; 3], [of_x, of_y, of_angle]: [f64; 3], end: f64, up: f64| {
        let (sin, cos) = angle.sin_cos();
        let (dx, dy) = (
            x + end * half[0] * cos - up * half[1] * sin - of_x,
            y + end * half[0] * sin + up * half[1] * cos - of_y,
        );
        let (sin, cos) = of_angle.sin_cos();
        (half[0] - (cos * dx + sin * dy).abs()).min(half[1] - (cos * dy - sin * dx).abs())
    };
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
    let of = |one: usize, other: usize| {
        corners
            .map(|(end, up)| depth(pose(one), pose(other), end, up))
            .into_iter()
            .fold(0.0, f64::max)
    };
    of(0, 1).max(of(1, 0))
}

/// What happened to two feet that swung together.
#[derive(Default)]
struct Swing {
    /// Greatest change of momentum, and of angular momentum, over those of one foot.
    momentum: f64,
    angular: f64,
    /// Greatest force between them [N].
    force_n: f64,
    /// How deep they were in each other [m].
    depth_m: f64,
    /// Greatest kinetic energy over that of the start, less 1.
    gained: f64,
}

/// Feet that move towards each other while their undersides swing together.
fn folded(edge_radius: &str) -> Swing {
    let edits = [("solver.step_s", "1e-3"), ("contact.edge_radius_m", edge_radius)];
    let mut world = World::new("robot", &[&FEET[..], &edits].concat());
    let (speed, rate) = (0.4, 20.0);
    for (body, way) in [(0, 1.0), (1, -1.0)] {
        let dof = world.model.bodies[body].dof;
        world.block.v[dof][0] = way * speed;
        world.block.v[dof + 2][0] = way * rate;
    }
    let first = world.model.bodies[0].dof;
    let (momentum, spin) =
        (world.block.mass[first][0] * speed, world.block.mass[first + 2][0] * rate);
    let (start, angular, energy) = (world.momenta().0, world.momenta().1, world.kinetic());
    let mut swing = Swing::default();
    for _ in 0..300 {
        world.steps(1);
        let (linear, turning) = world.momenta();
        let moved = (linear[0] - start[0]).hypot(linear[1] - start[1]);
        swing.momentum = swing.momentum.max(moved / momentum);
        swing.angular = swing.angular.max((turning - angular).abs() / spin);
        swing.force_n = swing.force_n.max(world.normal_force());
        swing.depth_m = swing.depth_m.max(depth_m(&world));
        swing.gained = swing.gained.max(world.kinetic() / energy - 1.0);
    }
    swing
}

/// Feet stop at each other. Pulled together they press with the pull less what the rubber between them holds; swung together they
/// keep both momenta, gain no energy and do not pass through each other.
#[test]
fn validates_feet_stop_at_each_other() {
    let mut case = Case::new("feet_stop_at_each_other", "Feet that touch each other")
        .equation("N = F − EA (1 − l/l₀); Σ p, Σ L = const.; T ≤ T₀")
        .source("Equilibrium, conservation of momenta, second law")
        .scene("robot", &FEET)
        .note(
            "Two feet in free flight, on rubber of 1 kPa, pulled together with 0.05 N, and thrown at each other with 0.4 m/s \
            and 20 rad/s each, so that they fold. A corner of one is at most 0.1 mm deep in \
            the other.",
        );
    for (space, name) in [(false, "in the plane"), (true, "in space")] {
        let (force, distance) = pulled(space);
        case.relative(format!("force {name}"), "N", force, 1e-6);
        case.inside(
            format!("distance {name} over the length of a foot"),
            "1",
            distance,
            0.99..=1.0,
        );
    }
    for (radius, name) in [("0.0", "sharp"), ("0.001", "rounded")] {
        let swing = folded(radius);
        case.at_most(format!("momentum, {name} feet"), "relative", swing.momentum, 1e-12);
        case.at_most(format!("angular momentum, {name} feet"), "relative", swing.angular, 1e-11);
        case.inside(format!("greatest force, {name} feet"), "N", swing.force_n, 0.05..=5.0);
        case.at_most(format!("energy gained, {name} feet"), "relative", swing.gained, 0.0);
        case.at_most(format!("depth, {name} feet"), "m", swing.depth_m, 1e-4);
    }
    case.finish();
}

#[test]
fn a_bridge_that_feet_pass_through_is_explained() {
    let told = |bridge: &str| {
        let edits = [("contact.between_feet", "true"), ("body.bridge_thickness_m", bridge)];
        World::new("robot", &edits).model.explain()
    };
    // π/4 times thickness over length, 6 mm.
    assert!(told("0.004").contains("16 corners stop at") && told("0.004").contains(" 52 %"));
    assert!(told("0.001").contains(" 13 %"));
}
