//! The explicit scheme knows its largest stable step: a hundredth below it small motions stay small, a hundredth beyond it
//! they grow, whatever limits it, in the plane and in space.
//!
//! A scene beyond the limit is refused, so the rods here are written a hundred times too soft, which the limit of the
//! scene allows, and stiffened by the environment's own factor, which no rule looks at.

mod base;

use base::base;
use magworm::internals::lanes::Scalar;
use magworm::internals::{Block, Draws, Wave, advance, reset, scene_start};
use magworm::scene::{Integrator, Parameter, Scene};
use magworm::{Model, Status};

const ROD: &str = r#"
gravity_m_s2 = 0.0
[body]
kind = "rod"
length_m = 0.1
width_m = 0.01
thickness_m = 0.004
elements = 20
clamp = "head"
[material]
youngs_modulus_pa = 100e3
density_kg_m3 = 1000
"#;
const MAGNETS: &str = "[{position_m=0.03,polarity=1},{position_m=0.08,polarity=-1}]";
const HEAVY: &str =
    "{length_m=8e-3,width_m=0.008,height_m=0.004,remanence_t=1.22,density_kg_m3=1e5}";
const SHORT: &str =
    "{length_m=1e-3,width_m=0.01,height_m=0.02,remanence_t=1.22,density_kg_m3=7500}";
const SOFTER: f64 = 1e2;
/// Speed of the disturbance [m/s]: far from bending anything visibly.
const SPEED_M_S: f64 = 1e-9;
const STEPS: u32 = 6000;

type Edits<'a> = &'a [(&'a str, &'a str)];

fn edited(name: &str, edits: Edits<'_>) -> Scene {
    let start =
        if name.contains('\n') { Scene::from_toml(name).expect("a scene") } else { base(name) };
    let value = |text: &str| (!text.is_empty()).then(|| text.parse().expect("TOML"));
    let values: Vec<_> = edits.iter().map(|(path, text)| (path.to_string(), value(text))).collect();
    start.with_values(&values).expect("a valid scene")
}

fn with_step(scene: &Scene, step_s: f64) -> Scene {
    let mut scene = scene.clone();
    scene.solver.integrator = Integrator::Explicit;
    scene.solver.step_s = step_s;
    scene.control.step_s = step_s;
    scene.control.episode_s = step_s;
    scene
}

/// By how much a small random motion grows at a step.
fn growth(scene: &Scene, step_s: f64) -> f64 {
    let mut soft = with_step(scene, step_s);
    soft.material.youngs_modulus_pa /= SOFTER;
    let model = Model::compile(&soft).expect("soft rods may take this step");
    let mut block = Block::<[f64; 1]>::new(&model);
    let mut factors = [1.0; Model::PARAMETERS.len()];
    factors[Parameter::Stiffness as usize] = SOFTER;
    let present = model.present();
    let start = scene_start(&model);
    reset(&model, &mut block, 0, start, &factors, &present, Draws::new(0, 0));
    let mut draws = Draws::new(1, 0);
    block.v.iter_mut().for_each(|row| row[0] = draws.uniform(-SPEED_M_S, SPEED_M_S));
    // The first step ties the ends of the magnets to them.
    advance(Scalar, &model, &mut block, 1);
    let fastest =
        |block: &Block<[f64; 1]>| block.v.iter().map(|row| row[0].abs()).fold(0.0, f64::max);
    let before = fastest(&block);
    advance(Scalar, &model, &mut block, STEPS);
    if block.status[0] != Status::Running {
        return f64::INFINITY;
    }
    fastest(&block) / before
}

/// Name, base, edits, what limits the step, and whether by its damping, in the plane and in space.
type Limited<'a> = (&'a str, &'a str, Edits<'a>, [(Wave, bool); 2]);

const CASES: [Limited<'static>; 9] = [
    (
        "slender",
        ROD,
        &[("body.thickness_m", "1e-3")],
        [(Wave::Stretching, false), (Wave::BendingAcross, false)],
    ),
    ("thick", ROD, &[("body.thickness_m", "0.03")], [(Wave::Bending, false); 2]),
    (
        "thin and finely meshed",
        ROD,
        &[("body.elements", "100"), ("body.thickness_m", "3e-4")],
        [(Wave::Stretching, false), (Wave::BendingAcross, false)],
    ),
    (
        "stiff",
        ROD,
        &[("material.youngs_modulus_pa", "1e9")],
        [(Wave::Stretching, false), (Wave::BendingAcross, false)],
    ),
    (
        "a little damped",
        ROD,
        &[("material.damping_time_s", "3e-4")],
        [(Wave::Stretching, true), (Wave::BendingAcross, true)],
    ),
    (
        "damped",
        ROD,
        &[("material.damping_time_s", "0.1")],
        [(Wave::Stretching, true), (Wave::BendingAcross, true)],
    ),
    (
        "heavy magnets",
        ROD,
        &[("magnet", HEAVY), ("body.magnets", MAGNETS)],
        [(Wave::Stretching, false), (Wave::BendingAcross, false)],
    ),
    (
        "tall magnets",
        ROD,
        &[("body.thickness_m", "0.02"), ("magnet", SHORT), ("body.magnets", MAGNETS)],
        [(Wave::Bending, false); 2],
    ),
    (
        "robot",
        "robot",
        &[("ground", ""), ("drive", ""), ("gravity_m_s2", "0.0")],
        [(Wave::Bending, true), (Wave::BendingAcross, true)],
    ),
];

#[test]
fn small_motions_grow_beyond_the_limit_and_only_there() {
    for (name, base, edits, limited) in CASES {
        for (dimensions, (wave, damped)) in [2, 3].into_iter().zip(limited) {
            let mut scene = edited(base, edits);
            scene.dimensions = dimensions;
            let limit = Model::compile(&scene).expect("a model").explicit_limit();
            let below = growth(&scene, 0.99 * limit.step_s);
            let beyond = growth(&scene, 1.01 * limit.step_s);
            println!("{name}, {dimensions}: {limit:?}, {} {below:e} {beyond:e}", limit.reason());
            assert_eq!((limit.wave, limit.damping > 1.0), (wave, damped), "{name}, {dimensions}");
            assert!(below < 1e2, "{name}, {dimensions}: grew by {below:e} below the limit");
            assert!(beyond > 1e4, "{name}, {dimensions}: grew by {beyond:e} beyond the limit");
        }
    }
}

#[test]
fn a_step_beyond_the_limit_is_refused_with_the_element_and_the_reason() {
    let scene = edited(ROD, &[("material.damping_time_s", "0.1"), ("body.elements", "3")]);
    let limit = Model::compile(&scene).expect("a model").explicit_limit();
    let refused =
        Model::compile(&with_step(&scene, 2.0 * limit.step_s)).expect_err("too long a step");
    let words = refused.to_string();
    assert_eq!(refused.problem.field(), Some("solver.step_s"));
    assert!(words.contains("Kelvin–Voigt damping of the axial wave in element 2"), "{words}");
    let allowed = words.split("at most ").nth(1).and_then(|rest| rest.split(" s").next());
    let allowed_s: f64 = allowed.and_then(|text| text.parse().ok()).expect("a step");
    assert!(Model::compile(&with_step(&scene, allowed_s)).is_ok(), "{words}");
    assert!(allowed_s > 0.98 * limit.step_s, "{words}");
}

/// In closed form: a uniform rod stretches at most at ω² = 4 E/(ρ l²), with l its elements.
#[test]
fn the_limit_of_a_fine_rod_is_the_time_of_sound_through_an_element() {
    for (elements, damping_s) in [(50, 0.0), (200, 0.0), (200, 1e-2)] {
        let edits = [
            ("body.elements", elements.to_string()),
            ("body.thickness_m", "1e-4".into()),
            ("material.damping_time_s", format!("{damping_s:e}")),
        ];
        let edits: Vec<_> = edits.iter().map(|(path, value)| (*path, value.as_str())).collect();
        let limit = Model::compile(&edited(ROD, &edits)).expect("a model").explicit_limit();
        let element_m = 0.1 / (f64::from(elements) - 0.5);
        let rate_s = (100e3f64 / 1000.0).sqrt() * 2.0 / element_m;
        let square = 4.0 / (rate_s * rate_s);
        let expected_s = square / (damping_s + (damping_s * damping_s + square).sqrt());
        assert!((limit.step_s / expected_s - 1.0).abs() < 1e-3, "{limit:?}, {expected_s}");
    }
}

/// What a reset draws counts: four times stiffer, or as much lighter, halves the limit.
#[test]
fn a_reset_that_may_stiffen_or_lighten_shortens_the_step() {
    let plain = Model::compile(&edited(ROD, &[])).expect("a model").explicit_limit();
    for vary in [
        "[{ parameter = 'stiffness', low = 0.5, high = 4.0 }]",
        "[{ parameter = 'mass', low = 0.25, high = 4.0 }]",
    ] {
        let scene = edited(ROD, &[("reset.vary", vary)]);
        let varied = Model::compile(&scene).expect("a model").explicit_limit();
        assert!((varied.step_s / plain.step_s - 0.5).abs() < 1e-12, "{vary}: {varied:?}");
    }
}
