//! Body magnets that act on each other: forces of two magnets, momenta, mirror images, a column that they buckle.

use crate::report::{Case, short};
use crate::world::{World, number};
use magworm::internals::lanes::Scalar;
use magworm::internals::magnetic::{Cuboid, MAX_ORDER, PlanarPair};
use magworm::internals::{Phase, run_phase};
use nalgebra::{Rotation3, Vector3};

/// The three magnets of a preset, without drive and ground.
const FREE: [(&str, &str); 4] =
    [("magnetic_terms.mutual", "true"), ("drive", ""), ("ground", ""), ("gravity_m_s2", "0.0")];
/// A magnet of the preset with three.
const MAGNET: Cuboid = Cuboid { length_m: 0.006303, height_m: 0.001628, width_m: 0.007455 };
const REMANENCE_T: f64 = 1.22;
/// Weight of that preset [N].
const WEIGHT_N: f64 = 55.08e-3;

/// A body's place x, y [m] and angle [rad].
type Place = [f64; 3];

/// Impulse on each body in a step over the step, from the magnets on each other alone.
fn wrenches(world: &mut World) -> Vec<Vec<f64>> {
    let World { model, block } = world;
    run_phase(Scalar, model, block, Phase::Kinematics);
    block.rhs.iter_mut().for_each(|row| row[0] = 0.0);
    run_phase(Scalar, model, block, Phase::Mutual);
    let size = model.sizes().body();
    let of_body = |dof: &usize| &block.rhs[*dof..*dof + size];
    let per_step = |rows: &[[f64; 1]]| rows.iter().map(|row| row[0] / model.step_s).collect();
    model.coordinates.bodies.iter().map(|dof| per_step(of_body(dof))).collect()
}

/// A rod without weight between two magnets of the preset, opposed, flush with its ends.
fn rod(elements: usize) -> String {
    let magnet = "magnet = { length_m = 0.006303, height_m = 0.001628, width_m = 0.007455, remanence_t = 1.22, \
                  density_kg_m3 = 7500, angle_deg";
    let section = "thickness_m = 0.004, width_m = 0.01131";
    format!(
        "{{ kind = 'segments', segment = [ \
         {{ length_m = 0.006303, {section}, elements = 1, {magnet} = 0 }} }}, \
         {{ length_m = 0.013697, {section}, elements = {elements} }}, \
         {{ length_m = 0.006303, {section}, elements = 1, {magnet} = 180 }} }} ] }}"
    )
}

/// Wrenches of the magnets of a rod at these places; `alike` turns the second one up.
fn placed(alike: bool, places: [Place; 2]) -> [[f64; 3]; 2] {
    let body = rod(4);
    let edits = [("magnet", ""), ("body", body.as_str())];
    let mut world = World::new("robot", &[&FREE[..], &edits].concat());
    if alike {
        world.block.remanence[1][0] = -world.block.remanence[1][0];
    }
    for (body, place) in places.into_iter().enumerate() {
        let dof = world.model.coordinates.bodies[body];
        (0..3).for_each(|k| world.block.q[dof + k][0] = place[k]);
    }
    let found = wrenches(&mut world);
    [0, 1].map(|body| [found[body][0], found[body][1], found[body][2]])
}

/// The outer magnets of the preset with three, alike, at a distance: x force on the second one [mN].
fn outer(distance_m: f64) -> f64 {
    let mut world = World::new("robot", &FREE);
    world.block.remanence[1][0] = 0.0;
    let [first, .., last] = world.model.coordinates.bodies[..] else { panic!("three bodies") };
    world.block.q[last][0] = world.block.q[first][0] + distance_m;
    1e3 * wrenches(&mut world)[2][0]
}

/// Forces and torques of two magnets of the preset, 6.303 × 7.455 × 1.628 mm and 1.22 T, beside numbers that were computed
/// beforehand by quadrature of Akoun and Yonnet's field and checked against their closed form.
#[test]
fn validates_two_body_magnets() {
    let mut case = Case::new("two_body_magnets", "Two magnets of a body")
        .equation("F = ∬ σ B dS over the charged faces; far away F = ∇(m·B)")
        .source(
            "G. Akoun, J.-P. Yonnet, IEEE Trans. Magn. 20 (1984) 1962: the closed form of the force between parallel cuboids; \
             torques by quadrature with 24 points an edge",
        )
        .scene("robot", &FREE)
        .note(
            "Magnets of the preset with three magnets, two of them on a rod; far away the outer ones of the preset itself, \
             which are dipoles there. Errors of dipoles in parts of its weight, 55.08 mN.",
        );
    for (alike, distance_m, force_mn) in [
        (false, 0.020, -11.442),
        (true, 0.040, 0.663),
        (false, 0.019, -14.206),
        (true, 0.019, 14.206),
        (false, 0.014, -53.223),
        (true, 0.014, 53.223),
    ] {
        let what = if alike { "alike" } else { "opposed" };
        let what = format!("side by side, {what}, {} mm", 1e3 * distance_m);
        let pair = PlanarPair::new(MAGNET, MAGNET, MAX_ORDER);
        let sign = if alike { 1.0 } else { -1.0 };
        let exact =
            1e3 * pair.wrench(distance_m, 0.0, 1.0, 0.0, sign * REMANENCE_T * REMANENCE_T)[0];
        case.absolute(format!("{what}: force, order {MAX_ORDER}"), "mN", [exact, force_mn], 6e-4);
        let found = 1e3 * placed(alike, [[0.0; 3], [distance_m, 0.0, 0.0]])[1][0];
        let share = (found - exact).abs() * 1e-3 / WEIGHT_N;
        case.at_most(format!("{what}: error in a step"), "of the weight", share, 4e-5);
    }
    for (distance_m, force_mn, off) in [(0.040, 0.662687, -0.025), (0.060, 0.129097, -0.011)] {
        let found = outer(distance_m);
        let what = format!("outer magnets, {} mm: error of dipoles", 1e3 * distance_m);
        case.inside(what.clone(), "of F", found / force_mn - 1.0, off - 5e-4..=off + 5e-4);
        let share = (found - force_mn).abs() * 1e-3 / WEIGHT_N;
        case.at_most(what, "of the weight", share, 2e-3);
    }
    for (height_m, force_n, axial, lateral) in
        [(0.0070, -0.49916, -184.0, 100.0), (0.0055, -0.89571, -370.0, 203.0)]
    {
        let on = |x: f64, y: f64| placed(true, [[0.0; 3], [x, y, 0.0]])[1];
        let what = |name: &str| format!("stacked, {} mm: {name}", 1e3 * height_m);
        case.absolute(what("force"), "N", [on(0.0, height_m)[1], force_n], 6e-6);
        let step_m = 1e-6;
        let slope = |a: f64, b: f64| -(a - b) / (2.0 * step_m);
        let along = slope(on(0.0, height_m + step_m)[1], on(0.0, height_m - step_m)[1]);
        let across = slope(on(step_m, height_m)[0], on(-step_m, height_m)[0]);
        case.absolute(what("axial stiffness"), "N/m", [along, axial], 0.5);
        case.absolute(what("lateral stiffness"), "N/m", [across, lateral], 0.5);
    }
    // T1 = −(0.1005 α1 + 0.1569 α2) mN·m.
    let torques = |first: f64, second: f64| {
        placed(false, [[0.0, 0.0, first], [0.02, 0.0, second]]).map(|wrench| 1e3 * wrench[2])
    };
    let angle = 1e-4;
    let [own, other] = [torques(angle, 0.0)[0] / angle, torques(0.0, angle)[0] / angle];
    case.absolute("20 mm: torque by its own angle", "mN·m", [own, -0.1005], 1e-4);
    case.absolute("20 mm: torque by the other's angle", "mN·m", [other, -0.1569], 1e-4);
    case.absolute("20 mm: relative roll", "mN·m", [roll_stiffness(), 0.0738], 1e-4);
    case.finish();
}

/// Torque that holds two magnets 20 mm apart against a turn about the line between them [mN·m/rad].
fn roll_stiffness() -> f64 {
    let mut world = World::new("robot", &[&FREE[..], &[("dimensions", "3")]].concat());
    world.block.remanence[2][0] = 0.0;
    let element = world.model.bodies[1].element;
    let turn = Rotation3::new(Vector3::x() * 1e-4);
    let (up, tangent) = (world.up(element), world.frame_tangent(element));
    world.set_frame(element, turn * up, turn * tangent);
    -1e3 * wrenches(&mut world)[1][3] / 1e-4
}

/// Magnets of three sizes and directions, one beside the middle of its foot.
const MIXED: &str = "{ kind = 'segments', segment = [
    { length_m = 0.014, thickness_m = 0.007, width_m = 0.011, foot = true, elements = 1, magnet = {
        length_m = 0.006, height_m = 0.002, width_m = 0.007, remanence_t = 1.2, density_kg_m3 = 7500 } },
    { length_m = 0.006, thickness_m = 0.004, width_m = 0.011, elements = 4 },
    { length_m = 0.012, thickness_m = 0.008, width_m = 0.013, foot = true, elements = 1, magnet = {
        length_m = 0.008, height_m = 0.002, width_m = 0.006, remanence_t = 1.3, density_kg_m3 = 7500,
        angle_deg = 180, up_m = 0.0015 } },
    { length_m = 0.007, thickness_m = 0.004, width_m = 0.010, elements = 3 },
    { length_m = 0.014, thickness_m = 0.006, width_m = 0.012, foot = true, elements = 2, magnet = {
        length_m = 0.004, height_m = 0.003, width_m = 0.008, remanence_t = 1.1, density_kg_m3 = 7300,
        angle_deg = 50 } } ] }";

/// A body that is bent, and twisted in space.
fn bent(dimensions: &str, body: (&str, &str)) -> World {
    let twists = if dimensions == "3" { "[20, -30]" } else { "[]" };
    let aside = if dimensions == "3" { "[15, 25]" } else { "[]" };
    let shape = [
        ("dimensions", dimensions),
        ("start.bends_deg", "[70, 40, -30]"),
        ("start.twists_deg", twists),
        ("start.bends_aside_deg", aside),
    ];
    let magnet = if body.0 == "body" { [("magnet", "")].as_slice() } else { &[] };
    World::new("robot", &[&FREE[..], magnet, &[body], &shape].concat())
}

/// Sum of forces, and of moments about the origin, over the sums of their sizes.
fn sums(world: &mut World) -> [f64; 2] {
    let found = wrenches(world);
    let (axes, lanes) = (world.model.dimensions(), world.model.sizes().rotations);
    let (mut force, mut moment, mut sizes) = (Vector3::zeros(), Vector3::zeros(), [0.0; 2]);
    for (wrench, dof) in found.iter().zip(&world.model.coordinates.bodies) {
        let vector = |values: &dyn Fn(usize) -> f64, count: usize, first: usize| {
            Vector3::from_fn(|k, _| {
                if (first..first + count).contains(&k) { values(k - first) } else { 0.0 }
            })
        };
        let place = vector(&|k| world.block.q[dof + k][0], axes, 0);
        let f = vector(&|k| wrench[k], axes, 0);
        let t = vector(&|k| wrench[axes + k], lanes, 3 - lanes);
        force += f;
        moment += t + place.cross(&f);
        sizes[0] += f.norm();
        sizes[1] += t.norm() + place.norm() * f.norm();
    }
    [force.norm() / sizes[0], moment.norm() / sizes[1]]
}

/// Wrenches of magnets on each other have no sum, in any pose: each has an equal and opposite one.
#[test]
fn wrenches_of_magnets_on_each_other_sum_to_nothing() {
    for dimensions in ["2", "3"] {
        for body in [("name", "'three alike'"), ("body", MIXED), ("body.magnets", "5")] {
            let mut world = bent(dimensions, body);
            for _ in 0..10 {
                let [force, moment] = sums(&mut world);
                assert!(force <= 1e-15 && moment <= 1e-15, "{body:?}: {force:e}, {moment:e}");
                world.steps(5);
            }
        }
    }
}

/// Changes of momentum, and of angular momentum over m L²/s, in half a second of a bent body that springs back.
fn changes(dimensions: &str, mutual: &str) -> [f64; 2] {
    let mut world = bent(dimensions, ("magnetic_terms.mutual", mutual));
    let momenta = |world: &World| match dimensions {
        "2" => {
            let ([x, y], angular) = world.momenta();
            (Vector3::new(x, y, 0.0), Vector3::z() * angular)
        }
        _ => world.momenta_in_space(),
    };
    let speed = 0.2;
    for dof in world.model.translations.iter().filter(|(_, axis)| *axis == 0) {
        world.block.v[dof.0][0] = speed;
    }
    let (linear, angular) = momenta(&world);
    world.run(0.5);
    let (after, turned) = momenta(&world);
    [(after - linear).norm() / linear.norm(), (turned - angular).norm()]
}

/// In free flight forces between magnets change neither momentum, and lose no more angular momentum than the scheme does
/// without them.
#[test]
fn validates_momenta_of_magnets_in_free_flight() {
    let mut case = Case::new("momenta_of_magnets_in_free_flight", "Magnets in free flight")
        .equation("Σ m v = const., Σ m x × v + Σ I ω = const.")
        .source("Newton; no force from outside")
        .scene("robot", &FREE)
        .note("A bent robot springs back and flies at 0.2 m/s for half a second, with forces between its magnets and without.");
    for dimensions in ["2", "3"] {
        let [with, without] = ["true", "false"].map(|mutual| changes(dimensions, mutual));
        let what = |name: &str| format!("{name}, {dimensions} dimensions");
        case.at_most(what("change of momentum"), "", with[0], 1e-12);
        case.tell(what("change of angular momentum without the forces"), "kg·m²/s", without[1]);
        case.at_most(
            what("change of angular momentum"),
            "kg·m²/s",
            with[1],
            2.0 * without[1] + 1e-18,
        );
    }
    case.finish();
}

/// Greatest distance of nodes from the mirror image of the other run [m], and the way of the head [m].
fn mirrored(magnets: usize) -> [f64; 2] {
    let count = number(magnets as f64).replace("e0", "");
    let length_m = 0.02 * (magnets - 1) as f64 + 0.014;
    let run = |speed: f64| {
        let from = if speed > 0.0 { -0.03 } else { length_m + 0.03 };
        let motion = format!(
            "{{ kind = 'constant', x_m = {}, y_m = -0.022, speed_m_s = {} }}",
            number(from),
            number(speed)
        );
        // The head of one is the tail of the other.
        let polarity = if speed < 0.0 && magnets.is_multiple_of(2) { "-1" } else { "1" };
        let mut world = World::new(
            "robot",
            &[
                ("magnetic_terms.mutual", "true"),
                ("body.magnets", count.as_str()),
                ("body.first_polarity", polarity),
                ("drive.motion", &motion),
                ("reset.random_drive", "false"),
            ],
        );
        let nodes = world.last() + 1;
        let mut all = Vec::new();
        for _ in 0..30 {
            world.run(0.02);
            all.push((0..nodes).map(|node| world.node(node)).collect::<Vec<_>>());
        }
        all
    };
    let (one, other) = (run(0.1), run(-0.1));
    let mut apart: f64 = 0.0;
    for (one, other) in one.iter().zip(&other) {
        for (a, b) in one.iter().zip(other.iter().rev()) {
            apart = apart.max((a[0] - (length_m - b[0])).hypot(a[1] - b[1]));
        }
    }
    [apart, (one[29][0][0] - one[0][0][0]).abs()]
}

/// A pass from the right is the mirror image of one from the left: the source of a pair is the magnet nearer the middle, and
/// of two that are as near each is the source of half.
#[test]
fn mirror_images_of_robots_with_mutual_magnets_stay_mirror_images() {
    for magnets in [3, 4, 5] {
        let [apart_m, way_m] = mirrored(magnets);
        println!("{magnets} magnets: {apart_m:e} m apart, {way_m:e} m on the way");
        assert!(apart_m <= 1e-9 && way_m > 1e-3, "{magnets}: {apart_m:e} m of {way_m:e} m");
    }
}

/// Modulus below which a free rod with two opposed magnets flush with its ends folds, in closed form [Pa].
const CRITICAL_PA: f64 = 14147.0;

/// Growth rate of the bend of that rod over a second [1/s].
fn growth(elements: usize, modulus_pa: f64) -> f64 {
    let body = rod(elements);
    let modulus = number(modulus_pa);
    let edits = [
        ("body", body.as_str()),
        ("magnet", ""),
        ("material.youngs_modulus_pa", &modulus),
        ("material.damping_time_s", "0.005"),
        ("solver.step_s", "0.001"),
        ("start.bends_deg", "[0.01]"),
    ];
    let mut world = World::new("robot", &[&FREE[..], &edits].concat());
    let bend = |world: &World| {
        let angle = |body: usize| world.block.planar_pose(&world.model, body, 0)[2];
        (angle(1) - angle(0)).abs()
    };
    world.run(0.4);
    let before = bend(&world);
    world.run(1.0);
    (bend(&world) / before).ln()
}

/// The magnets' thrust and torque fold a free rod below a critical modulus: E I k cot(kℓ/2) − P a + K₁₁ − K₁₂ = 0.
#[test]
fn validates_the_fold_of_a_free_rod() {
    let mut case = Case::new("fold_of_a_free_rod", "Two magnets fold a free rod")
        .equation(
            "EI k cot(kℓ/2) − P a + K₁₁ − K₁₂ = 0, k = √(P (1 − ε)/EI), ε = P/EA, magnets 2a + ℓ (1 − ε) apart, a = 3.1515 mm, \
             ℓ = 13.697 mm: E_c = 14147.0 Pa",
        )
        .source("Euler's column between rigid ends, with force P and torques K of the magnets from the closed form")
        .scene("robot", &FREE)
        .note(
            "No weight, no ground. The bend of a rod grows above the critical load and shrinks below it; E_c is where the rate of \
             growth over a second, linear in E nearby, passes through zero.",
        );
    let meshes = [12, 24, 48];
    let found = meshes.map(|elements| {
        let (low, high) = (0.997 * CRITICAL_PA, 1.003 * CRITICAL_PA);
        let [above, below] = [low, high].map(|modulus_pa| growth(elements, modulus_pa));
        low + (high - low) * above / (above - below)
    });
    for (elements, found_pa) in meshes.into_iter().zip(found) {
        let band = 4.5e-3 * (12.0 / elements as f64).powi(2);
        case.relative(format!("E_c, {elements} elements"), "Pa", [found_pa, CRITICAL_PA], band);
    }
    let order = ((found[1] - found[0]) / (found[2] - found[1])).log2();
    case.inside("order in the mesh", "", order, 1.8..=2.2);
    let limit_pa = found[2] + (found[2] - found[1]) / 3.0;
    case.relative("E_c, extrapolated", "Pa", [limit_pa, CRITICAL_PA], 1e-4);
    case.table(
        "Found:",
        &["elements", "E_c [Pa]"],
        meshes.iter().zip(found).map(|(n, e)| vec![n.to_string(), short(e)]).collect(),
    );
    case.finish();
}
