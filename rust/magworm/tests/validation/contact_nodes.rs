//! Contact at every node, each at its own height.

use crate::report::Case;
use crate::world::World;

const ON_NODES: [(&str, &str); 4] = [
    ("drive", ""),
    ("contact.points", "'nodes'"),
    ("control.step_s", "1.0"),
    ("material.damping_time_s", "0.05"),
];

/// The robot at rest after a second, on its feet or on its back.
fn at_rest(angle_deg: &str) -> World {
    let turned = [("start.angle_deg", angle_deg)];
    let mut world = World::new("robot", &[&ON_NODES[..], &turned].concat());
    world.run(1.0);
    world
}

/// Height of the lowest node, over half of a foot's thickness.
fn height(world: &World) -> f64 {
    let lowest_m = (0..=world.last()).map(|node| world.node(node)[1]).fold(f64::INFINITY, f64::min);
    lowest_m / (0.5 * world.model.thickness_m)
}

/// Greatest normal impulse of a point below a bridge [N·s].
fn on_bridges(world: &World) -> f64 {
    let below_a_bridge = |point: &[f64; 3]| -point[1] < 0.49 * world.model.thickness_m;
    let points = world.model.contacts.iter().zip(world.block.normal_impulse.iter());
    let bridges = points.filter(|(pair, _)| below_a_bridge(&pair.point.place_m));
    bridges.map(|(_, impulse)| impulse[0]).fold(0.0, f64::max)
}

/// With a point below every node the nodes of feet bear the robot and those of bridges do not, and it lies on its back as it
/// stands on its feet: a node has no side.
#[test]
fn validates_contact_at_nodes() {
    let mut case = Case::new("contact_at_nodes", "Contact at every node")
        .equation("Σ N = m g; y = h/2")
        .source("Statics; contact section of the paper (Soft Robotics, DOI 10.1089/soro.2019.0167)")
        .scene("robot", &ON_NODES)
        .note("The robot at rest on its feet and on its back, in which it hangs through by some micrometres.");
    for (angle, name) in [("0.0", "on its feet"), ("180.0", "on its back")] {
        let world = at_rest(angle);
        let weight = world.mass_and_centre().0 * 9.81;
        case.relative(format!("weight {name}"), "N", [world.normal_force(), weight], 1e-6);
        case.inside(
            format!("height {name} over half a thickness"),
            "1",
            height(&world),
            0.98..=1.0,
        );
        case.at_most(format!("impulse below a bridge {name}"), "N·s", on_bridges(&world), 0.0);
    }
    case.finish();
}
