//! Blocks that slide: Coulomb's law with its closed forms.

use crate::contact_block::{G, blocks, on_incline};
use crate::report::{Axes, Case, Figure};

/// Above the friction angle a block slides with exactly g (sin α − μ_d cos α): 1e-6 of it once its vibrations
/// have died out. D_f takes n D_f/m off.
#[test]
fn validates_sliding_acceleration() {
    let mut case = Case::new("sliding_acceleration", "Block that slides down an incline")
        .equation("a = g (sin α − μ_d cos α) − n D_f/m")
        .source("Coulomb")
        .scene("incline-block", &[("ground.incline_deg", "60.0"), ("ground.adhesion_n", "2e-4")])
        .note(
            "μ_d = 0.6. Mean acceleration between 0.8 and 1 s; n counts the points that touch. \
            Blocks as above, at 39° and 60° without adhesion and at 60° with it.",
        );
    let mut errors = Vec::new();
    for (name, body) in blocks() {
        for (angle, adhesion) in [(39.0, 0.0), (60.0, 0.0), (60.0, 2e-4)] {
            let mut world = on_incline(angle, adhesion, &body);
            world.run(0.8);
            let before = world.drift()[0];
            world.run(0.2);
            let measured = (world.drift()[0] - before) / 0.2;
            let alpha = f64::to_radians(angle);
            // A thick block's head end lifts off a little; D_f acts where it touches.
            let closed = world.block.contact_mode.iter().filter(|mode| mode[0] != 0.0).count();
            let held = closed as f64 * adhesion / world.mass_and_centre().0;
            let exact = G * (alpha.sin() - 0.6 * alpha.cos()) - held;
            if name == "7 mm" {
                let what = format!("acceleration at {angle}°, D_f = {adhesion} N, 7 mm");
                case.relative(what, "m/s²", [measured, exact], 1e-6);
            }
            errors.push(measured / exact - 1.0);
        }
    }
    case.spread("acceleration, all blocks", "relative", &errors, 1e-6);
    case.finish();
}

/// A block with speed v stops after v²/(2 μ_d g); a step that ends with its new velocity makes that
/// v²/(2 μ_d g) − ½ v Δt, and the last one may stop short by a μ_d g Δt².
#[test]
fn validates_stopping_distance() {
    let mut case = Case::new("stopping_distance", "Stopping distance")
        .equation("v²/(2 μ_d g) − ½ v Δt")
        .source("Coulomb; the second term is that of a step that moves with its final velocity")
        .scene("incline-block", &[("ground.incline_deg", "0.0"), ("solver.step_s", "1e-3")])
        .note("Blocks as above slide on level ground with v = 0.7 m/s, towards −x.");
    let (mut errors, mut speeds) = (Vec::new(), Vec::new());
    for (name, body) in blocks() {
        let mut edits = body.clone();
        edits.extend([("solver.step_s", "1e-3"), ("material.damping_time_s", "0.02")]);
        let mut world = on_incline(0.0, 0.0, &edits);
        world.run(0.5);
        let before = world.mass_and_centre().1[0];
        world.set_motion([-0.7, 0.0], 0.0);
        world.run(0.5);
        let went = before - world.mass_and_centre().1[0];
        let exact = 0.49 / (2.0 * 0.6 * G);
        if name == "7 mm" {
            let both = [went, exact - 0.5 * 0.7e-3].map(|m| m * 1e3);
            case.relative("way, 7 mm", "mm", both, 1e-3);
        }
        errors.push((went + 0.5 * 0.7e-3) / exact - 1.0);
        speeds.push(world.fastest(0));
    }
    // 6e-6 m of the last step over 41.6 mm, and what it shakes of a soft block when it stops.
    case.spread("way, all blocks", "relative", &errors, 1e-3);
    case.spread("speed afterwards, all blocks", "m/s", &speeds, 1e-9);
    case.finish();
}

/// A rod that a force pushes along its axis has after T the energy (T²/2m) (|F| − μ_k m g)² if |F| > μ_s m g, and none
/// otherwise. Here the force is gravity along an incline: F = m g sin α, the normal force m g cos α.
#[test]
fn validates_axial_friction() {
    let edits = [
        ("ground.transition_speed_m_s", "1e-6"),
        ("solver.step_s", "1e-4"),
        ("control.step_s", "1e-4"),
    ];
    let mut case = Case::new("axial_friction", "Axial friction of a straight rod")
        .equation(
            "E(T) = T²/(2m) (|F| − μ_d N)² for |F| > μ_s N, else 0; F = m g sin α, N = m g \
            cos α",
        )
        .source(
            "M. Gazzola, L. H. Dudte, A. G. McCormick, L. Mahadevan, R. Soc. Open Sci. 5 \
            (2018) 171628, validation of axial friction; PyElastica's AxialFrictionCases, where \
            the force is applied on level ground",
        )
        .scene("incline-block", &edits)
        .note(
            "T = 1 s, from rest. Static friction holds until a point moves faster than its contact spring gives, \
            2 mm/s; near the angle a block needs milliseconds to it.",
        );
    let mut figure =
        Figure::new("Axial friction, T = 1 s", "|F| / N = tan α", "E(T) / m [J/kg]", Axes::Linear);
    let (mut found, mut errors, mut held) = (Vec::new(), Vec::new(), Vec::new());
    let energy = |alpha: f64| {
        let push = G * (alpha.sin() - 0.6 * alpha.cos());
        if alpha.tan() > 0.8 { 0.5 * push * push } else { 0.0 }
    };
    for degrees in [0.0, 10.0, 20.0, 30.0, 35.0, 38.0, 40.0, 42.0, 45.0, 50.0, 55.0, 60.0f64] {
        let mut world = on_incline(degrees, 0.0, &edits);
        world.run(1.0);
        let ratio = world.kinetic() / world.mass_and_centre().0;
        let alpha = degrees.to_radians();
        found.push([alpha.tan(), ratio]);
        if alpha.tan() > 0.8 {
            errors.push(ratio / energy(alpha) - 1.0);
        } else {
            held.push(ratio);
        }
    }
    case.spread("energy of those that slide", "relative", &errors, 2e-2);
    case.spread("energy of those that stick", "J/kg", &held, 1e-18);
    figure.exact(
        "closed form",
        (0..=200).map(|k| {
            let slope = 1.75 * f64::from(k) / 200.0;
            [slope, energy(slope.atan())]
        }),
    );
    figure.points("simulator", found);
    case.figure(figure);
    case.finish();
}
