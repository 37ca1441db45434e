//! Feet with rounded edges: they roll.

use crate::report::Case;
use crate::world::{RIGID_FOOT, World, number};

const G: f64 = 9.81;

fn foot(edits: &[&[(&str, &str)]]) -> World {
    World::new("robot", &[&RIGID_FOOT[..], &edits.concat()].concat())
}

/// x of the middle of the foot [m].
fn middle_m(world: &World) -> f64 {
    world.block.q[world.model.bodies[0].dof][0]
}

/// Mass and moment of inertia about z of the foot [kg, kg·m²].
fn inertia(world: &World) -> [f64; 2] {
    let (first, size) = (world.model.coordinates.bodies[0], world.model.coordinates.body_size());
    [world.block.mass[first][0], world.block.mass[first + size - 1][0]]
}

/// A foot as high as it is long, rounded to a cylinder, rolls down an incline as one: a = g sin α/(1 + J/(m R²)).
fn rolled_m(space: bool) -> [f64; 2] {
    let cylinder = [
        ("body.foot_thickness_m", "0.014"),
        ("body.width_m", "0.02"),
        ("contact.edge_radius_m", "0.007"),
        ("ground.incline_deg", "10"),
        ("solver.step_s", "1e-3"),
    ];
    let dimensions = [("dimensions", if space { "3" } else { "2" })];
    let mut world = foot(&[&cylinder, &dimensions]);
    let [mass, moment] = inertia(&world);
    let start_m = middle_m(&world);
    let time_s = 0.5;
    world.run(time_s);
    let acceleration = G * 10f64.to_radians().sin() / (1.0 + moment / (mass * 0.007 * 0.007));
    // Positions of a step follow its velocities.
    let time_s2 = time_s * (time_s + world.model.step_s);
    [middle_m(&world) - start_m, 0.5 * acceleration * time_s2]
}

/// Way of the centre of a rounded edge along the ground over R times the turn, and what the energy of the fall is off by, as
/// a part of it: a foot let go at 45° rolls down on its edge to 11°.
fn fall(step: f64) -> [f64; 2] {
    let text = number(step);
    let rounded =
        [("contact.edge_radius_m", "0.002"), ("start.angle_deg", "45.0"), ("solver.step_s", &text)];
    let mut world = foot(&[&rounded]);
    let (mass, [_, height]) = world.mass_and_centre();
    let centre = |world: &World| {
        let [x, _, angle] = world.block.planar_pose(&world.model, 0, 0);
        let (sin, cos) = angle.sin_cos();
        [x - 0.005 * cos + 0.0015 * sin, angle]
    };
    let start = centre(&world);
    while centre(&world)[1] > 0.2 {
        world.steps(1);
    }
    let end = centre(&world);
    // Half a step of the fall: positions stand half a step after velocities.
    let rate = world.block.planar_velocity(&world.model, 0, 0)[1];
    let fallen = height - world.mass_and_centre().1[1] + 0.5 * step * rate;
    [
        (end[0] - start[0]) / (0.002 * (start[1] - end[1])),
        world.kinetic() / (mass * G * fallen) - 1.0,
    ]
}

/// Whether a tall foot with edges of 3 mm tips over on an incline within a second.
fn tips(incline_deg: f64) -> bool {
    let incline = number(incline_deg);
    let tall = [
        ("body.foot_thickness_m", "0.012"),
        ("contact.edge_radius_m", "0.003"),
        ("ground.incline_deg", incline.as_str()),
    ];
    let mut world = foot(&[&tall]);
    world.run(1.0);
    world.block.planar_pose(&world.model, 0, 0)[2].abs() > 0.5
}

/// Incline at which it begins to tip, by bisection [°].
fn tipping_deg() -> f64 {
    let (mut low, mut high) = (20.0, 45.0);
    assert!(!tips(low) && tips(high));
    while high - low > 1e-3 {
        let middle = 0.5 * (low + high);
        if tips(middle) { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// The lowest point of a rounded edge touches. A foot rounded to a cylinder rolls as one, one that falls about its edge keeps its
/// energy and rolls without slipping, and a tall one tips where its centre stands above the end of what is flat.
#[test]
fn validates_rounded_feet_roll() {
    let mut case = Case::new("rounded_feet_roll", "Feet with rounded edges")
        .equation("a = g sin α/(1 + J/mR²); x_c = −R Δθ, T = m g (h₀ − h); tan α = (l/2 − R)/(h/2)")
        .source("Rigid body that rolls without slipping; contact that rolls does no work")
        .scene("robot", &RIGID_FOOT)
        .note(
            "A foot of 14 × 14 mm rounded by 7 mm on an incline of 10° for 0.5 s; one of 14 × 7 mm rounded by 2 mm that falls \
            from 45° to 11°; one of 14 × 12 mm rounded by 3 mm. Contact springs give by a thousandth of a thickness, which \
            takes 0.3° off the angle that tips; off that of a sharp foot, 49.4°, 0.2°.",
        );
    case.relative("way of the cylinder", "m", rolled_m(false), 1e-4);
    case.relative("way of the cylinder in space", "m", rolled_m(true), 1e-4);
    let [way, energy] = fall(2e-3);
    case.inside("roll of the edge over R Δθ", "1", way, 0.99..=1.01);
    case.inside("energy of the fall", "relative", energy, -5e-3..=5e-3);
    case.absolute(
        "incline that tips",
        "°",
        [tipping_deg(), (4.0f64 / 6.0).atan().to_degrees()],
        0.3,
    );
    case.finish();
}
