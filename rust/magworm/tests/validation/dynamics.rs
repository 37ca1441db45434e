//! Vibrations of a clamped rod.

use crate::beam::mode_shape;
use crate::report::Case;
use crate::statics::{MESHES, Refined, farthest_from_two};
use crate::world::{CURVATURES, ROD, World, number};
use magworm::internals::Anchor;
use nalgebra::{Complex, Matrix2, Vector2};

const LENGTH_M: f64 = 0.1;
const THICKNESS_M: f64 = 4e-3;
/// Amplitude over length: nonlinear terms are of the order of (βL)² times its square, 6e-7 for the third mode.
const AMPLITUDE: f64 = 1e-4;

const UNDAMPED: [(&str, &str); 3] =
    [("solver.integrator", "'explicit'"), ("solver.step_s", "2e-5"), ("control.step_s", "2e-5")];

/// ω = (βL)² √(EI/ρAL⁴) of a slender cantilever.
fn exact_rad_s(beta: f64) -> f64 {
    beta * beta * (100e3 * THICKNESS_M.powi(2) / 12.0 / 1000.0).sqrt() / LENGTH_M.powi(2)
}

/// A cantilever that moves in one of its modes: deflection 0, velocity ω a L times the shape.
fn in_mode(beta: f64, edits: &[(&str, &str)]) -> World {
    let mut all = vec![("body.clamp", "'head'"), ("body.elements", "40")];
    all.extend_from_slice(edits);
    let mut world = World::new(ROD, &all);
    let speed = exact_rad_s(beta) * AMPLITUDE * LENGTH_M;
    world.set_velocity(|[x, _]| [0.0, 0.5 * speed * mode_shape(beta, x / LENGTH_M)], 0.0);
    world
}

/// Amplitude of a mode: its projection on the mass.
fn amplitude(world: &World, beta: f64) -> f64 {
    let place = |anchor: &Anchor| match *anchor {
        Anchor::Free { dof } => Some(dof),
        _ => None,
    };
    let dofs = world.model.coordinates.anchors.iter().filter_map(place);
    dofs.map(|dof| {
        let shape = mode_shape(beta, world.block.q[dof][0] / LENGTH_M);
        world.block.mass[dof + 1][0] * shape * world.block.q[dof + 1][0]
    })
    .sum()
}

/// Angular frequency and decay rate from the zero crossings and peaks of a mode over `periods`.
fn vibration(world: &mut World, beta: f64, periods: usize) -> (f64, f64) {
    let dt = world.model.step_s;
    let (mut before, mut crossings, mut peaks, mut peak) = (0.0, Vec::new(), Vec::new(), 0.0f64);
    let mut step = 0.0;
    while crossings.len() <= 2 * periods {
        world.steps(1);
        step += 1.0;
        let now = amplitude(world, beta);
        peak = peak.max(now.abs());
        if before * now < 0.0 {
            crossings.push(dt * (step - now / (now - before)));
            peaks.push(std::mem::take(&mut peak));
        }
        before = now;
    }
    let last = crossings.len() - 1;
    let span = crossings[last] - crossings[0];
    let omega = std::f64::consts::PI * last as f64 / span;
    (omega, (peaks[1] / peaks[last]).ln() / (span * (last as f64 - 1.0) / last as f64))
}

/// First three natural frequencies, βL = 1.8751, 4.6941 and 7.8548, with the explicit scheme (which does not damp): the
/// mesh's error is of second order, within 0.5 % at 40 elements.
#[test]
fn validates_cantilever_frequencies() {
    let mut case = Case::new("cantilever_frequencies", "Frequencies of a cantilever")
        .equation("ω = (βL)² √(EI/ρAL⁴), cos βL cosh βL = −1: βL = 1.8751, 4.6941, 7.8548")
        .source("S. P. Timoshenko, Vibration Problems in Engineering; any textbook of vibrations")
        .scene(ROD, &[&[("body.clamp", "'head'"), ("body.elements", "40")], &UNDAMPED[..]].concat())
        .note(
            "The rod starts straight with the velocity of a mode, amplitude 1e-4 L. The \
            frequency comes of the zero crossings of the mode's share of the motion. The decay \
            shows that the explicit scheme does not damp. Amplitudes are small, so both laws of \
            curvature give the same.",
        );
    let mut refined = Refined::new("Frequencies of a cantilever", "error of ω");
    // Beside the third mode the others show more, as its shape is that of the mesh less closely.
    let modes = [(1.87510407, 1, 1e-6), (4.69409113, 4, 1e-6), (7.85475744, 8, 1e-5)];
    for (mode, (beta, periods, still)) in (1..).zip(modes) {
        let exact = exact_rad_s(beta);
        let errors = CURVATURES.map(|(curvature, _)| {
            MESHES.map(|n| {
                let elements = n.to_string();
                let fit = [("body.elements", elements.as_str()), ("solver.curvature", curvature)];
                let mut world = in_mode(beta, &[&UNDAMPED[..], &fit].concat());
                let (omega, decay) = vibration(&mut world, beta, periods);
                if n == 40 && curvature == CURVATURES[0].0 {
                    case.relative(
                        format!("ω of mode {mode}, 40 elements"),
                        "rad/s",
                        [omega, exact],
                        5e-3,
                    );
                    case.inside(
                        format!("decay/ω of mode {mode}"),
                        "",
                        decay / omega,
                        -still..=still,
                    );
                }
                (omega / exact - 1.0).abs()
            })
        });
        case.inside(format!("order, mode {mode}"), "", farthest_from_two(&errors[0]), 1.8..=2.2);
        refined.add(&format!("mode {mode}"), &errors);
    }
    refined.report(&mut case, "Error of ω, as a part of ω:");
    case.finish();
}

/// Angular frequency and decay rate of a scheme from z, by which a step multiplies a vibration.
fn rates(z: Complex<f64>, step: f64) -> [f64; 2] {
    [z.arg() / step, -z.norm().ln() / step]
}

/// The z of an undamped vibration of phase ωΔt.
fn predicted(integrator: &str, phase: f64) -> Complex<f64> {
    if integrator == "euler" {
        return Complex::new(1.0, -phase).inv();
    }
    // q⁺ − 2q + q⁻ = −(ωΔt)² (½ q⁺ + e q + (½ − 2e) q⁻ + e q⁻⁻), e = λ/2.
    let (e, squared) = (0.05, phase * phase);
    let cubic =
        [1.0 + 0.5 * squared, e * squared - 2.0, 1.0 + (0.5 - 2.0 * e) * squared, e * squared];
    let mut z = Complex::from_polar(1.0, phase);
    for _ in 0..20 {
        let value = cubic.iter().fold(Complex::<f64>::ZERO, |sum, c| sum * z + c);
        let slope = (z * (3.0 * cubic[0]) + 2.0 * cubic[1]) * z + cubic[2];
        z -= value / slope;
    }
    z
}

/// The z of a mode: a' = 2 Re(z) a − |z|² a⁻ holds for its share a of the motion, by least squares.
fn found(world: &mut World, beta: f64) -> Complex<f64> {
    world.steps(20);
    let shares: Vec<f64> = (0..200)
        .map(|_| {
            world.steps(1);
            amplitude(world, beta)
        })
        .collect();
    let (mut normal, mut rhs) = (Matrix2::zeros(), Vector2::zeros());
    for three in shares.windows(3) {
        let row = Vector2::new(three[1], -three[0]);
        normal += row * row.transpose();
        rhs += row * three[2];
    }
    let solved = normal.lu().solve(&rhs).expect("a vibration");
    let real = 0.5 * solved[0];
    Complex::new(real, (solved[1] - real * real).sqrt())
}

/// The implicit schemes' first mode. Both make of e^{iωt} powers of a complex number, so frequency and decay are
/// predicted exactly.
#[test]
fn validates_implicit_frequency() {
    let beta = 1.87510407;
    let mut case = Case::new("implicit_frequency", "What the implicit schemes do to a vibration")
        .equation(
            "Euler: z = 1/(1 − iωΔt); Newmark with a dissipation λ = 0.1: the root of z³ − 2z² + z = −(ωΔt)² (½ z³ + ½ λ z² + (½ − λ) z \
            + ½ λ) near e^{iωΔt}; ω_Δt = arg z/Δt, decay −ln |z|/Δt",
        )
        .source(
            "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II; N. M. Newmark, J. Eng. Mech. Div. 85 \
            (1959) 67, β = ½; older values after H. M. Hilber, T. J. R. Hughes, R. L. Taylor, Earthq. Eng. Struct. Dyn. 5 \
            (1977) 283",
        )
        .scene(ROD, &[("body.clamp", "'head'"), ("body.elements", "40"), ("solver.integrator", "…"), ("solver.step_s", "…")])
        .note(
            "First mode, 4 rad/s; z is fitted to 200 steps. Newmark's scheme damps so little that it is looked at with far longer \
            steps.",
        );
    for (integrator, step) in
        [("newmark", 0.05), ("newmark", 0.02), ("euler", 2e-3), ("euler", 5e-4)]
    {
        let (scheme, text) = (format!("'{integrator}'"), number(step));
        let edits = [
            ("solver.integrator", scheme.as_str()),
            ("solver.step_s", &text),
            ("control.step_s", &text),
        ];
        let [omega, decay] = rates(found(&mut in_mode(beta, &edits), beta), step);
        let [turned, lost] = rates(predicted(integrator, exact_rad_s(beta) * step), step);
        // The mesh gives 2e-4 in ω.
        let what = format!("{integrator}, Δt = {step} s");
        case.relative(format!("ω, {what}"), "rad/s", [omega, turned], 1e-3);
        case.relative(format!("decay, {what}"), "1/s", [decay, lost], 1e-2);
    }
    case.finish();
}

/// Kelvin–Voigt damping: a mode decays with τω²/2 and no more (ω = 4.06 rad/s, τ = 1 ms: 0.8 % a second).
#[test]
fn validates_kelvin_voigt_decay() {
    let beta = 1.87510407;
    let edits = [
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "1e-5"),
        ("control.step_s", "1e-5"),
        ("material.damping_time_s", "0.001"),
    ];
    let mut world = in_mode(beta, &edits);
    let (omega, decay) = vibration(&mut world, beta, 2);
    // Over 1.5 periods the logarithm is 0.02; a peak sampled every 10 µs is good to (ωΔt)²/8 = 2e-10.
    let mut case = Case::new("kelvin_voigt_decay", "Decay by Kelvin–Voigt damping")
        .equation("σ = E (ε + τ ε̇): a mode decays as e^{−τω²t/2}")
        .source("S. P. Timoshenko, Vibration Problems in Engineering (viscous damping, ζ = τω/2)")
        .scene(ROD, &[&[("body.clamp", "'head'"), ("body.elements", "40")], &edits[..]].concat())
        .note("First mode, amplitude 1e-4 L, the logarithm of the peaks over two periods.");
    case.relative("decay", "1/s", [decay, 0.001 * omega * omega / 2.0], 1e-3);
    case.finish();
}

/// The undamped heavy cantilever let go from the horizontal: an extensible Kirchhoff rod has its tip at
/// (52.708, −11.759) mm after 1 s. Two methods differ by less than 1e-2 L only where their models agree, so
/// 1e-2 L = 0.54 mm is the bound.
#[test]
fn validates_dynamic_cantilever() {
    let edits = [
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "1e-5"),
        ("material.damping_time_s", "0.0"),
        ("body.elements", "54"),
    ];
    let mut case = Case::new("dynamic_cantilever", "Heavy cantilever let go from the horizontal")
        .equation("ρA ẍ = ∂n/∂s + ρA g, ρI θ̈ = EI θ″ + (x′ × n)·ẑ: an extensible Kirchhoff rod")
        .source(
            "Tip of an independent discretisation of the Kirchhoff rod at t = 1 s: (52.708, \
            −11.759) mm",
        )
        .scene("cantilever", &edits)
        .note(
            "ρAgL³/EI = 12.4, undamped. The motion is nonlinear and long, about four swings: \
            the bound is 1e-2 L = 0.54 mm, what two methods can be asked to agree on.",
        );
    for (curvature, law) in CURVATURES {
        let law_of_bending = ("solver.curvature", curvature);
        let mut world = World::new("cantilever", &[&edits[..], &[law_of_bending]].concat());
        world.run(1.0);
        let tip = world.node(world.last()).map(|x| x * 1e3);
        case.place(format!("tip after 1 s, {law}"), "mm", [tip, [52.708, -11.759]], 0.54);
    }
    case.finish();
}
