//! Bodies that start bent: the strains that were asked for, the places that follow, and nothing new where they are straight.

use magworm::internals::lanes::{Plane, Scalar, Space};
use magworm::internals::{Block, Draws, advance, kinematics, reset, scene_start};
use magworm::scene::Scene;
use magworm::{Model, StartPose, Status};
use nalgebra::Vector3;

type Vector = Vector3<f64>;
type Edits<'a> = [(&'a str, &'a str)];

/// A free rod of twelve elements without weight.
const ROD: &Edits<'_> = &[("body.clamp", "'none'"), ("body.elements", "12"), ("gravity_m_s2", "0")];
const SPACE: (&str, &str) = ("dimensions", "3");
const MANY: (&str, &str) = ("start.bends_deg", "[30, -200, 0, 120, 65.5]");
const ASIDE: (&str, &str) = ("start.bends_aside_deg", "[100, -10, -90]");
const TWISTS: (&str, &str) = ("start.twists_deg", "[-50, 300]");

fn scene(preset: &str, edits: &[&Edits<'_>]) -> Scene {
    let value = |text: &str| Some(text.parse().expect("a TOML value"));
    let edits: Vec<_> =
        edits.concat().iter().map(|(path, text)| (path.to_string(), value(text))).collect();
    Scene::preset(preset).and_then(|scene| scene.with_values(&edits)).expect("a valid scene")
}

struct World {
    model: Model,
    block: Block<[f64; 1]>,
}

impl World {
    fn new(preset: &str, edits: &[&Edits<'_>]) -> Self {
        let model = Model::compile(&scene(preset, edits)).expect("a model");
        let pose = scene_start(&model);
        Self::started(model, pose)
    }

    fn started(model: Model, pose: StartPose) -> Self {
        let mut block = Block::new(&model);
        let present = vec![true; model.magnets()];
        let factors = [1.0; Model::PARAMETERS.len()];
        reset(&model, &mut block, 0, pose, &factors, &present, Draws::new(0, 0));
        Self { model, block }
    }

    /// Brings tangents and frames up to date, as the first step would.
    fn refresh(&mut self) {
        self.block.running[0][0] = 1.0;
        match self.model.dimensions() {
            2 => kinematics::<Plane, _>(Scalar, &self.model, &mut self.block),
            _ => kinematics::<Space, _>(Scalar, &self.model, &mut self.block),
        }
    }

    fn elements(&self) -> usize {
        self.model.nodes() - 1
    }

    fn place(&self, node: usize) -> Vector {
        self.block.node_position(&self.model, node, 0)
    }

    fn tail(&self) -> Vector {
        self.place(self.elements())
    }

    fn tangent(&self, element: usize) -> Vector {
        (self.place(element + 1) - self.place(element)).normalize()
    }

    fn frame(&self, element: usize, first: usize) -> Vector {
        Vector::from_fn(|axis, _| self.block.director[6 * element + first + axis][0])
    }

    fn up(&self, element: usize) -> Vector {
        self.frame(element, 0)
    }

    /// κ₁, κ₂, τ at the node after an element, as Bergou (2010) defines them, for κ = φ. In the plane κ₁ alone.
    fn strains(&self, e: usize) -> [f64; 3] {
        let (te, tf) = (self.tangent(e), self.tangent(e + 1));
        let chi = 1.0 + te.dot(&tf);
        let binormal = te.cross(&tf) * (2.0 / chi);
        let tangent_half = 0.5 * binormal.norm();
        let factor = if tangent_half > 1e-9 { tangent_half.atan() / tangent_half } else { 1.0 };
        if self.model.dimensions() == 2 {
            return [binormal.z * factor, 0.0, 0.0];
        }
        let (ue, uf) = (self.up(e), self.up(e + 1));
        let (se, sf) = (te.cross(&ue), tf.cross(&uf));
        let carried = ue - (te + tf) * (ue.dot(&tf) / chi);
        [
            0.5 * factor * binormal.dot(&(se + sf)),
            -0.5 * factor * binormal.dot(&(ue + uf)),
            carried.cross(&uf).dot(&tf).atan2(carried.dot(&uf)),
        ]
    }

    fn all_strains(&self) -> Vec<[f64; 3]> {
        (0..self.elements() - 1).map(|element| self.strains(element)).collect()
    }

    fn bits(&self) -> Vec<u64> {
        let rows = self.block.state_rows();
        rows.iter().flat_map(|rows| rows.iter().map(|row| row[0].to_bits())).collect()
    }

    fn runs(&mut self, steps: u32) {
        advance(Scalar, &self.model, &mut self.block, steps);
        assert_eq!(self.block.status[0], Status::Running);
    }
}

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
        if mesh.elements[element].magnet.is_none() && node > 0 && node < mesh.elements.len() {
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

/// Bodies with many elements, with magnets, with a clamp; under reduced coordinates and under multipliers.
const BODIES: &[(&str, &Edits<'static>)] = &[
    ("cantilever", ROD),
    ("cantilever", &[]),
    (
        "cantilever",
        &[
            (
                "magnet",
                "{ length_m = 0.005, width_m = 0.005, height_m = 0.003, remanence_t = 1, density_kg_m3 = 7500 }",
            ),
            (
                "body.magnets",
                "[{ position_m = 0.02, polarity = 1 }, { position_m = 0.0515, polarity = -1 }]",
            ),
        ],
    ),
    ("paper-4", &[]),
    (
        "paper-3",
        &[
            ("solver.integrator", "'explicit'"),
            ("solver.step_s", "1e-7"),
            ("control.step_s", "1e-3"),
        ],
    ),
];

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
    let robot = World::new("paper-3", &[&[("start.bends_deg", "[90]")]]);
    for magnet in &robot.model.mesh.magnets {
        let (head, tail) = (robot.place(magnet.element), robot.place(magnet.element + 1));
        assert!(((tail - head).norm() - 2.0 * magnet.half_length_m).abs() < 1e-15);
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

#[test]
fn zeros_are_straight_bit_for_bit_and_leave_no_trace() {
    for (preset, edits) in BODIES {
        for in_space in [false, true] {
            let space: &Edits<'_> = if in_space { &[SPACE] } else { &[] };
            let zeros: &Edits<'_> = &[
                ("start.bends_deg", "[0, -0.0]"),
                ("start.bends_aside_deg", "[0]"),
                ("start.twists_deg", "[]"),
            ];
            let pose: &Edits<'_> = &[("start.angle_deg", "20"), ("start.height_m", "0.01")];
            let mut straight = World::new(preset, &[edits, space, pose]);
            let mut zero = World::new(preset, &[edits, space, pose, zeros]);
            assert!(straight.model.shape.is_none() && zero.model.shape.is_none());
            assert_eq!(straight.bits(), zero.bits());
            straight.runs(20);
            zero.runs(20);
            assert_eq!(straight.bits(), zero.bits());
            assert!(!straight.model.scene.to_toml().contains("bends"));
        }
    }
}

#[test]
fn a_bent_start_survives_toml_and_is_told() {
    let bent = scene("paper-3", &[&[SPACE, MANY, TWISTS]]);
    let text = bent.to_toml();
    assert!(text.contains("bends_deg = [30.0, -200.0,") && !text.contains("bends_aside_deg"));
    assert_eq!(Scene::from_toml(&text), Ok(bent.clone()));
    let told = Model::compile(&bent).expect("a model").explain();
    assert!(told.contains("start         bent by up to "), "{told}");
    assert!(!World::new("paper-3", &[]).model.explain().contains("start "));
    let error = Scene::from_toml(&text.replace("-200.0", "-2000.0")).unwrap_err();
    let line = 1 + text[..text.find("bends_deg").expect("the list")].matches('\n').count();
    assert!(error.to_string().starts_with(&format!("line {line}: start.bends_deg[1] is -2000°")));
}

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
    let world = World::new("paper-3", &[&[("start.bends_deg", "[800]")]]);
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
    let robot = World::new("paper-3", &[&hanging[1..]]);
    let lowest = (0..robot.model.nodes()).map(|node| robot.place(node).y).fold(1.0, f64::min);
    assert!((0.01 + 0.002..=0.01 + 0.0035 + 1e-15).contains(&lowest), "{lowest}");
    // One that is rolled stands on a corner of a section.
    let aside: &Edits<'_> = &[SPACE, ("start.twists_deg", "[0, 90, 0]"), ("start.height_m", "0")];
    let rolled = World::new("paper-3", &[aside]);
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
    let own = World::new("paper-3", &[bent]);
    let pose = StartPose { x_m: 0.1, height_m: 0.02, angle_rad: 0.7, z_m: -0.3, yaw_rad: 2.0 };
    let moved = World::started(Model::compile(&scene("paper-3", &[bent])).expect("a model"), pose);
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

/// Bending moments of even curvature balance at every node but those beside the ends: nothing else moves at first.
#[test]
fn an_even_arc_is_let_go_from_its_ends() {
    for in_space in [false, true] {
        let space: &Edits<'_> = if in_space { &[SPACE] } else { &[] };
        let bent: &Edits<'_> = &[
            ("start.bends_deg", "[300]"),
            ("solver.integrator", "'explicit'"),
            ("solver.step_s", "1e-6"),
            ("control.step_s", "1e-6"),
            ("material.damping_time_s", "0"),
        ];
        // With as much of the angle at each node as the stretch that it stands for: even.
        let mut world = World::new("cantilever", &[ROD, space, bent]);
        let before: Vec<Vector> = (0..world.model.nodes()).map(|node| world.place(node)).collect();
        world.runs(1);
        let moved: Vec<f64> = (0..world.model.nodes())
            .map(|node| (world.place(node) - before[node]).norm())
            .collect();
        let greatest = moved.iter().fold(0.0f64, |most, &way| most.max(way));
        assert!(greatest > 1e-10, "{moved:?}");
        assert!(moved[2..11].iter().all(|&way| way < 1e-9 * greatest), "{moved:?}");
        assert!(moved[0] > 0.1 * greatest && moved[12] > 0.1 * greatest);
    }
}
