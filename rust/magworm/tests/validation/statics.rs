//! Rods at rest under weight.

use crate::beam::{Loads, elastica, elastica_shape};
use crate::report::{Axes, Case, Figure, farthest_from, orders, short};
use crate::world::{CURVATURES, ROD, World, number};

/// From the wall to the tip, or to the magnet at the tip.
pub const LENGTH_M: f64 = 0.1;
/// So thin that stretching (α h²/12L² ≤ 4e-6 of the length) does not show.
pub const THICKNESS_M: f64 = 2e-4;
pub const MESHES: [usize; 4] = [10, 20, 40, 80];
const WIDTH_M: f64 = 0.01;

/// Young's modulus that gives ρ A g L³/EI = α; I/A = h²/12.
pub fn modulus_pa(alpha: f64) -> f64 {
    1000.0 * 9.81 * LENGTH_M.powi(3) * 12.0 / (THICKNESS_M.powi(2) * alpha)
}

/// A long step and a long retardation time: a relaxation, not a motion.
pub const RELAXED: [(&str, &str); 3] =
    [("body.clamp", "'head'"), ("material.damping_time_s", "0.02"), ("solver.step_s", "0.01")];

pub fn cantilever(elements: usize, modulus_pa: f64, edits: &[(&str, &str)]) -> World {
    let (elements, modulus) = (elements.to_string(), number(modulus_pa));
    let mut all = RELAXED.to_vec();
    all.extend([
        ("body.thickness_m", "2e-4"),
        ("body.elements", &elements),
        ("material.youngs_modulus_pa", &modulus),
    ]);
    all.extend_from_slice(edits);
    World::new(ROD, &all)
}

/// Runs until the rod stands still.
pub fn settle(world: &mut World) {
    for _ in 0..400 {
        world.steps(100);
        if world.fastest(0).max(world.fastest(1)) < 1e-10 {
            return;
        }
    }
    panic!("still moving: {:e} m/s", world.fastest(1));
}

/// A cantilever whose soft part, LENGTH_M long in n elements counting the clamped one, ends at a magnet
/// one element long, so that the mesh fits without moving the wall.
pub struct Tipped {
    pub body_m: f64,
    pub magnet_m: f64,
}

impl Tipped {
    pub fn new(soft_elements: usize) -> Self {
        let magnet_m = LENGTH_M / (soft_elements as f64 - 0.5);
        Self { body_m: LENGTH_M + magnet_m, magnet_m }
    }

    /// Values of `body.length_m`, `body.elements` and `body.magnets`.
    pub fn body(&self, soft_elements: usize) -> [String; 3] {
        let middle_m = number(LENGTH_M + 0.5 * self.magnet_m);
        let magnets = format!("[{{position_m={middle_m},polarity=1}}]");
        [number(self.body_m), (soft_elements + 1).to_string(), magnets]
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// What a case of both laws of curvature on all meshes gathers, for the page's table and figure.
pub struct Refined {
    figure: Figure,
    rows: Vec<Vec<String>>,
}

impl Refined {
    pub fn new(title: &str, y: &'static str) -> Self {
        let figure = Figure::new(title, "elements", y, Axes::LogLog).slope(-2.0);
        Self { figure, rows: Vec::new() }
    }

    /// `errors[law][mesh]` of one load, with the two laws' ratio.
    pub fn add(&mut self, load: &str, errors: &[[f64; 4]; 2]) {
        for ((_, law), errors) in CURVATURES.iter().zip(errors) {
            let mut row = vec![load.to_string(), (*law).to_string()];
            row.extend(errors.iter().map(|error| short(*error)));
            self.rows.push(row);
            let points = MESHES.iter().zip(errors).map(|(n, e)| [*n as f64, *e]);
            self.figure.points(format!("{load}, {law}"), points);
        }
        let ratios = errors[1].iter().zip(&errors[0]).map(|(b, a)| format!("{:.2}", b / a));
        let ratio = ["".to_string(), "ratio".to_string()].into_iter().chain(ratios);
        self.rows.push(ratio.collect());
    }

    pub fn report(self, case: &mut Case, what: &str) {
        let head = ["load", "curvature", "10 elements", "20", "40", "80"];
        case.table(what, &head, self.rows);
        case.figure(self.figure);
    }
}

/// Of several orders the one farthest from 2.
pub fn farthest_from_two(errors: &[f64]) -> f64 {
    farthest_from(2.0, &orders(errors))
}

fn heavy(elements: usize, alpha: f64, curvature: &str) -> World {
    let edits = [("gravity_m_s2", "9.81"), ("solver.curvature", curvature)];
    let mut world = cantilever(elements, modulus_pa(alpha), &edits);
    settle(&mut world);
    world
}

/// (x, drop)/L of a node.
fn dropped(world: &World, node: usize) -> [f64; 2] {
    let [x, y] = world.node(node);
    [x / LENGTH_M, -y / LENGTH_M]
}

/// Heavy cantilever against the elastica solved here and tips quoted in the literature: second order in the mesh, as a
/// centred difference is (a slope of 2 within 0.2 over each halving), and within 1e-3 L at 40 elements for κ = φ at
/// every load. With κ = 2 tan(φ/2), which is stiffer than φ by φ²/3, α = 25 needs 80.
#[test]
fn validates_heavy_cantilever() {
    let quoted =
        [(1.0, [0.991246, 0.123471]), (4.0, [0.890111, 0.425159]), (25.0, [0.38616, 0.85590])];
    let edits = [("gravity_m_s2", "9.81"), ("body.thickness_m", "2e-4"), ("body.elements", "40")];
    let mut case = Case::new("heavy_cantilever", "Heavy cantilever, horizontal")
        .equation("EI θ″(s) = −ρAg (L − s) cos θ, θ(0) = 0, θ′(L) = 0; α = ρAgL³/EI")
        .source(
            "F. V. Rohde, Q. Appl. Math. 11 (1953) 337 (the heavy elastica); the equation is \
            solved in the test, Runge–Kutta 4 and shooting",
        )
        .scene(ROD, &[&RELAXED[..], &edits].concat())
        .note(
            "Young's modulus sets α: E = 12 ρ g L³/(h² α). The rod is 0.2 mm thick, so that \
            stretching stays below 4e-6 L. The tip's distance from the elastica's tip counts. At \
            α = 25 the rod turns by √(2α)/n a node at the wall, where κ = 2 tan(φ/2) is stiffer \
            than κ = φ by φ²/3.",
        );
    let mut refined = Refined::new("Heavy cantilever: error of the tip", "error / L");
    let mut shapes = Figure::new("Heavy cantilever, 40 elements", "x / L", "y / L", Axes::Equal);
    for (alpha, tip) in quoted {
        let loads = Loads { weight: alpha, tip: 0.0, overhang: 0.0 };
        let exact = elastica(loads);
        // Quoted are five or six digits.
        assert!(distance(exact, tip) < 1e-5, "reference {exact:?} against {tip:?}");
        shapes.exact("", elastica_shape(loads).into_iter().map(|[x, drop]| [x, -drop]));
        let errors = CURVATURES.map(|(curvature, law)| {
            let default = curvature == CURVATURES[0].0;
            let worlds = MESHES.map(|n| heavy(n, alpha, curvature));
            let errors = worlds.each_ref().map(|w| distance(dropped(w, w.last()), exact));
            if default {
                shapes.points(format!("α = {alpha}"), worlds[2].shape(LENGTH_M));
            }
            let strict = default || alpha < 10.0;
            for mesh in if strict { 2..3 } else { 2..4 } {
                let band = if strict || mesh == 3 { 1e-3 } else { f64::INFINITY };
                let tip = dropped(&worlds[mesh], worlds[mesh].last());
                let what = format!("tip (x, drop), α = {alpha}, {} elements, {law}", MESHES[mesh]);
                case.place(what, "L", [tip, exact], band);
            }
            case.inside(
                format!("order, α = {alpha}, {law}"),
                "",
                farthest_from_two(&errors),
                1.8..=2.2,
            );
            errors
        });
        refined.add(&format!("α = {alpha}"), &errors);
    }
    refined.report(&mut case, "Distance of the tip from the elastica's, over L:");
    case.figure(shapes);
    case.finish();
}

/// A rod that weighs next to nothing with a heavy magnet at its tip, and its loads. EI follows from the load.
fn loaded(soft_elements: usize, load: f64, curvature: &str) -> (World, Loads) {
    let tipped = Tipped::new(soft_elements);
    let filled = 0.99;
    let magnet_m3 = tipped.magnet_m * WIDTH_M * THICKNESS_M;
    let tip_n = magnet_m3 * (filled * 1e5 + (1.0 - filled) * 1.0) * 9.81;
    let second_moment_m4 = WIDTH_M * THICKNESS_M.powi(3) / 12.0;
    let rigidity = tip_n * LENGTH_M.powi(2) / load;
    let rod_n = 1.0 * WIDTH_M * THICKNESS_M * LENGTH_M * 9.81;
    let loads = Loads {
        weight: rod_n * LENGTH_M.powi(2) / rigidity,
        tip: load,
        overhang: 0.5 * tipped.magnet_m / LENGTH_M,
    };
    let [length, elements, placed] = tipped.body(soft_elements);
    let (long, high) = (number(tipped.magnet_m), number(THICKNESS_M * filled));
    let magnet = format!(
        "{{length_m={long},width_m=0.01,height_m={high},remanence_t=0.0,density_kg_m3=1e5}}"
    );
    let edits = [
        ("body.length_m", length.as_str()),
        ("body.elements", &elements),
        ("magnet", &magnet),
        ("body.magnets", &placed),
        ("gravity_m_s2", "9.81"),
        ("material.density_kg_m3", "1.0"),
        ("solver.curvature", curvature),
    ];
    let mut world = cantilever(soft_elements, rigidity / second_moment_m4, &edits);
    settle(&mut world);
    (world, loads)
}

/// Cantilever with a load P at its tip (a heavy, unmagnetised magnet of one element): PL²/EI = 1, 5 and 10. The load sits
/// half the magnet's length beyond the soft rod and the rod weighs up to 1/1000 of it: both are in the reference.
#[test]
fn validates_end_load() {
    let quoted = [(1.0, [0.94357, 0.30172]), (5.0, [0.61237, 0.71379]), (10.0, [0.44500, 0.81061])];
    let edits = [
        ("gravity_m_s2", "9.81"),
        ("body.thickness_m", "2e-4"),
        ("material.density_kg_m3", "1.0"),
        ("magnet.density_kg_m3", "1e5"),
        ("magnet.remanence_t", "0.0"),
    ];
    let mut case = Case::new("end_load", "Cantilever with a load at its tip")
        .equation(
            "EI θ″(s) = −(P + w (L − s)) cos θ, θ(0) = 0, EI θ′(L) = P o cos θ(L), o: \
            distance of the load beyond the soft rod",
        )
        .source(
            "K. E. Bisshopp, D. C. Drucker, Q. Appl. Math. 3 (1945) 272; numbers: K. \
            Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145; with o and w solved in the \
            test",
        )
        .scene(ROD, &[&RELAXED[..], &edits].concat())
        .note(
            "The load is a rigid, unmagnetised magnet, one element long, behind the soft length \
            L. Young's modulus sets PL²/EI. The reference without o and w is checked against the \
            published numbers to 1e-5; the simulator is compared with the reference that has \
            both.",
        );
    let mut refined = Refined::new("Load at the tip: error of the tip", "error / L");
    for (load, tip) in quoted {
        let ideal = elastica(Loads { weight: 0.0, tip: load, overhang: 0.0 });
        assert!(distance(ideal, tip) < 1e-5, "reference {ideal:?} against {tip:?}");
        let errors = CURVATURES.map(|(curvature, law)| {
            let errors = MESHES.map(|n| {
                let (world, loads) = loaded(n, load, curvature);
                let (end, exact) = (dropped(&world, world.last() - 1), elastica(loads));
                if n == 40 {
                    let what = format!("tip (x, drop), PL²/EI = {load}, 40 elements, {law}");
                    case.place(what, "L", [end, exact], 1e-3);
                }
                distance(end, exact)
            });
            case.inside(
                format!("order, PL²/EI = {load}, {law}"),
                "",
                farthest_from_two(&errors),
                1.8..=2.2,
            );
            errors
        });
        refined.add(&format!("PL²/EI = {load}"), &errors);
    }
    refined.report(&mut case, "Distance of the tip from the reference's, over L:");
    case.finish();
}
