//! Strains and frames of a bent start: those that were asked for.

use crate::world::{ASIDE, BODIES, Edits, MANY, ROD, SPACE, TWISTS, Vector, World};

/// What a list asks of each bending node [rad], point by point along the body.
fn asked(world: &World, list_deg: &[f64]) -> Vec<f64> {
    const POINTS: usize = 400_000;
    if list_deg.is_empty() {
        return vec![0.0; world.elements() - 1];
    }
    let (mesh, length_m) = (&world.model.mesh, world.model.mesh.length_m());
    let mut counts = vec![vec![0.0; mesh.elements.len() - 1]; list_deg.len()];
    let mut element = 0;
    for point in 0..POINTS {
        let share = (point as f64 + 0.5) / POINTS as f64;
        while mesh.arc_m[element + 1] < share * length_m {
            element += 1;
        }
        let middle_m = 0.5 * (mesh.arc_m[element] + mesh.arc_m[element + 1]);
        let node = element + usize::from(share * length_m > middle_m);
        if mesh.elements[element].body.is_none() && node > 0 && node < mesh.elements.len() {
            counts[(share * list_deg.len() as f64) as usize][node - 1] += 1.0;
        }
    }
    let mut found = vec![0.0; mesh.elements.len() - 1];
    for (counts, angle_deg) in counts.iter().zip(list_deg) {
        let whole: f64 = counts.iter().sum();
        for (node, count) in found.iter_mut().zip(counts) {
            *node += if *count > 0.0 { angle_deg.to_radians() * count / whole } else { 0.0 };
        }
    }
    found
}

#[test]
fn the_strains_of_a_bent_start_are_those_that_were_asked_for() {
    for (preset, edits) in BODIES {
        for in_space in [false, true] {
            let bent: &Edits<'_> = if in_space { &[SPACE, MANY, ASIDE, TWISTS] } else { &[MANY] };
            let mut world = World::new(preset, &[edits, bent]);
            let laid = world.all_strains();
            let start = &world.model.scene.start;
            let lists = [&start.bends_deg, &start.bends_aside_deg, &start.twists_deg];
            let asked = lists.map(|list_deg| asked(&world, list_deg));
            for (node, strains) in laid.iter().enumerate() {
                for k in 0..3 {
                    let off = strains[k] - asked[k][node];
                    assert!(off.abs() < 2e-3, "{preset}: strain {k} of node {}: {off}", node + 1);
                }
            }
            for k in 0..3 {
                let whole: f64 = laid.iter().map(|strains| strains[k]).sum();
                let off = whole - lists[k].iter().sum::<f64>().to_radians();
                assert!(off.abs() < 1e-11, "{preset}: strain {k} in all: {off}");
            }
            // What the simulator measures at its first step, and lengths at rest.
            world.refresh();
            for (found, laid) in world.all_strains().iter().zip(&laid) {
                (0..3).for_each(|k| assert!((found[k] - laid[k]).abs() < 1e-12));
            }
            for spring in &world.model.stretch {
                let length = world.block.length[spring.element][0];
                assert!((length / spring.rest_m - 1.0).abs() < 1e-11, "{preset}: {length}");
            }
            for (row, laid) in world.block.twist.iter().zip(&laid) {
                assert!((row[0] - laid[2]).abs() < 1e-12, "{preset}: twist");
            }
        }
    }
}

#[test]
fn a_node_takes_its_share_of_each_part() {
    // Twelve elements of length l in three parts; the nodes at the ends of the body do not bend.
    let world = World::new("cantilever", &[ROD, &[("start.bends_deg", "[35, 40, -70]")]]);
    let bends: Vec<f64> =
        world.all_strains().iter().map(|strains| strains[0].to_degrees()).collect();
    for (node, expected) in
        [(1, 10.0), (3, 10.0), (4, 5.0 + 5.0), (5, 10.0), (8, 5.0 - 10.0), (9, -20.0), (11, -20.0)]
    {
        assert!((bends[node - 1] - expected).abs() < 1e-9, "node {node}: {bends:?}");
    }
    // A clamped body bends from the wall on, half an element behind which its mesh begins.
    let clamped = World::new("cantilever", &[&[("start.bends_deg", "[53]")]]);
    let bends: Vec<f64> =
        clamped.all_strains().iter().map(|strains| strains[0].to_degrees()).collect();
    assert!(bends.iter().all(|bend| (bend - 53.0 / 26.0).abs() < 1e-9), "{bends:?}");
    assert!(clamped.place(0).x < 0.0 && clamped.place(0).y == 0.0 && clamped.place(1).y == 0.0);
    // Nothing of a magnet bends.
    let robot = World::new("robot", &[&[("start.bends_deg", "[90]")]]);
    for body in &robot.model.bodies {
        let (head, tail) = (robot.place(body.element), robot.place(body.element + 1));
        assert!(((tail - head).norm() - 2.0 * body.half_length_m).abs() < 1e-15);
    }
}

#[test]
fn signs_are_those_of_the_axes() {
    let tail = |list: &str| {
        let world = World::new("cantilever", &[ROD, &[SPACE, (list, "[30, 60]")]]);
        let last = world.elements() - 1;
        (world.tangent(last), world.up(last))
    };
    let near = |a: Vector, b: Vector| assert!((a - b).norm() < 1e-14, "{a} for {b}");
    let (x, y, z) = (Vector::x(), Vector::y(), Vector::z());
    let (tangent, up) = tail("start.bends_deg");
    near(tangent, y);
    near(up, -x);
    let (tangent, up) = tail("start.bends_aside_deg");
    near(tangent, z);
    near(up, y);
    let (tangent, up) = tail("start.twists_deg");
    near(tangent, x);
    near(up, z);
}

/// A rod of even strains is a helix, but for the halves of elements at its ends, which are straight: its frame turns at a
/// constant rate about an axis that stands still in it. The end comes nearer to the closed form (Frenet) in proportion to
/// the square of the length of an element.
#[test]
fn validates_even_strains_are_a_helix() {
    let (bend, aside, twist) = (300.0f64, -170.0f64, 410.0f64);
    let angles = Vector::new(twist, -aside, bend).map(f64::to_radians);
    let (axis, angle) = (angles.normalize(), angles.norm());
    let along = axis * axis.x;
    let across = Vector::x() - along;
    let tangent = along + across * angle.cos() + axis.cross(&Vector::x()) * angle.sin();
    let chord =
        along + (across * angle.sin() + axis.cross(&Vector::x()) * (1.0 - angle.cos())) / angle;
    let off = |elements: f64| {
        let values = [bend, aside, twist].map(|angle| format!("[{angle}]"));
        let lists: &Edits<'_> = &[
            SPACE,
            ("body.elements", &elements.to_string()),
            ("start.bends_deg", &values[0]),
            ("start.bends_aside_deg", &values[1]),
            ("start.twists_deg", &values[2]),
        ];
        let straight = 0.5 / elements;
        let exact = (Vector::x() + tangent) * straight + chord * (1.0 - 2.0 * straight);
        (World::new("cantilever", &[ROD, lists]).tail() / 0.054 - exact).norm()
    };
    let errors = [25.0, 50.0, 100.0, 200.0].map(off);
    println!("{errors:?}");
    assert!(errors[3] < 2e-4, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((3.5..4.5).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

#[test]
fn frames_of_a_long_coil_do_not_drift() {
    let coil: &Edits<'_> = &[
        SPACE,
        ("body.elements", "249"),
        ("start.bends_deg", "[30000]"),
        ("start.bends_aside_deg", "[-16000]"),
        ("start.twists_deg", "[9000]"),
    ];
    let world = World::new("cantilever", &[ROD, coil]);
    for element in 0..world.elements() {
        let (up, tangent) = (world.up(element), world.frame(element, 3));
        let off = [up.norm() - 1.0, tangent.norm() - 1.0, up.dot(&tangent)];
        assert!(off.iter().all(|off| off.abs() < 1e-15), "element {element}: {off:?}");
        assert!((world.tangent(element) - tangent).norm() < 1e-11, "element {element}");
    }
    let last = world.strains(world.elements() - 2).map(|strain| strain * 248.0);
    for (strain, whole_deg) in last.into_iter().zip([30000.0f64, -16000.0, 9000.0]) {
        assert!((strain - whole_deg.to_radians()).abs() < 1e-8, "{last:?}");
    }
}
