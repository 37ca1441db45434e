//! Where a bent body stands: in the plane as in space, on the ground, in the pose of a reset.

use crate::world::{ASIDE, BODIES, Edits, MANY, ROD, SPACE, TWISTS, Vector, World, scene};
use magworm::{Model, StartPose};

#[test]
fn a_body_in_the_plane_is_bent_as_in_space() {
    for (preset, edits) in BODIES {
        let pose: &Edits<'_> = &[MANY, ("start.angle_deg", "-25"), ("start.x_m", "0.3")];
        let plane = World::new(preset, &[edits, pose]);
        let space = World::new(preset, &[edits, pose, &[SPACE]]);
        for node in 0..plane.model.nodes() {
            let apart = (plane.place(node) - space.place(node)).norm();
            assert!(apart < 1e-13, "{preset}: node {node} is {apart} m off");
        }
        for magnet in 0..plane.model.magnets() {
            let [flat, spatial] = [&plane, &space]
                .map(|world| world.block.magnet_pose(&world.model, magnet, 0).orientation);
            assert!(flat.angle_to(&spatial) < 1e-7);
        }
    }
}

#[test]
fn whole_turns_of_a_magnet_count_in_the_plane() {
    let world = World::new("robot", &[&[("start.bends_deg", "[800]")]]);
    let angle = world.block.planar_pose(&world.model, 2, 0)[2];
    assert!((500.0..800.0).contains(&angle.to_degrees()), "{}", angle.to_degrees());
}

#[test]
fn the_lowest_point_of_a_bent_body_stands_at_its_height() {
    // A rod that hangs through: its lowest node has its sole at the height.
    let ground = ("ground", "{ static_friction = 1, dynamic_friction = 1 }");
    let hanging: &Edits<'_> = &[
        ground,
        ("start.bends_deg", "[180]"),
        ("start.angle_deg", "-90"),
        ("start.height_m", "0.01"),
        ("start.x_m", "0.2"),
    ];
    let world = World::new("cantilever", &[ROD, hanging]);
    let lowest = (0..world.model.nodes()).map(|node| world.place(node).y).fold(1.0, f64::min);
    assert!((lowest - 0.002 - 0.01).abs() < 1e-15, "{lowest}");
    assert!((world.place(0).x - 0.2).abs() < 1e-15 && world.place(0).y > 0.02);
    // Of a robot's bridges, which touch nothing, the section counts.
    let robot = World::new("robot", &[&hanging[1..]]);
    let lowest = (0..robot.model.nodes()).map(|node| robot.place(node).y).fold(1.0, f64::min);
    assert!((0.01 + 0.002..=0.01 + 0.0035 + 1e-15).contains(&lowest), "{lowest}");
    // One that is rolled stands on a corner of a section.
    let aside: &Edits<'_> = &[SPACE, ("start.twists_deg", "[0, 90, 0]"), ("start.height_m", "0")];
    let rolled = World::new("robot", &[aside]);
    assert!(rolled.up(rolled.elements() - 1).y.abs() < 1e-14);
    let mut lowest = f64::MAX;
    for (e, element) in rolled.model.mesh.elements.iter().enumerate() {
        let (up, side) = (rolled.up(e), rolled.tangent(e).cross(&rolled.up(e)));
        for (node, thick, wide) in
            [(e, 1.0, 1.0), (e, -1.0, 1.0), (e, 1.0, -1.0), (e, -1.0, -1.0), (e + 1, -1.0, -1.0)]
        {
            let arm = up * (thick * element.thickness_m) + side * (wide * element.width_m);
            lowest = lowest.min((rolled.place(node) + arm * 0.5).y);
        }
    }
    assert!(lowest.abs() < 1e-15, "{lowest}");
    // Without contact points the head end has the height.
    let falling = World::new("cantilever", &[ROD, &hanging[1..]]);
    assert_eq!(falling.place(0).y, 0.01);
}

#[test]
fn a_pose_of_a_reset_moves_the_shape_of_the_scene() {
    let bent: &Edits<'_> = &[SPACE, MANY, ASIDE, TWISTS];
    let own = World::new("robot", &[bent]);
    let pose = StartPose { x_m: 0.1, height_m: 0.02, angle_rad: 0.7, z_m: -0.3, yaw_rad: 2.0 };
    let moved = World::started(Model::compile(&scene("robot", &[bent])).expect("a model"), pose);
    let (first, last) = (own.place(0), moved.place(0));
    assert!((last.x - 0.1).abs() < 1e-15 && (last.z + 0.3).abs() < 1e-15);
    let tangent =
        Vector::new(0.7f64.cos() * 2.0f64.cos(), 0.7f64.sin(), -0.7f64.cos() * 2.0f64.sin());
    assert!((moved.tangent(0) - tangent).norm() < 1e-13);
    for node in 1..own.model.nodes() {
        let [here, there] = [(&own, first), (&moved, last)].map(|(w, head)| w.place(node) - head);
        assert!((here.norm() - there.norm()).abs() < 1e-14);
    }
    for (here, there) in own.all_strains().iter().zip(moved.all_strains()) {
        (0..3).for_each(|k| assert!((here[k] - there[k]).abs() < 1e-12));
    }
}
