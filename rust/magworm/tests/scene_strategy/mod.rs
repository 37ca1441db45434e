//! Random valid scenes: the whole space that validation admits, its corners included.

pub mod bends;
mod body;
pub mod dice;
pub mod drive;
mod segments;

use magworm::Model;
use magworm::scene::*;
use proptest::prelude::*;

use dice::{Dice, dice};

/// Valid scenes of 2 or 3 dimensions whose bodies have at most `most_nodes` nodes (6 or more, at
/// most 1000).
pub fn scene(most_nodes: usize, dimensions: usize) -> impl Strategy<Value = Scene> {
    let body = dice(segments::NUMBERS)
        .prop_map(move |mut dice| body::body(&mut dice, most_nodes, dimensions));
    let drive =
        prop::option::of(dice(96).prop_map(move |mut dice| drive::drive(&mut dice, dimensions)));
    let ground = prop::option::of(dice(5).prop_map(|mut dice| ground(&mut dice)));
    let field =
        prop::option::of(dice(3).prop_map(move |mut dice| uniform_field(&mut dice, dimensions)));
    let time = dice(9).prop_map(|mut dice| (solver(&mut dice), dice));
    let shape = dice(bends::NUMBERS);
    (body, drive, ground, field, time, dice(26), dice(22), ".{0,12}", shape)
        .prop_map(
            move |(
                (body, magnet),
                drive,
                ground,
                field,
                (solver, mut time),
                mut rest,
                mut reset,
                name,
                mut shape,
            )| {
                let control = control(&mut time, &solver);
                let gravity_m_s2 = rest.between(0.0, 981.0);
                let (material, terms) = (material(&mut rest), magnetic_terms(&mut rest));
                let contact = contact(&mut rest, &body, ground.is_some(), dimensions);
                let scene = Scene {
                    name,
                    gravity_m_s2,
                    dimensions,
                    body,
                    material,
                    magnet,
                    magnetic_terms: terms.clone(),
                    start: start(&mut reset, ground.is_some(), dimensions),
                    ground,
                    contact,
                    drive,
                    field,
                    solver: with_interval(solver, &control, time.whole(1, 12)),
                    control,
                    reset: random_reset(&mut reset, &terms),
                };
                // Bodies off their centre have no explicit scheme.
                let scene = if scene.validate().is_err() { implicit(scene) } else { scene };
                bends::bend(scene, &mut shape)
            },
        )
        .prop_map(within_the_limit)
}

/// A scene whose step its integrator can take: an explicit one takes its longest, if need be without damping and with soft
/// rubber; where that is shorter than a scene allows, Newmark's scheme stands in.
pub fn within_the_limit(scene: Scene) -> Scene {
    if scene.solver.integrator != Integrator::Explicit {
        return scene;
    }
    let (mut undamped, newmark) = (scene.clone(), implicit(scene.clone()));
    undamped.material.damping_time_s = 0.0;
    let mut soft = undamped.clone();
    soft.material.youngs_modulus_pa = 1e2;
    let limit_s = |scene: &Scene| {
        let model = Model::compile(&implicit(scene.clone())).expect("a valid scene");
        model.explicit_limit().step_s
    };
    let mut admitted = [scene, undamped, soft].into_iter().map(|scene| (limit_s(&scene), scene));
    match admitted.find(|(limit_s, _)| *limit_s >= 1e-7) {
        Some((limit_s, scene)) => {
            let step_s = scene.solver.step_s.min(limit_s);
            with_step(scene, step_s)
        }
        None => newmark,
    }
}

fn implicit(mut scene: Scene) -> Scene {
    scene.solver.integrator = Integrator::Newmark;
    let step_s = scene.solver.step_s.max(1e-5);
    with_step(scene, step_s)
}

/// Another step, with as many steps in a control step, and those in an episode, as the ranges of a scene allow.
fn with_step(mut scene: Scene, step_s: f64) -> Scene {
    let steps = (scene.control.step_s / scene.solver.step_s).round().min((10.0 / step_s).floor());
    let control_s = steps * step_s;
    let episodes =
        (scene.control.episode_s / scene.control.step_s).round().min((1e5 / control_s).floor());
    scene.solver.step_s = step_s;
    scene.control = Control { step_s: control_s, episode_s: episodes * control_s };
    let interval = scene.solver.wrench_interval;
    Scene { solver: with_interval(scene.solver, &scene.control, interval), ..scene }
}

fn material(dice: &mut Dice) -> Material {
    Material {
        youngs_modulus_pa: dice.decades(1e2, 1e11),
        density_kg_m3: dice.decades(1.0, 1e5),
        damping_time_s: if dice.coin() { 0.0 } else { dice.decades(1e-6, 1.0) },
        poisson_ratio: dice.between(0.0, 0.5),
        relaxation: relaxation(dice),
    }
}

/// Up to three branches that relax in any time; every other rubber has none.
pub fn relaxation(dice: &mut Dice) -> Vec<Relaxation> {
    let count = if dice.coin() { 0 } else { dice.whole(1, 3) };
    let branch =
        |_| Relaxation { ratio: dice.decades(1e-3, 100.0), time_s: dice.decades(1e-6, 1e4) };
    (0..count).map(branch).collect()
}

fn ground(dice: &mut Dice) -> Ground {
    let static_friction = dice.between(0.0, 10.0);
    Ground {
        static_friction,
        dynamic_friction: dice.between(0.0, static_friction),
        transition_speed_m_s: dice.decades(1e-9, 1.0),
        adhesion_n: dice.between(0.0, 100.0),
        incline_deg: dice.between(-90.0, 90.0),
    }
}

/// Feet with sharp edges, or rounded as far as the smallest of them allows; that pass through each other or do not; in the
/// plane also points below all nodes. Over ground they may rebound.
fn contact(dice: &mut Dice, body: &Body, on_ground: bool, dimensions: usize) -> Contact {
    let shortest_m = |length_m: f64, thickness_m: f64, width_m: f64| {
        let in_plane_m = length_m.min(thickness_m);
        if dimensions == 2 { in_plane_m } else { in_plane_m.min(width_m) }
    };
    let (feet, shortest_m) = match body {
        Body::Worm(worm) => {
            (worm.magnets, shortest_m(worm.foot_length_m, worm.foot_thickness_m, worm.width_m))
        }
        Body::Rod(_) => (0, 0.0),
        Body::Segments(body) => {
            let feet = body.segment.iter().filter(|segment| segment.foot);
            let count = feet.clone().count();
            let edges_m =
                feet.map(|foot| shortest_m(foot.length_m, foot.thickness_m, foot.width_m));
            (count, edges_m.reduce(f64::min).unwrap_or(0.0))
        }
    };
    let rounded = dice.coin();
    let edge_radius_m = 0.5 * shortest_m * dice.between(0.0, 1.0);
    let rebound = Contact {
        restitution: if on_ground && dice.coin() { dice.between(0.0, 1.0) } else { 0.0 },
        restitution_from_m_s: dice.decades(1e-6, 100.0),
        ..Contact::default()
    };
    if dimensions == 2 && dice.coin() {
        return Contact { points: ContactPoints::Nodes, ..rebound };
    }
    Contact {
        points: ContactPoints::Feet,
        edge_radius_m: if rounded { edge_radius_m } else { 0.0 },
        between_feet: on_ground && feet > 1 && dice.coin(),
        ..rebound
    }
}

fn uniform_field(dice: &mut Dice, dimensions: usize) -> UniformField {
    UniformField {
        x_t: dice.between(-10.0, 10.0),
        y_t: dice.between(-10.0, 10.0),
        z_t: dice.in_space(dimensions, -10.0, 10.0),
    }
}

fn magnetic_terms(dice: &mut Dice) -> MagneticTerms {
    MagneticTerms {
        horizontal_force: dice.coin(),
        vertical_force: dice.coin(),
        torque: dice.coin(),
        mutual: dice.coin(),
    }
}

fn start(dice: &mut Dice, on_ground: bool, dimensions: usize) -> Start {
    Start {
        x_m: dice.between(-10.0, 10.0),
        height_m: dice.between(if on_ground { 0.0 } else { -10.0 }, 10.0),
        angle_deg: dice.between(-360.0, 360.0),
        z_m: dice.in_space(dimensions, -10.0, 10.0),
        yaw_deg: dice.in_space(dimensions, -360.0, 360.0),
        ..Start::default()
    }
}

fn solver(dice: &mut Dice) -> Solver {
    let integrator = dice.one_of(&[Integrator::Newmark, Integrator::Euler, Integrator::Explicit]);
    let shortest_s = if integrator == Integrator::Explicit { 1e-7 } else { 1e-5 };
    let step_s = dice.decades(shortest_s, 0.05);
    Solver {
        integrator,
        step_s,
        magnet_model: dice.one_of(&[MagnetModel::Cuboid, MagnetModel::Dipole]),
        quadrature_order: dice.whole(1, 10),
        wrench_interval: 1,
        contact_iterations: dice.whole(1, 1000),
        fastest_m_s: dice.decades(1e-3, 1e4),
        curvature: dice.one_of(&[Curvature::Angle, Curvature::Tangent]),
        precision: if integrator == Integrator::Explicit || step_s < 5e-4 {
            Precision::Double
        } else {
            dice.one_of(&[Precision::Double, Precision::Single])
        },
    }
}

/// Wrenches that act for as many steps as an interval and those of a control step have as their greatest common divisor.
pub fn with_interval(solver: Solver, control: &Control, interval: usize) -> Solver {
    let (mut divisor, mut rest) = ((control.step_s / solver.step_s).round() as usize, interval);
    while rest > 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    Solver { wrench_interval: divisor, ..solver }
}

fn control(dice: &mut Dice, solver: &Solver) -> Control {
    let most = (10.0 / solver.step_s * 0.999).min(1e4) as usize;
    let step_s = solver.step_s * dice.whole(1, most) as f64;
    let most = (1e5 / step_s * 0.999).min(1e4) as usize;
    Control { step_s, episode_s: step_s * dice.whole(1, most) as f64 }
}

fn random_reset(dice: &mut Dice, terms: &MagneticTerms) -> Reset {
    let mut parameters = vec![
        Parameter::Stiffness,
        Parameter::Damping,
        Parameter::Mass,
        Parameter::Remanence,
        Parameter::StaticFriction,
        Parameter::DynamicFriction,
        Parameter::DriveSpeed,
        Parameter::HorizontalForce,
        Parameter::VerticalForce,
        Parameter::Torque,
        Parameter::Mutual,
    ];
    parameters.retain(|parameter| terms.has(*parameter));
    let first = dice.whole(0, parameters.len() - 1);
    parameters.rotate_left(first);
    let count = dice.whole(0, parameters.len());
    let vary = parameters.into_iter().take(count).map(|parameter| {
        let low = dice.decades(1e-3, 1e3);
        Variation { parameter, low, high: dice.decades(low, 1e3) }
    });
    Reset { vary: vary.collect(), random_drive: dice.coin() }
}
