//! Rods that buckle sideways: a column, and deep cantilevers that twist as they give way.

use crate::beam::runge_kutta;
use crate::report::Case;
use crate::statics::{LENGTH_M, RELAXED, Tipped};
use crate::world::{ROD, World, number};

/// The thin edge of the section, to the side, and the deep one, upwards.
const THIN_M: f64 = 2e-4;
const DEEP_M: f64 = 1e-2;
/// What the magnet at the tip fills of the section.
const FILLED: f64 = 0.99;

/// The long retardation time and the step make the rod creep to or away from its plane at a rate of
/// (load − critical)/τ, with all else dead after two seconds.
const CREEPING: [(&str, &str); 7] = [
    ("dimensions", "3"),
    ("gravity_m_s2", "9.81"),
    ("body.width_m", "2e-4"),
    ("body.thickness_m", "1e-2"),
    ("material.poisson_ratio", "0.5"),
    ("material.damping_time_s", "0.1"),
    ("solver.step_s", "0.01"),
];

/// I to the side and J [m⁴].
fn section() -> [f64; 2] {
    let thin = THIN_M / DEEP_M;
    let torsion = 1.0 / 3.0 - 0.21 * thin * (1.0 - thin.powi(4) / 12.0);
    [DEEP_M * THIN_M.powi(3) / 12.0, DEEP_M * THIN_M.powi(3) * torsion]
}

/// √(EI GJ)/E with G = E/3.
fn mixed_m4() -> f64 {
    let [second, torsion] = section();
    (second * torsion / 3.0).sqrt()
}

/// Whether the deflection of the tip to the side still grows after two seconds.
fn falls(mut world: World) -> bool {
    let far = world.place(world.last()).norm();
    world.set_flow(
        |place| nalgebra::Vector3::z() * (1e-6 * (place.norm() / far).powi(2)),
        nalgebra::Vector3::zeros(),
    );
    world.run(2.0);
    let before = world.place(world.last()).z.abs();
    world.run(1.0);
    world.place(world.last()).z.abs() > before
}

/// Load at which the rod begins to fall, by bisection to 1e-5.
fn critical(about: f64, rod: impl Fn(f64) -> World) -> f64 {
    let (mut low, mut high) = (0.9 * about, 1.1 * about);
    assert!(!falls(rod(low)) && falls(rod(high)), "no critical load between {low} and {high}");
    while high - low > 1e-5 * high {
        let middle = 0.5 * (low + high);
        if falls(rod(middle)) { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// A rod that weighs ρAgL³ = `load` · `rigidity` · E; `rigidity` in m⁴.
fn heavy(load: f64, rigidity_m4: f64, elements: usize, edits: &[(&str, &str)]) -> World {
    let weight = 1000.0 * 9.81 * THIN_M * DEEP_M * LENGTH_M.powi(3);
    let (modulus, elements) = (number(weight / (load * rigidity_m4)), elements.to_string());
    let own = [("material.youngs_modulus_pa", modulus.as_str()), ("body.elements", &elements)];
    World::new(ROD, &[&RELAXED[..], &CREEPING, &own, edits].concat())
}

/// A rod without weight to speak of with a heavy magnet at its tip, of weight P: PL² = `load` √(EI GJ). Also the rod's
/// weight over P and the distance of the load beyond the soft length, over L.
fn loaded(load: f64, soft: usize) -> (World, [f64; 2]) {
    let tipped = Tipped::new(soft);
    let volume = tipped.magnet_m * THIN_M * DEEP_M;
    let tip_n = volume * (FILLED * 1e5 + (1.0 - FILLED)) * 9.81;
    let rod_n = THIN_M * DEEP_M * LENGTH_M * 9.81;
    let modulus = number(tip_n * LENGTH_M.powi(2) / (load * mixed_m4()));
    let [length, elements, placed] = tipped.body(soft);
    let magnet = format!(
        "{{length_m={},width_m={},height_m={DEEP_M},remanence_t=0.0,density_kg_m3=1e5}}",
        number(tipped.magnet_m),
        number(THIN_M * FILLED)
    );
    let edits = [
        ("body.length_m", length.as_str()),
        ("body.elements", &elements),
        ("magnet", &magnet),
        ("body.magnets", &placed),
        ("material.density_kg_m3", "1.0"),
        ("material.youngs_modulus_pa", &modulus),
    ];
    let world = World::new(ROD, &[&RELAXED[..], &CREEPING, &edits].concat());
    (world, [rod_n / tip_n, 0.5 * tipped.magnet_m / LENGTH_M])
}

/// Smallest λ for which GJ φ″ + λ² M(s)²/EI φ = 0, φ(0) = 0, φ′(1) = 0 has a solution besides 0; M of a load `tip` at
/// 1 + `overhang` and of a weight `own` per length, units L = √(EI GJ) = 1.
fn lateral_factor(tip: f64, own: f64, overhang: f64) -> f64 {
    let miss = |factor: f64| {
        let moment = |s: f64| factor * (tip * (1.0 + overhang - s) + 0.5 * own * (1.0 - s).powi(2));
        let rate = |s: f64, y: [f64; 2]| [y[1], -moment(s).powi(2) * y[0]];
        runge_kutta([0.0, 1.0], rate, |_| {})[1]
    };
    let (mut low, mut high) = (0.0, 0.1);
    while miss(high) > 0.0 {
        (low, high) = (high, high + 0.1);
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if miss(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Greenhill's column falls to the side that is weak, and a deep cantilever under its weight or a load at its tip gives
/// way sideways as it twists. To first order in the deflection w to the side and the twist φ: EI w″ = M φ and
/// GJ φ′ = P (w_P − w − (s_P − s) w′), from which GJ φ″ = −M²φ/EI, with φ′(L) = 0 where the load hangs in the centre
/// line of the rigid end. What the deflection in the plane of the load changes is of the order of EI/EI₁ = 4e-4.
#[test]
fn validates_space_buckling() {
    let mut case = Case::new("space_buckling", "Buckling to the side")
        .equation(
            "Greenhill: ρAgL³/EI = 7.8373. Lateral–torsional: GJ φ″ + M(s)² φ/EI = 0, φ(0) = φ′(L) = 0: \
            PL²/√(EI GJ) = 4.0126 under a load at the tip, qL³/√(EI GJ) = 12.85 under its own weight",
        )
        .source(
            "A. G. Greenhill (1881); L. Prandtl, Kipperscheinungen (1899); A. G. M. Michell, Phil. Mag. \
            48 (1899) 298; S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, § 6.3; the equation \
            is solved in the test by shooting",
        )
        .scene(ROD, &[&RELAXED[..], &CREEPING].concat())
        .note(
            "The section is 0.2 mm wide and 10 mm deep; EI: to the side. Critical loads by bisection: \
            after a push to the side of 1e-6 m/s the deflection shrinks below them and grows above. The load \
            at the tip is a rigid, unmagnetised magnet of one element, which acts half an element beyond the \
            soft length: that and the rod's remaining weight are in the reference.",
        );
    let (michell, own) = (lateral_factor(1.0, 0.0, 0.0), lateral_factor(0.0, 1.0, 0.0));
    assert!((michell / 4.0126 - 1.0).abs() < 1e-4, "reference {michell}");
    assert!((own / 12.8537 - 1.0).abs() < 1e-3, "reference {own}");
    let weak = section()[0];
    for (elements, band) in [(20, 2.5e-3), (40, 1e-3)] {
        let column =
            critical(7.8373, |load| heavy(load, weak, elements, &[("start.angle_deg", "90.0")]));
        case.relative(
            format!("ρAgL³/EI of a column, {elements} elements"),
            "",
            [column, 7.837347],
            band,
        );
        let hung = critical(own, |load| heavy(load, mixed_m4(), elements, &[]));
        case.relative(format!("qL³/√(EI GJ), {elements} elements"), "", [hung, own], 2.0 * band);
        let [light, overhang] = loaded(4.0, elements).1;
        let exact = lateral_factor(1.0, light, overhang);
        let tip = critical(exact, |load| loaded(load, elements).0);
        case.relative(
            format!("PL²/√(EI GJ) with o and q, {elements} elements"),
            "",
            [tip, exact],
            2.0 * band,
        );
    }
    case.finish();
}
