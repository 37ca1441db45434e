//! Random scenes all the way through: compile, reset, step. Nothing panics, nothing that leaves the
//! library is infinite or not a number, what has broken stands still until its reset, and all bits are equal
//! in scalar and wide lanes.
//!
//! `PROPTEST_CASES` sets the number of scenes.

mod scene_extreme;
mod scene_strategy;

use magworm::internals::Draws;
use magworm::scene::{Body, Scene};
use magworm::{Batch, LaneChoice, Model, Status, StepOutput};
use proptest::prelude::*;
use std::sync::Arc;

const ENVIRONMENTS: usize = 3;
const CONTROL_STEPS: u64 = 3;

fn cases(usual: u32) -> ProptestConfig {
    let cases = if std::env::var_os("PROPTEST_CASES").is_some() {
        ProptestConfig::default().cases
    } else {
        usual
    };
    ProptestConfig { cases, ..ProptestConfig::default() }
}

/// Everything public about one environment.
fn numbers(batch: &Batch, environment: usize) -> Vec<f64> {
    let model = batch.model();
    let mut seen = vec![];
    batch.view(environment, |view| {
        for magnet in 0..model.magnets() {
            seen.extend(view.magnet_pose(magnet));
            seen.extend(view.magnet_velocity(magnet));
        }
        (0..model.nodes()).for_each(|node| seen.extend(view.node_m(node)));
        (0..model.contacts.len()).for_each(|contact| seen.extend(view.contact(contact)));
        let magnets = model.program.drive_magnets();
        (0..magnets).for_each(|magnet| seen.extend(view.drive_place(magnet).expect("a drive")));
        seen.extend(view.drive_velocity());
        seen.extend(view.robot_pose());
        seen.push(view.time_s());
        let mut observation = vec![0.0; magworm::observe::size(model)];
        view.observe(&mut observation);
        seen.extend(observation.into_iter().map(f64::from));
    });
    seen
}

/// What a control step wrote.
struct Written {
    observation: Vec<f32>,
    progress_m: Vec<f64>,
    status: Vec<u8>,
}

fn step(batch: &mut Batch, actions: &[f64]) -> Written {
    let width = magworm::observe::size(batch.model());
    let mut written = Written {
        observation: vec![f32::NAN; ENVIRONMENTS * width],
        progress_m: vec![f64::NAN; ENVIRONMENTS],
        status: vec![77; ENVIRONMENTS],
    };
    batch.step(
        actions,
        StepOutput {
            observation: &mut written.observation,
            progress_m: &mut written.progress_m,
            status: &mut written.status,
        },
    );
    written
}

/// Asserts that all that can be seen is finite and agrees with what was written.
fn check(batch: &Batch, written: &Written) -> Result<(), TestCaseError> {
    prop_assert!(written.observation.iter().all(|x| x.is_finite()), "{:?}", written.observation);
    prop_assert!(written.progress_m.iter().all(|x| x.is_finite()), "{:?}", written.progress_m);
    for (environment, &code) in written.status.iter().enumerate() {
        let status = batch.status(environment);
        prop_assert_eq!(Status::from_code(code), Some(status));
        prop_assert_ne!(status, Status::Unused);
        let seen = numbers(batch, environment);
        let place = seen.iter().position(|x| !x.is_finite());
        prop_assert!(place.is_none(), "{environment} {status:?}: number {place:?} of {seen:?}");
    }
    Ok(())
}

/// Three environments: the scene's own, one with extreme parameters, one with magnets removed.
fn unequal_batch(model: &Arc<Model>, extremes: &[f64], seed: u64, lanes: LaneChoice) -> Batch {
    let mut batch = Batch::new(Arc::clone(model), ENVIRONMENTS, lanes, Some(1));
    let parameters = Model::PARAMETERS.len();
    batch.factors_mut()[parameters..2 * parameters].copy_from_slice(extremes);
    let mut draws = Draws::new(seed, 1);
    for is_in in &mut batch.present_mut()[2 * model.magnets()..] {
        *is_in = draws.uniform(0.0, 1.0) < 0.5;
    }
    (0..ENVIRONMENTS).for_each(|environment| batch.reset(environment, seed, 0, None));
    batch
}

fn run(model: Model, extremes: &[f64], seed: u64) -> Result<(), TestCaseError> {
    run_for(CONTROL_STEPS, model, extremes, seed)
}

fn run_for(
    control_steps: u64,
    model: Model,
    extremes: &[f64],
    seed: u64,
) -> Result<(), TestCaseError> {
    let model = Arc::new(model);
    let wide = run_in(&model, extremes, seed, LaneChoice::Wide, control_steps)?;
    let scalar = run_in(&model, extremes, seed, LaneChoice::Scalar, control_steps)?;
    let differs = wide.iter().zip(&scalar).position(|(wide, scalar)| wide != scalar);
    prop_assert!(differs.is_none(), "number {differs:?} differs between scalar and wide lanes");
    prop_assert_eq!(wide.len(), scalar.len());
    Ok(())
}

/// The bits of all that can be seen after each control step.
fn run_in(
    model: &Arc<Model>,
    extremes: &[f64],
    seed: u64,
    lanes: LaneChoice,
    control_steps: u64,
) -> Result<Vec<u64>, TestCaseError> {
    let mut batch = unequal_batch(model, extremes, seed, lanes);
    let mut draws = Draws::new(seed, 2);
    let mut bits = vec![];
    for _ in 0..control_steps {
        let before: Vec<_> =
            (0..ENVIRONMENTS).map(|e| (batch.status(e), numbers(&batch, e))).collect();
        let actions = magworm::observe::action_size(model) * ENVIRONMENTS;
        let actions: Vec<f64> = (0..actions).map(|_| draws.uniform(-1.0, 1.0)).collect();
        let written = step(&mut batch, &actions);
        check(&batch, &written)?;
        for (environment, (status, numbers_before)) in before.into_iter().enumerate() {
            if status != Status::Running {
                prop_assert_eq!(batch.status(environment), status);
                prop_assert_eq!(written.progress_m[environment], 0.0);
                prop_assert_eq!(numbers(&batch, environment), numbers_before);
            }
            bits.extend(numbers(&batch, environment).into_iter().map(f64::to_bits));
        }
    }
    (0..ENVIRONMENTS).for_each(|environment| batch.reset(environment, seed, 1, None));
    prop_assert!((0..ENVIRONMENTS).all(|e| batch.status(e) == Status::Running));
    batch.advance(1);
    Ok(bits)
}

/// Few solver steps per control step, whatever the scene asks for: the time goes into more scenes.
fn short(scene: Scene) -> Scene {
    let solver_steps = (scene.control.step_s / scene.solver.step_s).round().min(8.0);
    in_control_steps_of(solver_steps, scene)
}

/// A scene to be run for half a second or 2,000 solver steps, whichever is less, and its control steps until then.
fn long(scene: Scene) -> (Scene, u64) {
    let solver_steps = (0.5 / scene.solver.step_s).clamp(20.0, 2000.0);
    (in_control_steps_of(20.0, scene), (solver_steps / 20.0) as u64)
}

fn in_control_steps_of(solver_steps: f64, mut scene: Scene) -> Scene {
    let control_steps = (scene.control.episode_s / scene.control.step_s).round();
    scene.control.step_s = solver_steps * scene.solver.step_s;
    scene.control.episode_s = control_steps * scene.control.step_s;
    let interval = scene.solver.wrench_interval;
    scene.solver = scene_strategy::with_interval(scene.solver, &scene.control, interval);
    scene.solver.contact_iterations = scene.solver.contact_iterations.min(100);
    scene
}

/// Scenes in the plane and in space.
fn scene(most_nodes: usize) -> impl Strategy<Value = Scene> {
    let (flat, spatial) =
        (scene_strategy::scene(most_nodes, 2), scene_strategy::scene(most_nodes, 3));
    prop_oneof![flat, spatial].prop_map(short)
}

/// Extreme scenes in the plane and in space.
fn extreme_scene(most_nodes: usize) -> impl Strategy<Value = Scene> {
    let of = |dimensions| scene_extreme::scene(most_nodes, dimensions);
    prop_oneof![of(2), of(3)]
}

fn extremes() -> impl Strategy<Value = Vec<f64>> {
    let factor = prop_oneof![
        2 => Just(0.0),
        1 => Just(1e-3),
        2 => Just(1.0),
        1 => Just(1e3),
        1 => 0.1..10.0,
    ];
    prop::collection::vec(factor, Model::PARAMETERS.len())
}

proptest! {
    #![proptest_config(cases(10_000))]

    #[test]
    fn random_valid_scenes_run(
        scene in scene(24),
        extremes in extremes(),
        seed: u64,
    ) {
        let model = Model::compile(&scene);
        prop_assert!(model.is_ok(), "{}", model.unwrap_err());
        run(model.expect("a model"), &extremes, seed)?;
    }

    #[test]
    fn scenes_spoiled_in_code_are_refused_or_run(
        mut scene in scene(16),
        number in prop_oneof![prop::num::f64::ANY, -1.0..1.0, Just(0.0)],
        place in 0..12_usize,
        seed: u64,
    ) {
        spoil(&mut scene, place, number);
        match Model::compile(&scene) {
            Err(error) => prop_assert!(!error.to_string().is_empty()),
            Ok(model) => run(model, &[1.0; Model::PARAMETERS.len()], seed)?,
        }
    }
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn large_random_scenes_run(
        scene in scene(300),
        extremes in extremes(),
        seed: u64,
    ) {
        run(Model::compile(&scene).expect("a valid scene"), &extremes, seed)?;
    }

    #[test]
    fn extreme_scenes_run(scene in extreme_scene(24), seed: u64) {
        let model = Model::compile(&scene);
        prop_assert!(model.is_ok(), "{}", model.unwrap_err());
        run(model.expect("a model"), &[1.0; Model::PARAMETERS.len()], seed)?;
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// What goes wrong slowly: growing oscillations, robots that sink or drift, rows that are restored a little wrongly.
    #[test]
    fn random_scenes_run_long(
        (scene, control_steps) in prop_oneof![scene(16), extreme_scene(20)].prop_map(long),
        seed: u64,
    ) {
        let model = Model::compile(&scene).expect("a valid scene");
        run_for(control_steps, model, &[1.0; Model::PARAMETERS.len()], seed)?;
    }
}

/// Puts a number where it may not belong.
fn spoil(scene: &mut Scene, place: usize, number: f64) {
    match place {
        0 => scene.gravity_m_s2 = number,
        1 => scene.material.youngs_modulus_pa = number,
        2 => scene.material.density_kg_m3 = number,
        3 => scene.material.damping_time_s = number,
        4 => scene.start.angle_deg = number,
        5 => scene.start.height_m = number,
        6 => scene.solver.quadrature_order = number as usize,
        7 => scene.solver.step_s = number,
        8 => scene.magnet = None,
        9 => scene.ground.iter_mut().for_each(|ground| ground.adhesion_n = number),
        10 => scene.drive.iter_mut().for_each(|drive| drive.height_m = number),
        _ => match &mut scene.body {
            Body::Worm(worm) => worm.pitch_m = number,
            Body::Rod(rod) => rod.thickness_m = number,
            Body::Segments(body) => body.segment[0].length_m = number,
        },
    }
}
