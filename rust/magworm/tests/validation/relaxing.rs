//! Rubber that relaxes, against the generalised Maxwell solid in closed form.

use crate::report::{Axes, Case, Figure, farthest_from, orders};
use crate::world::{CURVATURES, ROD, World, number};
use magworm::internals::lanes::{Plane, Scalar, Space};
use magworm::internals::{Anchor, kinematics};
use nalgebra::{Complex, Matrix2, Vector2, Vector3};

/// r and τ₁ of the tests' standard linear solid.
const RATIO: f64 = 0.5;
const TIME_S: f64 = 0.02;
const SOLID: (&str, &str) = ("material.relaxation", "[{ ratio = 0.5, time_s = 0.02 }]");
const SEVERAL: (&str, &str) = (
    "material.relaxation",
    "[{ ratio = 0.5, time_s = 0.02 }, { ratio = 1.7, time_s = 0.3 }, { ratio = 0.2, time_s = 1e-3 }]",
);
const SOURCE: &str =
    "J. D. Ferry, Viscoelastic Properties of Polymers, ch. 3 (generalised Maxwell model)";

/// A way to strain: its name, whether in space, and the axis of the last node that its force shows in; none where it is a torque
/// about the last element.
type Way = (&'static str, bool, Option<usize>);
const WAYS: [Way; 5] = [
    ("stretching", false, Some(0)),
    ("bending", false, Some(1)),
    ("bending in space", true, Some(1)),
    ("bending to the side", true, Some(2)),
    ("twisting", true, None),
];

/// A solver step that is a control step and an episode too.
fn each_step(step: &str) -> [(&'static str, &str); 3] {
    ["solver.step_s", "control.step_s", "control.episode_s"].map(|field| (field, step))
}

/// Two elements, the first one held: what it does not hold of the second one can be strained in each way by itself.
struct Specimen {
    world: World,
    way: Way,
}

impl Specimen {
    fn new(way: Way, edits: &[(&str, &str)]) -> Self {
        let clamped = [("body.clamp", "'head'"), ("body.elements", "2")];
        let space = if way.1 { "3" } else { "2" };
        let edits = [&clamped[..], &[("dimensions", space)], edits].concat();
        Self { world: World::new(ROD, &edits), way }
    }

    /// The generalised force on the specimen while it is strained so [N or N·m], after a step in which it was.
    fn force(&mut self, strain: f64) -> f64 {
        let (name, in_space, shows) = self.way;
        let coordinates = &self.world.model.coordinates;
        let Anchor::Free { dof } = coordinates.anchors[2] else { panic!("the last node is free") };
        let unknown = shows.map_or_else(|| coordinates.twists[1], |axis| Some(dof + axis));
        let unknown = unknown.expect("the last element may twist");
        let rest_m = self.world.model.mesh.element_length_m(1);
        let [x, y, _] = <[f64; 3]>::from(self.world.block.node_position(&self.world.model, 1, 0));
        let (sin, cos) = strain.sin_cos();
        let edge = match name {
            "stretching" => [rest_m * (1.0 + strain), 0.0, 0.0],
            "bending to the side" => [rest_m * cos, 0.0, rest_m * sin],
            "twisting" => [rest_m, 0.0, 0.0],
            _ => [rest_m * cos, rest_m * sin, 0.0],
        };
        let place = [x + edge[0], y + edge[1], edge[2]];
        let axes = self.world.model.dimensions();
        (0..axes).for_each(|axis| self.world.block.q[dof + axis][0] = place[axis]);
        if name == "twisting" {
            self.world.set_frame(1, Vector3::new(0.0, cos, sin), Vector3::x());
        }
        self.world.block.running[0][0] = 1.0;
        if in_space {
            self.world.refresh();
            self.world.assemble::<Space>();
        } else {
            kinematics::<Plane, _>(Scalar, &self.world.model, &mut self.world.block);
            self.world.assemble::<Plane>();
        }
        -self.world.block.rhs[unknown][0] / self.world.model.step_s
    }
}

/// E′ and E″ over E in the long run.
fn moduli(x: f64) -> [f64; 2] {
    [1.0 + RATIO * x * x / (1.0 + x * x), RATIO * x / (1.0 + x * x)]
}

/// The same, measured: a small strain swings until nothing is left of its start, then over one period.
fn measured(way: Way, frequency_hz: f64) -> [f64; 2] {
    const STEPS: u32 = 400;
    const STRAIN: f64 = 1e-3;
    let step = number(1.0 / frequency_hz / f64::from(STEPS));
    let time = each_step(&step);
    let elastic = Specimen::new(way, &time).force(STRAIN);
    let mut relaxing = Specimen::new(way, &[&time[..], &[SOLID]].concat());
    let periods = 1 + (12.0 * TIME_S * frequency_hz).ceil() as u32;
    let mut sums = [0.0; 2];
    for step in 1..=periods * STEPS {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(step) / f64::from(STEPS)).sin_cos();
        let force = relaxing.force(STRAIN * sin) / elastic;
        if step > (periods - 1) * STEPS {
            sums = [sums[0] + force * sin, sums[1] + force * cos];
        }
    }
    sums.map(|sum| 2.0 * sum / f64::from(STEPS))
}

/// Storage and loss modulus over four decades, in all ways to strain.
#[test]
fn validates_moduli_over_four_decades() {
    let mut case = Case::new("moduli_over_four_decades", "Storage and loss modulus")
        .equation("E′ = E (1 + r x²/(1 + x²)), E″ = E r x/(1 + x²), x = ωτ₁")
        .source(SOURCE)
        .scene(ROD, &[("body.clamp", "'head'"), ("body.elements", "2"), SOLID])
        .note(
            "E = 60 kPa in the long run, r = 0.5, τ₁ = 20 ms. One element is strained as a sine in one way after the other, 400 steps a \
            period; the force on its end is that of the equations of a step.",
        );
    let mut figure =
        Figure::new("Moduli of a standard linear solid", "Hz", "modulus / Pa", Axes::LogLog);
    let of = |frequency_hz: f64| moduli(std::f64::consts::TAU * frequency_hz * TIME_S);
    for (k, name) in ["E′", "E″"].into_iter().enumerate() {
        let curve = (0..=60).map(|n| 0.2 * 10f64.powf(f64::from(n) / 20.0));
        figure.exact(name, curve.map(|hz| [hz, 60e3 * of(hz)[k]]));
    }
    // Where the loss tangent is greatest, x = 1/√(1 + r).
    let lossiest_hz = 1.0 / (1.0 + RATIO).sqrt() / TIME_S / std::f64::consts::TAU;
    for frequency_hz in [0.2, 2.0, lossiest_hz, 20.0, 200.0] {
        let exact = of(frequency_hz).map(|part| 60.0 * part);
        for way in WAYS {
            let [stored, lost] = measured(way, frequency_hz).map(|part| 60.0 * part);
            let at = format!("at {frequency_hz:.6} Hz, {}", way.0);
            case.relative(format!("E′ {at}"), "kPa", [stored, exact[0]], 1e-4);
            case.relative(format!("E″ {at}"), "kPa", [lost, exact[1]], 1e-4);
            if way.0 == "stretching" {
                figure.points(format!("E′, {frequency_hz:.3} Hz"), [[frequency_hz, 1e3 * stored]]);
                figure.points(format!("E″, {frequency_hz:.3} Hz"), [[frequency_hz, 1e3 * lost]]);
            }
        }
    }
    let [stored, lost] = measured(WAYS[0], lossiest_hz);
    let greatest = RATIO / (2.0 * (1.0 + RATIO).sqrt());
    case.relative("greatest tan δ", "", [lost / stored, greatest], 1e-4);
    case.figure(figure);
    case.finish();
}

/// A strain that is held: every branch fades in its own time.
#[test]
fn validates_stress_relaxation() {
    let mut case = Case::new("stress_relaxation", "Relaxation of a strain that is held")
        .equation("σ/Eε = 1 + Σ rᵢ e^{−t/τᵢ}")
        .source(SOURCE)
        .scene(ROD, &[("body.clamp", "'head'"), ("body.elements", "2"), SEVERAL])
        .note(
            "One element is strained in one way after the other and held, with steps of 0.1 ms, a tenth of the shortest τᵢ. The strain \
            stands for a whole step about the time that it is given at.",
        );
    for way in WAYS {
        let step = [("solver.step_s", "1e-4")];
        let elastic = Specimen::new(way, &step).force(1e-3);
        let mut relaxing = Specimen::new(way, &[&step[..], &[SEVERAL]].concat());
        let forces: Vec<f64> = (0..10_000).map(|_| relaxing.force(1e-3) / elastic).collect();
        for after in [10, 200, 3000, 9999] {
            // In the middle of the step, the strain having begun with the first one.
            let t = (f64::from(after) + 0.5) * 1e-4;
            let exact: f64 = [(0.5, 0.02), (1.7, 0.3), (0.2, 1e-3)]
                .into_iter()
                .map(|(ratio, time_s): (f64, f64)| ratio * (-t / time_s).exp())
                .sum();
            let what = format!("{}, after {:.1} ms", way.0, 1e3 * t);
            case.relative(what, "", [forces[after as usize], 1.0 + exact], 1e-4);
        }
    }
    case.finish();
}

/// A weight that hangs on the rubber from one moment on: it stretches at once, and creeps.
#[test]
fn validates_creep() {
    let step = number(1e-5);
    let heavy = [
        ("material.youngs_modulus_pa", "1e9"),
        ("material.density_kg_m3", "1.0"),
        ("gravity_m_s2", "981.0"),
        ("start.angle_deg", "-90.0"),
        ("body.clamp", "'head'"),
        ("body.elements", "2"),
        SOLID,
    ];
    let mut case = Case::new("creep", "Creep under a weight")
        .equation("ε/ε∞ = 1 − r/(1 + r) e^{−t/(1 + r)τ₁}")
        .source(SOURCE)
        .scene(ROD, &[&heavy[..], &[("solver.step_s", "1e-5")]].concat())
        .note(
            "r = 0.5, τ₁ = 20 ms. So stiff and light a specimen has next to no inertia; it starts with the strain that the weight gives it at \
            once.",
        );
    let mut world = World::new(ROD, &[&heavy[..], &each_step(&step)].concat());
    let rest_m = world.model.mesh.element_length_m(1);
    let strain = |world: &World| world.node(1)[1] - world.node(2)[1] - rest_m;
    let final_m = world.block.mass[1][0] * 981.0 / world.model.stretch[0].stiffness_n_m;
    world.block.q[1][0] -= final_m / (1.0 + RATIO);
    for (t, exact) in [(0.0, 0.666667), (0.02, 0.828861), (0.06, 0.954888)] {
        while world.block.step_count[0] < (t / 1e-5f64).round() as u64 {
            world.steps(1);
        }
        let formula = 1.0 - RATIO / (1.0 + RATIO) * (-t / (1.0 + RATIO) / TIME_S).exp();
        assert!((formula - exact).abs() < 1e-6);
        case.relative(
            format!("ε/ε∞ after {:.0} ms", 1e3 * t),
            "",
            [strain(&world) / final_m, formula],
            1e-4,
        );
    }
    case.finish();
}

/// A mass on a standard linear solid: 5 Hz in the long run.
const OSCILLATOR: [(&str, &str); 5] = [
    ("material.youngs_modulus_pa", "60e3"),
    // 2 E/(ρ l²) = (2π 5 Hz)² with l = 0.1 m/1.5.
    ("material.density_kg_m3", "27356.724"),
    ("body.clamp", "'head'"),
    ("body.elements", "2"),
    SOLID,
];

/// Angular frequency of the oscillator on its long-time stiffness.
fn omega(world: &World) -> f64 {
    (world.model.stretch[0].stiffness_n_m / world.block.mass[0][0]).sqrt()
}

/// The oscillating root of τs³ + s² + (1 + r)ω²τs + ω² = 0.
fn root(omega: f64) -> Complex<f64> {
    let square = omega * omega;
    let mut s = Complex::new(0.0, omega * (1.0 + RATIO).sqrt());
    for _ in 0..50 {
        let value = ((s * TIME_S + 1.0) * s + (1.0 + RATIO) * square * TIME_S) * s + square;
        let slope = (s * (3.0 * TIME_S) + 2.0) * s + (1.0 + RATIO) * square * TIME_S;
        s -= value / slope;
    }
    s
}

/// The exponent of a vibration that is sampled: x⁺ = 2 Re(z) x − |z|² x⁻ with z = e^{s Δt}, by least squares.
fn exponent(samples: &[f64], spacing_s: f64) -> Complex<f64> {
    let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for three in samples.windows(3) {
        let row = Vector2::new(three[1], -three[0]);
        normal += row * row.transpose();
        right += row * three[2];
    }
    let solved = normal.lu().solve(&right).expect("a vibration");
    let real = 0.5 * solved[0];
    Complex::new(real, (solved[1] - real * real).sqrt()).ln() / spacing_s
}

/// The oscillator once its third root has faded: e^{−0.5 s · 42/s} = 1e-9.
fn oscillating(edits: &[(&str, &str)], step_s: f64) -> (Complex<f64>, f64) {
    let step = number(step_s);
    let mut world = World::new(ROD, &[&OSCILLATOR[..], edits, &each_step(&step)].concat());
    let still_m = world.node(2)[0];
    world.block.q[0][0] += 1e-3;
    world.run(0.5);
    let every = (5e-3 / step_s).round() as u32;
    let mut sample = || {
        world.steps(every);
        world.node(2)[0] - still_m
    };
    let samples: Vec<f64> = (0..80).map(|_| sample()).collect();
    (exponent(&samples, 5e-3), omega(&world))
}

/// Roots that were computed apart from this: −3.75450 ± 33.8715 i. Frequency and decay of the oscillator, with every integrator, and the order in which its step errs.
#[test]
fn validates_relaxing_oscillator() {
    let mut case = Case::new("relaxing_oscillator", "A mass on rubber that relaxes")
        .equation("τ₁ s³ + s² + (1 + r) ω² τ₁ s + ω² = 0")
        .source(SOURCE)
        .scene(ROD, &[&OSCILLATOR[..], &[("solver.integrator", "…"), ("solver.step_s", "…")]].concat())
        .note(
            "ω is that of the mass on the rubber in the long run, r = 0.5, τ₁ = 20 ms. The exponent is fitted to samples after the \
            root that does not oscillate has faded. Orders are those of the error of s.",
        );
    for (integrator, step_s, band, order) in
        [("newmark", 1e-4, 1e-4, 2.0), ("euler", 1e-5, 2e-3, 1.0), ("explicit", 1e-4, 1e-4, 2.0)]
    {
        let name = format!("'{integrator}'");
        let scheme = [("solver.integrator", name.as_str())];
        let (found, omega) = oscillating(&scheme, step_s);
        let exact = root(omega);
        assert!((exact - Complex::new(-3.75450, 33.8715)).norm() < 1e-4, "{exact}");
        case.relative(format!("decay, {integrator}"), "1/s", [-found.re, -exact.re], band);
        case.relative(format!("frequency, {integrator}"), "rad/s", [found.im, exact.im], band);
        let errors = [2.5e-3, 1.25e-3, 6.25e-4]
            .map(|step_s| (oscillating(&scheme, step_s).0 - exact).norm());
        let farthest = farthest_from(order, &orders(&errors));
        case.inside(format!("order, {integrator}"), "", farthest, order - 0.2..=order + 0.2);
    }
    case.finish();
}

/// In its start a body is relaxed: bent or straight, by either law of curvature, its branches bear nothing.
#[test]
fn branches_are_relaxed_at_a_start() {
    let bent = [
        ("start.bends_deg", "[25, -40]"),
        ("start.bends_aside_deg", "[10, 30]"),
        ("start.twists_deg", "[20, 15]"),
    ];
    for (dimensions, shape) in [("2", &bent[..1]), ("3", &bent[..]), ("3", &[])] {
        for (curvature, _) in CURVATURES {
            let edits = [("dimensions", dimensions), ("solver.curvature", curvature)];
            let forces = |material: &[(&str, &str)]| -> Vec<f64> {
                let mut world = World::new(ROD, &[&edits[..], shape, material].concat());
                world.block.running[0][0] = 1.0;
                if dimensions == "3" {
                    world.refresh();
                    world.assemble::<Space>();
                } else {
                    kinematics::<Plane, _>(Scalar, &world.model, &mut world.block);
                    world.assemble::<Plane>();
                }
                world.block.rhs.iter().map(|row| row[0]).collect()
            };
            let (elastic, relaxed) = (forces(&[]), forces(&[SEVERAL]));
            let greatest = elastic.iter().fold(0.0f64, |most, force| most.max(force.abs()));
            for (elastic, relaxed) in elastic.iter().zip(&relaxed) {
                let apart = (elastic - relaxed).abs();
                assert!(apart <= 1e-9 * greatest + 1e-15, "{dimensions}, {curvature}: {apart:e}");
            }
        }
    }
}

/// A model says how its rubber relaxes, or that it does not.
#[test]
fn rubber_that_relaxes_is_explained() {
    let told = |edits: &[(&str, &str)]| World::new(ROD, edits).model.explain();
    let several = told(&[SEVERAL]);
    assert!(
        several.contains("relaxation    0.5 in 0.02 s, 1.7 in 0.3 s, 0.2 in 0.001 s"),
        "{several}"
    );
    let none = told(&[]);
    assert!(none.contains("relaxation    left out: the material has no [[relaxation]]"), "{none}");
}
