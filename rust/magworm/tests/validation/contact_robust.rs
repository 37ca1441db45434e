//! Contact over the whole range of scenes.

use crate::world::{World, number};
use magworm::lanes::Scalar;
use magworm::state::Status;
use magworm::step::advance;

/// What happened over a run: final status, steps that used up the contact iterations, fastest node.
pub struct Run {
    pub status: Status,
    pub exhausted: u32,
    pub steps: u32,
    pub fastest: f64,
}

/// Runs without giving up on a broken environment.
pub fn watch(world: &mut World, steps: u32) -> Run {
    let most = world.model.scene.solver.contact_iterations as u64;
    let mut run = Run { status: Status::Running, exhausted: 0, steps, fastest: 0.0 };
    for _ in 0..steps {
        let before = world.block.counters.solves;
        advance(Scalar, &world.model, &mut world.block, 1);
        run.exhausted += u32::from(world.block.counters.solves - before >= most);
        run.fastest = run.fastest.max(world.fastest(0)).max(world.fastest(1));
        run.status = world.block.status[0];
        if run.status != Status::Running {
            break;
        }
    }
    run
}

/// A pass of the drive under the robot over friction 0 to 10, 1 kPa to 10 GPa, retardation 0 to 1 s and steps of
/// 10 µs to 50 ms: nothing breaks or runs away. No part of a robot in a 0.1 m/s pass has cause to move faster
/// than 3 m/s, what a fall from half a metre gives.
#[test]
fn validates_robust_contact() {
    let mut failures = Vec::new();
    let (mut exhausted, mut total) = (0, 0);
    for step in [1e-5, 1e-4, 2e-3, 2e-2, 5e-2] {
        for modulus in [1e3, 1e5, 1e7, 1e10] {
            for (friction, dynamic) in [(0.0, 0.0), (0.8, 0.6), (0.8, 0.1), (3.0, 3.0), (10.0, 1.0)]
            {
                for damping in [0.0, 5e-3, 1.0] {
                    let texts = [step, modulus, friction, dynamic, damping].map(number);
                    let edits = [
                        ("solver.step_s", texts[0].as_str()),
                        ("control.step_s", texts[0].as_str()),
                        ("control.episode_s", texts[0].as_str()),
                        ("material.youngs_modulus_pa", texts[1].as_str()),
                        ("ground.static_friction", texts[2].as_str()),
                        ("ground.dynamic_friction", texts[3].as_str()),
                        ("material.damping_time_s", texts[4].as_str()),
                        ("drive.motion", "{kind='constant',x_m=0.0,y_m=-0.03,speed_m_s=0.1}"),
                    ];
                    let mut world = World::new("paper-3", &edits);
                    let run = watch(&mut world, 400.min((1.0 / step) as u32));
                    exhausted += run.exhausted;
                    total += run.steps;
                    let stuck = run.exhausted * 100 > run.steps;
                    if run.status != Status::Running || run.fastest > 3.0 || stuck {
                        println!(
                            "step {step} E {modulus:.0e} μ {friction}/{dynamic} τ {damping}: {:?}, fastest {:.2} m/s, {} of {} exhausted",
                            run.status, run.fastest, run.exhausted, run.steps
                        );
                        failures.push((step, modulus, friction, damping));
                    }
                }
            }
        }
    }
    println!(
        "robust contact: {} failures, {exhausted} of {total} steps used up the iterations",
        failures.len()
    );
    assert!(failures.is_empty());
}
