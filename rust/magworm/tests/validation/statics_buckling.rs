//! Columns that buckle.

use crate::beam::{Loads, buckling_factor};
use crate::report::{Axes, Case, Figure};
use crate::statics::{
    LENGTH_M, MESHES, THICKNESS_M, Tipped, cantilever, farthest_from_two, modulus_pa,
};
use crate::world::{ROD, World, number};

/// A rod that stands on its clamped head, slightly pushed. The long retardation time and the step make it creep to or
/// away from the vertical at a rate of (load − critical)/τ, with all else dead after a second.
const STANDING: [(&str, &str); 6] = [
    ("body.clamp", "'head'"),
    ("start.angle_deg", "90.0"),
    ("gravity_m_s2", "9.81"),
    ("body.thickness_m", "2e-4"),
    ("material.damping_time_s", "0.1"),
    ("solver.step_s", "0.01"),
];

/// Whether the deflection of the tip still grows after two seconds.
fn falls(mut world: World) -> bool {
    world.set_velocity(|[_, y]| [1e-6 * (y / LENGTH_M).powi(2), 0.0], 0.0);
    world.run(2.0);
    let before = world.node(world.last())[0].abs();
    world.run(1.0);
    world.node(world.last())[0].abs() > before
}

/// Load at which the column begins to fall, by bisection to 1e-7.
fn critical(mut low: f64, mut high: f64, column: impl Fn(f64) -> World) -> f64 {
    assert!(!falls(column(low)) && falls(column(high)));
    while high - low > 1e-7 * high {
        let middle = 0.5 * (low + high);
        if falls(column(middle)) { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

fn standing(elements: usize, modulus: f64, edits: &[(&str, &str)]) -> World {
    cantilever(elements, modulus, &[&STANDING[..], edits].concat())
}

/// Rod with a heavy magnet of one element at its top; P is the magnet's weight, EI = P L²/load.
fn topped(soft_elements: usize, load: f64) -> (World, Loads) {
    let tipped = Tipped::new(soft_elements);
    let (width_m, filled) = (0.01, 0.99);
    let volume_m3 = tipped.magnet_m * width_m * THICKNESS_M;
    let tip_n = volume_m3 * (filled * 1e5 + (1.0 - filled) * 1.0) * 9.81;
    let rod_n = 1.0 * width_m * THICKNESS_M * LENGTH_M * 9.81;
    let loads =
        Loads { weight: rod_n / tip_n, tip: 1.0, overhang: 0.5 * tipped.magnet_m / LENGTH_M };
    let modulus = 12.0 * tip_n * LENGTH_M.powi(2) / (load * width_m * THICKNESS_M.powi(3));
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
        ("material.density_kg_m3", "1.0"),
    ];
    (standing(soft_elements, modulus, &edits), loads)
}

/// A clamped column falls under its own weight at ρAgL³/EI = 7.8373 (Greenhill) and under a load on its top at
/// PL²/EI = π²/4 (Euler); the load sits half an element above the soft rod, which is in the reference.
#[test]
fn validates_buckling() {
    let mut case = Case::new("buckling", "Buckling of a clamped column")
        .equation(
            "Greenhill: (ρAgL³/EI)_c = 7.8373; Euler: (PL²/EI)_c = π²/4; general: EI θ″ + \
            (P + w (L − s)) θ = 0, θ(0) = 0, EI θ′(L) = P o θ(L)",
        )
        .source(
            "A. G. Greenhill, Proc. Camb. Phil. Soc. 4 (1881) 65; L. Euler (1744), in S. P. \
            Timoshenko, J. M. Gere, Theory of Elastic Stability; the general equation is solved \
            in the test by shooting",
        )
        .scene(ROD, &STANDING)
        .note(
            "The critical load is found by bisection: after a push of 1e-6 m/s the deflection \
            of the tip shrinks below it and grows above it. In Euler's column the load is the \
            weight of a rigid magnet, one element long, on a rod without weight: it acts a \
            distance o, half an element, above the soft length L. o and the rod's remaining \
            weight are in the reference, which is checked against both published numbers.",
        );
    let greenhill = buckling_factor(Loads { weight: 1.0, tip: 0.0, overhang: 0.0 });
    let euler = buckling_factor(Loads { weight: 0.0, tip: 1.0, overhang: 0.0 });
    let euler_exact = std::f64::consts::PI.powi(2) / 4.0;
    assert!((greenhill / 7.837347 - 1.0).abs() < 1e-6, "reference {greenhill}");
    assert!((euler / euler_exact - 1.0).abs() < 1e-9, "reference {euler}");

    let own = MESHES.map(|n| {
        let elements = n.to_string();
        let load = critical(7.0, 9.0, |load| {
            standing(n, modulus_pa(load), &[("body.elements", &elements)])
        });
        if n == 40 {
            case.relative("ρAgL³/EI, 40 elements", "", [load, greenhill], 1e-3);
        }
        (load / greenhill - 1.0).abs()
    });
    let top = MESHES.map(|n| {
        let exact = buckling_factor(topped(n, 1.0).1);
        let load = critical(0.8 * exact, 1.2 * exact, |load| topped(n, load).0);
        if n == 40 {
            case.relative("PL²/EI with o and w, 40 elements", "", [load, exact], 1e-3);
        }
        (load / exact - 1.0).abs()
    });
    let mut figure =
        Figure::new("Buckling of a column", "elements", "error of the critical load", Axes::LogLog)
            .slope(-2.0);
    for (name, errors) in [("own weight", own), ("load on top", top)] {
        case.inside(format!("order, {name}"), "", farthest_from_two(&errors), 1.8..=2.2);
        figure.points(name, MESHES.iter().zip(errors).map(|(n, e)| [*n as f64, e]));
    }
    case.figure(figure);
    case.finish();
}
