//! Rods at rest.

use crate::beam::{Loads, elastica};
use crate::world::{ROD, World, number};

const LENGTH_M: f64 = 0.1;
/// So thin that stretching (α h²/12L² ≤ 4e-6 of the length) does not show.
const THICKNESS_M: f64 = 2e-4;

/// Young's modulus that gives ρ A g L³/EI = α; I/A = h²/12.
fn modulus_pa(alpha: f64) -> f64 {
    1000.0 * 9.81 * LENGTH_M.powi(3) * 12.0 / (THICKNESS_M.powi(2) * alpha)
}

fn cantilever(elements: usize, modulus_pa: f64, edits: &[(&str, &str)]) -> World {
    let (elements, modulus) = (elements.to_string(), number(modulus_pa));
    let mut all = vec![
        ("body.clamp", "'head'"),
        ("body.thickness_m", "2e-4"),
        ("body.elements", &elements),
        ("material.youngs_modulus_pa", &modulus),
        // Backward Euler at a long step and a long retardation time: a relaxation, not a motion.
        ("material.damping_time_s", "0.02"),
        ("solver.step_s", "0.01"),
    ];
    all.extend_from_slice(edits);
    World::new(ROD, &all)
}

/// Runs until the rod stands still.
fn settle(world: &mut World) {
    for _ in 0..400 {
        world.steps(100);
        if world.fastest(0).max(world.fastest(1)) < 1e-10 {
            return;
        }
    }
    panic!("still moving: {:e} m/s", world.fastest(1));
}

/// (x, drop)/L of the tip under the rod's own weight.
fn heavy_tip(elements: usize, alpha: f64) -> [f64; 2] {
    let mut world = cantilever(elements, modulus_pa(alpha), &[("gravity_m_s2", "9.81")]);
    settle(&mut world);
    let [x, y] = world.node(world.last());
    [x / LENGTH_M, -y / LENGTH_M]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Heavy cantilever, EI θ″ = −ρ A g (L − s) cos θ, against the elastica solved here and the tip that the
/// physics brief quotes: second order in the mesh, as a centred difference is (a slope of 2 within 0.2 over each
/// halving), and within 1e-3 L at 40 elements, the required accuracy. At α = 25 this needs 80: there the rod
/// turns by √(2α)/n a node at the wall, and κ = 2 tan(φ/2) is stiffer than φ by φ²/3.
#[test]
fn validates_heavy_cantilever() {
    let quoted =
        [(1.0, [0.991246, 0.123471]), (4.0, [0.890111, 0.425159]), (25.0, [0.38616, 0.85590])];
    for (alpha, brief) in quoted {
        let exact = elastica(Loads { weight: alpha, tip: 0.0, overhang: 0.0 });
        // The brief gives five or six digits.
        assert!(distance(exact, brief) < 1e-5, "reference {exact:?} against {brief:?}");
        let errors = [10, 20, 40, 80].map(|n| distance(heavy_tip(n, alpha), exact));
        let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
        let words = errors.map(|e| format!("{e:.1e}")).join(" ");
        println!("heavy cantilever α {alpha}: error/L at 10/20/40/80 {words}, orders {orders:.2?}");
        assert!(errors[if alpha < 10.0 { 2 } else { 3 }] < 1e-3);
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.2));
    }
}

/// Cantilever with a load P at its tip (a short, heavy, unmagnetised magnet): PL²/EI = 1 and 5 give drops
/// 0.30172 and 0.71379, shortenings 0.05643 and 0.38763 of L. Here the load sits half the magnet's length
/// beyond the soft rod and the rod weighs 1/1000 of it: both are in the reference.
#[test]
fn validates_end_load() {
    for (load, brief) in [(1.0, [0.94357, 0.30172]), (5.0, [0.61237, 0.71379])] {
        let (magnet_m, soft_m) = (2e-4, LENGTH_M - 2e-4);
        let exact_ideal = elastica(Loads { weight: 0.0, tip: load, overhang: 0.0 });
        assert!(distance(exact_ideal, brief) < 1e-5, "reference {exact_ideal:?} against {brief:?}");
        let (width_m, filled) = (0.01, 0.99);
        let body_kg = magnet_m * width_m * THICKNESS_M * (filled * 1e5 + (1.0 - filled) * 1.0);
        let second_moment_m4 = width_m * THICKNESS_M.powi(3) / 12.0;
        let modulus = body_kg * 9.81 * soft_m * soft_m / (load * second_moment_m4);
        let rod_n = 1.0 * width_m * THICKNESS_M * soft_m * 9.81;
        let rigidity = modulus * second_moment_m4;
        let loads = Loads {
            weight: rod_n * soft_m * soft_m / rigidity,
            tip: body_kg * 9.81 * soft_m * soft_m / rigidity,
            overhang: 0.5 * magnet_m / soft_m,
        };
        let exact = elastica(loads);
        let height = number(THICKNESS_M * filled);
        let magnet = format!(
            "{{length_m=2e-4,width_m=0.01,height_m={height},remanence_t=0.0,density_kg_m3=1e5}}"
        );
        let placed = format!("[{{position_m={},polarity=1}}]", LENGTH_M - 0.5 * magnet_m);
        let edits = [
            ("magnet", magnet.as_str()),
            ("body.magnets", &placed),
            ("gravity_m_s2", "9.81"),
            ("material.density_kg_m3", "1.0"),
        ];
        let mut world = cantilever(40, modulus, &edits);
        settle(&mut world);
        let [x, y] = world.node(world.last() - 1);
        let error = distance([x / soft_m, -y / soft_m], exact);
        println!("end load {load}: error/L {error:.2e}");
        assert!(error < 1e-3);
    }
}

/// A magnet at the tip in a uniform field bends the rod to a circular arc, θ = (m B L/EI) sin(φ − θ), with m
/// the moment Br V/μ0, L the length of the soft part (the rigid magnet does not bend) and φ the angle from
/// moment to field. For φ = 90°: c = 0.5, 1, 2 give 25.794°, 42.346°, 59.007°. The discrete arc has
/// 2 tan(φ_i/2) in place of φ_i: an error of (θ/n)²/12 ≤ 6e-5 of θ at 40 elements; the wall sits up to a
/// quarter of an element off where a magnet shifts the mesh: 1/40/40/4 of L. Together below 1e-3.
#[test]
fn validates_tip_magnet() {
    let (magnet_m, soft_m, thickness_m, width_m): (f64, f64, f64, f64) = (4e-3, 0.096, 4e-3, 0.01);
    let volume_m3 = magnet_m * 0.009 * 0.003;
    let moment = 1.22 * volume_m3 / (4e-7 * std::f64::consts::PI);
    let rigidity = 100e3 * width_m * thickness_m.powi(3) / 12.0;
    for (load, quoted_deg) in [(0.5, 25.794), (1.0, 42.346), (2.0, 59.007)] {
        let field = number(-load * rigidity / (moment * soft_m));
        let edits = [
            ("body.thickness_m", "4e-3"),
            (
                "magnet",
                "{length_m=4e-3,width_m=0.009,height_m=0.003,remanence_t=1.22,density_kg_m3=7500}",
            ),
            ("body.magnets", "[{position_m=0.098,polarity=1}]"),
            ("field", "{x_t=0.0,y_t=0.0}"),
            ("field.x_t", &field),
        ];
        let mut world = cantilever(40, 100e3, &edits);
        settle(&mut world);
        let [x, y, theta] = world.block.magnet_pose(&world.model, 0, 0);
        let error = (theta.to_degrees() - quoted_deg).abs() / quoted_deg;
        // End of the arc, then half a magnet along the tangent.
        let radius = soft_m / theta;
        let arc = [
            radius * theta.sin() + 0.5 * magnet_m * theta.cos(),
            radius * (1.0 - theta.cos()) + 0.5 * magnet_m * theta.sin(),
        ];
        let off_arc = distance([x, y], arc) / LENGTH_M;
        println!(
            "tip magnet c {load}: θ {:.4}° error {error:.2e}, off the arc {off_arc:.2e} L",
            theta.to_degrees()
        );
        assert!(error < 1e-3 && off_arc < 1e-3);
    }
}
