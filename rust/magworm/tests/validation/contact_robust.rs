//! Contact over the whole range of scenes.

use crate::world::{World, number};
use magworm::Status;
use magworm::internals::advance;
use magworm::internals::lanes::Scalar;

/// What happened over a run.
struct Run {
    status: Status,
    steps: u32,
    /// Steps that used up the contact iterations.
    exhausted: u32,
    /// Steps that ended with a force beyond μ_s N + D_f.
    beyond: u32,
    /// Greatest energy that friction gave in a step [J].
    driven_j: f64,
    fastest: f64,
}

/// Impulse that does not matter [N·s]: a millionth of the robot's weight over the step.
fn nothing(world: &World) -> f64 {
    1e-6 * world.mass_and_centre().0 * 9.81 * world.model.step_s
}

/// Energy that does not matter [J]: the robot lifted by a millionth of a millimetre.
fn nothing_j(world: &World) -> f64 {
    world.mass_and_centre().0 * 9.81 * 1e-9
}

/// Friction of a contact point in the last step [N·s], and the impulse that the spring of its pad held before and
/// after. The damper holds τ/Δt − 1 of what the spring lost.
fn friction(world: &World, contact: usize) -> [f64; 3] {
    let pad = world.model.program.ground.expect("ground");
    let block = &world.block;
    let before = block.contact.warm[2 * contact + 1][0];
    let after = block.pad[contact][0];
    let lead_s = pad.damping_time_s.max(world.model.step_s);
    [after - (lead_s / world.model.step_s - 1.0) * (before - after), before, after]
}

/// Whether some contact holds more than Coulomb allows, |λ_t| ≤ μ_s λ_n + D_f Δt.
fn beyond_coulomb(world: &World) -> bool {
    let law = world.model.scene.ground.as_ref().expect("ground");
    let (block, dt) = (&world.block, world.model.step_s);
    (0..world.model.contacts.len()).any(|c| {
        let limit = law.static_friction * block.normal[c][0] + law.adhesion_n * dt;
        friction(world, c)[0].abs() > 1.0001 * limit + nothing(world)
    })
}

/// Energy that friction gave in the last step beyond what the springs of the pads had stored [J]:
/// Σ λ_t u_t + Δ Σ f²/(2 k Δt²).
fn energy_given_j(world: &World) -> f64 {
    let pad = world.model.program.ground.expect("ground");
    let compliance = 1.0 / (pad.stiffness_n_m * world.model.step_s.powi(2));
    (0..world.model.contacts.len())
        .map(|c| {
            let [impulse, before, after] = friction(world, c);
            let work_j = impulse * world.block.contact.velocity[2 * c + 1][0];
            work_j + 0.5 * compliance * (after * after - before * before)
        })
        .sum()
}

fn watch(world: &mut World, steps: u32) -> Run {
    let most = world.model.scene.solver.contact_iterations as u64;
    let mut run = Run {
        status: Status::Running,
        steps,
        exhausted: 0,
        beyond: 0,
        driven_j: 0.0,
        fastest: 0.0,
    };
    for _ in 0..steps {
        let before = world.block.counters.trials;
        advance(Scalar, &world.model, &mut world.block, 1);
        run.status = world.block.status[0];
        if run.status != Status::Running {
            break;
        }
        run.exhausted += u32::from(world.block.counters.trials - before >= most);
        run.beyond += u32::from(beyond_coulomb(world));
        run.driven_j = run.driven_j.max(energy_given_j(world));
        run.fastest = run.fastest.max(world.fastest(0)).max(world.fastest(1));
    }
    run
}

/// Step, modulus, static and dynamic friction, retardation time.
type Case = [f64; 5];

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for step in [1e-5, 1e-4, 2e-3, 2e-2, 5e-2] {
        for modulus in [1e3, 1e5, 1e7, 1e10] {
            for [fixed, moving] in [[0.0, 0.0], [0.8, 0.6], [0.8, 0.1], [3.0, 3.0], [10.0, 1.0]] {
                cases.extend(
                    [0.0, 5e-3, 1.0].map(|damping| [step, modulus, fixed, moving, damping]),
                );
            }
        }
    }
    cases
}

/// `paper-3` over a drive that passes beneath it 8 mm lower than it should.
fn pass(case: Case) -> World {
    let texts = case.map(number);
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
    World::new("paper-3", &edits)
}

/// A pass of the drive under the robot over friction 0 to 10, 1 kPa to 10 GPa, retardation 0 to 1 s and steps of
/// 10 µs to 50 ms. Nothing becomes infinite; a robot of 50 kPa or more does not break, nor does any part of it
/// move faster than 3 m/s, what a fall from half a metre gives; friction never drives; it stays within Coulomb's cone
/// but for one step and 3 % of them (the trials are bounded, so some steps may end on the way). That holds where
/// friction jams rigid feet, too: pushing a toe back presses it down harder than the push (Painlevé).
#[test]
fn validates_robust_contact() {
    let (mut failures, mut sums, mut driven) = (0, [0; 3], 0.0f64);
    for case in cases() {
        let [step, modulus, fixed, moving, damping] = case;
        let mut world = pass(case);
        let run = watch(&mut world, 400.min((1.0 / step) as u32));
        let counts = [run.steps, run.exhausted, run.beyond];
        (0..3).for_each(|k| sums[k] += counts[k]);
        driven = driven.max(run.driven_j / nothing_j(&world));
        let broken =
            run.status == Status::NotFinite || modulus > 5e4 && run.status != Status::Running;
        let drives = run.driven_j > nothing_j(&world);
        if broken || drives || run.fastest > 3.0 || run.beyond > 1 + 3 * run.steps / 100 {
            println!(
                "Δt {step} E {modulus:.0e} μ {fixed}/{moving} τ {damping}: {:?}, {:.2} m/s, {} beyond of {} steps, driven by {:.1e} J",
                run.status, run.fastest, run.beyond, run.steps, run.driven_j
            );
            failures += 1;
        }
    }
    let [steps, exhausted, beyond] = sums;
    println!(
        "robust contact: {steps} steps, {exhausted} used up the iterations, {beyond} ended beyond the cone, driven by {driven:.1e} of what is allowed"
    );
    assert!(failures == 0, "{failures} of {} scenes", cases().len());
}

/// The preset's own pass: trials used up and points beyond Coulomb's cone, each in 2 % of the steps at most; friction
/// never drives. The preset's friction of 1.13 is near the jam of rigid feet.
#[test]
fn validates_contact_of_a_pass() {
    for step in [4e-3, 2e-3, 1e-3, 1e-4] {
        let text = number(step);
        let edits = [
            ("solver.step_s", text.as_str()),
            ("drive.motion", "{kind='constant',x_m=-0.05,y_m=-0.022,speed_m_s=0.1}"),
        ];
        let mut world = World::new("paper-3", &edits);
        let run = watch(&mut world, (1.5 / step) as u32);
        println!(
            "contact of a pass, Δt {step}: {} steps, {} used up the iterations, {} beyond the cone, driven by {:.1e} J",
            run.steps, run.exhausted, run.beyond, run.driven_j
        );
        assert!(run.beyond.max(run.exhausted) * 100 <= 2 * run.steps);
        assert!(run.driven_j <= nothing_j(&world));
    }
}
