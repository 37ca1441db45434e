//! Landing, and starting where no body can be.

use crate::derivatives::energy_of_world;
use crate::report::Case;
use crate::world::World;
use magworm::StartPose;

const ON_FLAT: [(&str, &str); 2] =
    [("ground.incline_deg", "0.0"), ("material.damping_time_s", "5e-3")];

fn total_energy(world: &World) -> f64 {
    let (mass, [_, y]) = world.mass_and_centre();
    world.kinetic() + energy_of_world(world) + 9.81 * mass * y
}

/// Fastest upward velocity of any node [m/s].
fn upward(world: &World) -> f64 {
    (0..=world.last()).map(|n| world.node_velocity(n)[1]).fold(0.0, f64::max)
}

/// A block dropped flat from 10 mm lands without rebound: no node moves up by more than a fiftieth of the landing speed,
/// what contact springs give back, and the kinetic energy is gone (1e-12 of what it had).
#[test]
fn validates_inelastic_landing() {
    let mut case = Case::new("inelastic_landing", "Landing without rebound")
        .equation("v_n⁺ = 0 on impact; the energy m g h is gone")
        .source("Moreau's inelastic impact law (restitution 0), which the paper's robot has")
        .scene("incline-block", &[&ON_FLAT[..], &[("start.height_m", "0.01")]].concat())
        .note(
            "Blocks as above, dropped flat from 10 mm, for 0.5 s. Rebound is the fastest upward \
            velocity of any node: the contact springs under the points give by micrometres and return at most \
            a fiftieth of the 0.44 m/s.",
        );
    let (mut rebounds, mut remaining) = (Vec::new(), Vec::new());
    for (name, body) in crate::contact_block::blocks() {
        let mut edits = ON_FLAT.to_vec();
        edits.extend(body);
        edits.push(("start.height_m", "0.01"));
        let mut world = World::new("incline-block", &edits);
        let (mut fastest, mut rebound) = (0.0f64, 0.0f64);
        for _ in 0..250 {
            world.steps(1);
            fastest = fastest.max(world.kinetic());
            rebound = rebound.max(upward(&world));
        }
        let left = world.kinetic() / fastest;
        println!("flat landing, {name}: rebound {rebound:.1e} m/s, kinetic energy left {left:.1e}");
        rebounds.push(rebound);
        remaining.push(left);
    }
    case.spread("rebound, all blocks", "m/s", &rebounds, 8.8e-3);
    case.spread("kinetic energy left, all blocks", "of its greatest value", &remaining, 1e-12);
    case.finish();
}

/// Bodies dropped askew, on flat ground: contact and friction only take energy. The largest rise over the lowest value
/// before is compared with the energy of the fall; the scheme itself adds none.
#[test]
fn validates_impact_takes_energy() {
    let mut case = Case::new("impact_takes_energy", "Impact and friction only take energy")
        .equation("d(T + V)/dt ≤ 0")
        .source("Second law; inelastic impact and Coulomb friction do no positive work")
        .scene(
            "robot",
            &[
                &ON_FLAT[..],
                &[("start.height_m", "0.01"), ("start.angle_deg", "30.0"), ("drive", "")],
            ]
            .concat(),
        )
        .note(
            "Block and robot are dropped from 10 mm at 5°, 30°, 80° and −40° on ground with μ_s \
            = 0.1, 0.8, 3 and μ_d = 0.1. Counted is the largest rise over the lowest value \
            before.",
        );
    let mut rises = Vec::new();
    for base in ["incline-block", "robot"] {
        for angle in ["5.0", "30.0", "80.0", "-40.0"] {
            for friction in ["0.1", "0.8", "3.0"] {
                let mut edits = ON_FLAT.to_vec();
                edits.extend([
                    ("start.height_m", "0.01"),
                    ("start.angle_deg", angle),
                    ("drive", ""),
                ]);
                edits.extend([
                    ("ground.static_friction", friction),
                    ("ground.dynamic_friction", "0.1"),
                ]);
                let mut world = World::new(base, &edits);
                let start = total_energy(&world);
                let (mut lowest, mut rise) = (start, 0.0f64);
                for _ in 0..500 {
                    world.steps(1);
                    let energy = total_energy(&world);
                    rise = rise.max(energy - lowest);
                    lowest = lowest.min(energy);
                }
                let ratio = rise / (start - lowest);
                println!(
                    "askew landing, {base}, {angle}°, μ_s {friction}: energy rises by {ratio:.1e} of the fall"
                );
                rises.push(ratio);
            }
        }
    }
    case.spread("rise of the energy", "of the fall's energy", &rises, 0.01);
    case.finish();
}

/// A body that starts inside the ground comes out, at rest in the end, and gains no more than the energy of the
/// recovery speed, ½ m (0.1 m/s)², besides being lifted.
#[test]
fn validates_recovery_from_inside_the_ground() {
    let mut failures = Vec::new();
    for base in ["incline-block", "robot"] {
        for depth in [1e-4, 1e-3, 3e-3] {
            let mut edits = ON_FLAT.to_vec();
            edits.push(("drive", ""));
            let start =
                StartPose { x_m: 0.0, height_m: -depth, angle_rad: 0.0, ..StartPose::default() };
            let mut world = World::started(base, &edits, start);
            let (mut fastest, mut kinetic) = (0.0f64, 0.0f64);
            for _ in 0..1000 {
                world.steps(1);
                fastest = fastest.max(upward(&world));
                kinetic = kinetic.max(world.kinetic());
            }
            let mass_kg = world.mass_and_centre().0;
            let allowed = 0.5 * mass_kg * 0.01;
            let law = world.model.program.contact.expect("ground");
            let give = mass_kg * 9.81 / law.stiffness_n_m;
            // Gap at the start of the last step over τ; only deep ones are cut off at the recovery speed.
            let dissipation_time_s = law.dissipation_time_s.max(world.model.step_s);
            let gaps =
                world.block.contact.bias.iter().step_by(2).map(|row| row[0] * dissipation_time_s);
            let lowest = gaps.fold(f64::INFINITY, f64::min);
            println!(
                "inside the ground by {depth} m, {base}: fastest {fastest:.3} m/s, kinetic {:.2} of allowed, left at {lowest:.1e} m, {:.1e} m/s",
                kinetic / allowed,
                world.fastest(1)
            );
            if fastest > 0.15
                || kinetic > 1.01 * allowed
                || lowest < -give
                || world.fastest(1) > 1e-6
            {
                failures.push((base, depth));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}
