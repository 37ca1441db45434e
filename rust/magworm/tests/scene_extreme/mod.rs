//! Random extreme scenes: robots and rods where a drive magnet reaches them, over the ranges of `docs/stability.md`.

use magworm::scene::*;
use proptest::prelude::*;

use crate::scene_strategy::dice::{Dice, dice};
use crate::scene_strategy::drive::suspension;
use crate::scene_strategy::{bends, relaxation, with_interval, within_the_limit};

/// Rubber of the presets: volumes and densities below are shares of it [kg/m³].
const RUBBER_KG_M3: f64 = 1070.0;

/// Extreme scenes of 2 or 3 dimensions whose bodies have about `most_nodes` nodes (20 or more).
pub fn scene(most_nodes: usize, dimensions: usize) -> impl Strategy<Value = Scene> {
    let shape = dice(bends::NUMBERS);
    (dice(16), dice(30), dice(32), dice(40), shape).prop_map(
        move |(mut body, mut world, mut rest, mut parts, mut shape)| {
            let (body, magnet) = robot_or_rod(&mut body, most_nodes);
            let solver = solver(&mut rest);
            let steps = rest.whole(1, 40) as f64;
            let ground = (rest.between(0.0, 1.0) < 0.8).then(|| ground(&mut world));
            let mut contact = contact(&mut world, &body, ground.is_some(), solver.integrator);
            if dimensions == 2 && world.between(0.0, 1.0) < 0.25 {
                contact = Contact {
                    points: ContactPoints::Nodes,
                    edge_radius_m: 0.0,
                    between_feet: false,
                    ..contact
                };
            }
            let motion = drive_motion(&mut world, dimensions);
            let mut scene = Scene {
                name: "extreme".into(),
                gravity_m_s2: rest.between(0.0, 981.0),
                dimensions,
                body,
                material: Material {
                    youngs_modulus_pa: rest.decades(1e3, 1e10),
                    density_kg_m3: RUBBER_KG_M3 * rest.decades(1e-3, 10.0),
                    damping_time_s: if rest.coin() { 0.0 } else { rest.decades(1e-5, 1.0) },
                    poisson_ratio: 0.5,
                    relaxation: relaxation(&mut rest),
                },
                magnet: Some(magnet),
                drive: (rest.between(0.0, 1.0) < 0.8).then(|| drive(&mut world, motion)),
                field: None,
                magnetic_terms: MagneticTerms { mutual: rest.coin(), ..MagneticTerms::default() },
                start: Start {
                    x_m: 0.0,
                    height_m: if rest.coin() { 0.0 } else { rest.decades(1e-4, 1.0) },
                    angle_deg: rest.one_of(&[0.0, 0.0, 30.0, 90.0, 135.0, 180.0, -60.0]),
                    z_m: 0.0,
                    yaw_deg: rest.in_space(dimensions, -180.0, 180.0),
                    ..Start::default()
                },
                ground,
                contact,
                control: Control {
                    step_s: steps * solver.step_s,
                    episode_s: steps * solver.step_s,
                },
                solver,
                reset: Reset::default(),
            };
            scene.solver = with_interval(scene.solver, &scene.control, rest.whole(1, 12));
            within_the_limit(bends::bend(in_unequal_segments(scene, &mut parts), &mut shape))
        },
    )
}

/// The paper's robot, or a rod with two magnets, as thin or thick as a scene allows.
fn robot_or_rod(dice: &mut Dice, most_nodes: usize) -> (Body, Magnet) {
    let (thickness_m, width_m) = (dice.decades(1e-4, 0.03), 0.01131);
    let magnet = Magnet {
        length_m: 0.006303,
        width_m: 0.007455,
        height_m: (0.25 * thickness_m).max(1e-4),
        remanence_t: dice.between(0.0, 10.0),
        density_kg_m3: dice.decades(1.0, 1e5),
    };
    if dice.coin() {
        let magnets = dice.whole(1, 5);
        let spare = most_nodes.saturating_sub(3 * magnets + 1);
        return (worm(dice, magnets, thickness_m, width_m, spare), magnet);
    }
    let magnets = [(0.026, 1), (0.046, -1)]
        .map(|(position_m, polarity)| RodMagnet { position_m, polarity })
        .to_vec();
    let elements = dice.whole(4, most_nodes - 8);
    let clamp = dice.one_of(&[Clamp::None, Clamp::None, Clamp::Head]);
    (Body::Rod(Rod { length_m: 0.054, width_m, thickness_m, elements, clamp, magnets }), magnet)
}

/// Every other scene of an implicit scheme: its body in segments, as thick as they come out, with magnets of any height,
/// direction and place in their section.
fn in_unequal_segments(scene: Scene, dice: &mut Dice) -> Scene {
    if scene.solver.integrator == Integrator::Explicit || dice.coin() {
        return scene;
    }
    let mut scene = scene.in_segments();
    let Body::Segments(body) = &mut scene.body else { return scene };
    for segment in &mut body.segment {
        segment.thickness_m = dice.decades(segment.thickness_m, 0.03);
        if let Some(magnet) = &mut segment.magnet {
            magnet.height_m = dice.decades(1e-4, segment.thickness_m);
            magnet.angle_deg = dice.between(-180.0, 180.0);
            magnet.up_m = 0.5 * dice.between(-1.0, 1.0) * (segment.thickness_m - magnet.height_m);
            let room_m = segment.width_m - magnet.width_m;
            magnet.aside_m = 0.5 * dice.in_space(scene.dimensions, -1.0, 1.0) * room_m;
        }
    }
    scene
}

fn worm(dice: &mut Dice, magnets: usize, thickness_m: f64, width_m: f64, spare: usize) -> Body {
    let bridges = dice.whole(1, (spare / magnets).max(1));
    Body::Worm(Worm {
        magnets,
        pitch_m: 0.02,
        foot_length_m: 0.014,
        foot_thickness_m: thickness_m,
        bridge_thickness_m: dice.decades(1e-4, thickness_m),
        width_m,
        first_polarity: dice.polarity(),
        removed: vec![],
        elements_per_bridge: bridges,
        elements_per_foot_end: 1,
    })
}

/// Feet with sharp edges or rounded ones, half of them such as do not pass through each other; half of those on ground rebound.
fn contact(dice: &mut Dice, body: &Body, on_ground: bool, integrator: Integrator) -> Contact {
    let Body::Worm(worm) = body else { return Contact::default() };
    let most_m = 0.5 * worm.foot_length_m.min(worm.foot_thickness_m).min(worm.width_m);
    let many = on_ground && worm.magnets > 1 && integrator != Integrator::Explicit;
    Contact {
        points: ContactPoints::Feet,
        edge_radius_m: dice.one_of(&[0.0, 0.5 * most_m, most_m]),
        between_feet: many && dice.coin(),
        restitution: if on_ground && dice.coin() { dice.one_of(&[0.5, 1.0]) } else { 0.0 },
        restitution_from_m_s: dice.one_of(&[0.0, 0.05]),
    }
}

/// Friction up to 10 on inclines up to the vertical.
fn ground(dice: &mut Dice) -> Ground {
    let static_friction = dice.between(0.0, 10.0);
    Ground {
        static_friction,
        dynamic_friction: dice.between(0.0, static_friction),
        transition_speed_m_s: dice.decades(1e-6, 0.1),
        adhesion_n: dice.one_of(&[0.0, 5e-3, 1.0]),
        incline_deg: dice.one_of(&[0.0, 0.0, 45.0, 90.0, -90.0]),
    }
}

/// A magnet that goes by, from 60 mm beneath the ground to touching the body and right through it.
fn drive_motion(dice: &mut Dice, dimensions: usize) -> Motion {
    Motion::Constant {
        x_m: dice.between(-0.03, 0.08),
        y_m: dice.between(-0.06, 0.02),
        speed_m_s: dice.between(-10.0, 10.0),
        z_m: dice.in_space(dimensions, -0.02, 0.02),
        yaw_deg: dice.in_space(dimensions, -180.0, 180.0),
    }
}

fn drive(dice: &mut Dice, motion: Motion) -> Drive {
    Drive {
        length_m: 0.0149,
        width_m: 0.02618,
        height_m: 0.004033,
        remanence_t: dice.between(0.0, 10.0),
        reference: Reference::Centre,
        arrangement: Arrangement::Single,
        suspension: suspension(dice),
        motion,
    }
}

fn solver(dice: &mut Dice) -> Solver {
    let integrator = dice.one_of(&[Integrator::Newmark, Integrator::Euler, Integrator::Explicit]);
    let step_s = dice.decades(1e-5, 0.05);
    Solver {
        integrator,
        step_s,
        magnet_model: dice.one_of(&[MagnetModel::Cuboid, MagnetModel::Cuboid, MagnetModel::Dipole]),
        quadrature_order: dice.whole(1, 3),
        wrench_interval: 1,
        contact_iterations: 120,
        fastest_m_s: 100.0,
        curvature: dice.one_of(&[Curvature::Angle, Curvature::Tangent]),
        precision: if integrator == Integrator::Explicit || step_s < 5e-4 {
            Precision::Double
        } else {
            dice.one_of(&[Precision::Double, Precision::Single])
        },
    }
}
