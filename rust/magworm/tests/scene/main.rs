//! Every rule of a scene, with the exact sentence that a user reads.

mod contact;
mod drive;
#[path = "../scene_example/mod.rs"]
mod scene_example;
mod start;

use scene_example::{edited, refuses};

#[test]
fn refuses_numbers_out_of_range_with_their_unit() {
    let scene = "example";
    let modulus = "material.youngs_modulus_pa";
    for (value, shown) in
        [("-3", "-3 Pa"), ("nan", "NaN Pa"), ("inf", "inf Pa"), ("1e12", "1e12 Pa"), ("0", "0 Pa")]
    {
        refuses(scene, modulus, value, &format!("{modulus} is {shown}; allowed: 100 to 1e11 Pa"));
    }
    for (path, value, rest) in [
        ("gravity_m_s2", "-9.81", "is -9.81 m/s²; allowed: 0 to 981 m/s²"),
        ("body.magnets", "0", "is 0; allowed: a whole number from 1 to 32"),
        ("body.width_m", "15", "is 15 m; allowed: 1e-4 to 0.5 m"),
        ("body.foot_thickness_m", "7", "is 7 m; allowed: 1e-4 to 0.03 m"),
        ("body.elements_per_bridge", "0", "is 0; allowed: a whole number from 1 to 999"),
        ("body.first_polarity", "0", "is 0; allowed: 1 or -1"),
        ("material.damping_time_s", "5", "is 5 s; allowed: 0 to 1 s"),
        ("dimensions", "4", "is 4; allowed: a whole number from 2 to 3"),
        ("material.poisson_ratio", "0.51", "is 0.51; allowed: 0 to 0.5"),
        ("drive.motion.lateral_reach_m", "-0.01", "is -0.01 m; allowed: 0 to 10 m"),
        ("drive.motion.yaw_reach_deg", "181", "is 181°; allowed: 0 to 180°"),
        ("drive.motion.yaw_speed_deg_s", "0", "is 0 °/s; allowed: 0.001 to 1e5 °/s"),
        ("drive.motion.yaw_acceleration_deg_s2", "0", "is 0 °/s²; allowed: 0.001 to 1e8 °/s²"),
        ("start.yaw_deg", "-361", "is -361°; allowed: -360 to 360°"),
        ("material.density_kg_m3", "0", "is 0 kg/m³; allowed: 1 to 1e5 kg/m³"),
        ("magnet.remanence_t", "-1.22", "is -1.22 T; allowed: 0 to 10 T"),
        ("ground.static_friction", "11", "is 11; allowed: 0 to 10"),
        ("ground.incline_deg", "91", "is 91°; allowed: -90 to 90°"),
        ("ground.adhesion_n", "-1", "is -1 N; allowed: 0 to 100 N"),
        ("ground.transition_speed_m_s", "0", "is 0 m/s; allowed: 1e-9 to 1 m/s"),
        ("drive.motion.speed_m_s", "210", "is 210 m/s; allowed: 1e-4 to 10 m/s"),
        ("solver.step_s", "2", "is 2 s; allowed: 1e-7 to 0.05 s"),
        ("solver.quadrature_order", "11", "is 11; allowed: a whole number from 1 to 10"),
        ("solver.wrench_interval", "0", "is 0; allowed: a whole number from 1 to 10000"),
    ] {
        refuses(scene, path, value, &format!("{path} {rest}"));
    }
}

#[test]
fn refuses_bodies_that_cannot_be_built() {
    for (path, value, rest) in [
        ("magnet.length_m", "0.015", "is 0.015 m; allowed: at most body.foot_length_m = 0.014 m"),
        (
            "magnet.height_m",
            "0.008",
            "is 0.008 m; allowed: at most body.foot_thickness_m = 0.007 m",
        ),
        ("magnet.width_m", "0.016", "is 0.016 m; allowed: at most body.width_m = 0.015 m"),
        ("body.foot_length_m", "0.02", "is 0.02 m; allowed: less than body.pitch_m = 0.02 m"),
        (
            "body.bridge_thickness_m",
            "0.008",
            "is 0.008 m; allowed: at most body.foot_thickness_m = 0.007 m",
        ),
        (
            "body.elements_per_bridge",
            "700",
            "is 700; allowed: at most 600, each 1e-5 m or longer, in a length of 0.006 m",
        ),
        (
            "body.elements_per_bridge",
            "500",
            "is 500; allowed: at most 1000 nodes in the body, here 1010",
        ),
        (
            "body.elements_per_foot_end",
            "301",
            "is 301; allowed: at most 300, each 1e-5 m or longer, in a length of 0.003 m",
        ),
    ] {
        refuses("example", path, value, &format!("{path} {rest}"));
    }
    assert!(edited("example", &[("magnet.length_m", Some("0.014"))]).is_ok());
    for (removed, place, index) in [("[0, 3]", 1, 3), ("[1, 1]", 1, 1)] {
        let sentence =
            format!("body.removed[{place}] is {index}; allowed: 0 to 2, each at most once");
        refuses("example", "body.removed", removed, &sentence);
    }
    refuses(
        "example",
        "body.removed",
        "[-1]",
        "body.removed[0] is -1; allowed: a whole number from 0 to 31",
    );
    assert_eq!(
        edited("example", &[("magnet", None)]).unwrap_err(),
        "magnet is missing; allowed: a table that describes the magnets of the body"
    );
    assert!(edited("example", &[("body.removed", Some("[2, 0, 1]"))]).is_ok());
}

#[test]
fn refuses_magnets_that_do_not_fit_a_rod() {
    let magnet = "{ length_m = 0.01, width_m = 0.01, height_m = 0.002, remanence_t = 1.22, density_kg_m3 = 7500 }";
    let with = |magnets: &str| {
        edited("cantilever", &[("magnet", Some(magnet)), ("body.magnets", Some(magnets))])
    };
    let room = "0.007047735849 to 0.049 m, behind the clamped element, from head to tail with gaps of 1e-5 m or more";
    let one = |position: &str| with(&format!("[{{ position_m = {position}, polarity = 1 }}]"));
    assert!(one("0.049").is_ok());
    assert!(one("0.007047735849").is_ok());
    for (position, shown) in [("0.0495", "0.0495"), ("0.007", "0.007"), ("0.048999", "0.048999")] {
        let sentence = format!("body.magnets[0].position_m is {shown} m; allowed: {room}");
        assert_eq!(one(position).unwrap_err(), sentence);
    }
    let two = "[{ position_m = 0.02, polarity = 1 }, { position_m = 0.03, polarity = -1 }]";
    let sentence = format!("body.magnets[1].position_m is 0.03 m; allowed: {room}");
    assert_eq!(with(two).unwrap_err(), sentence);
    let thick = magnet.replace("0.002", "0.005");
    let tip = "[{ position_m = 0.049, polarity = 1 }]";
    assert_eq!(
        edited("cantilever", &[("magnet", Some(&thick)), ("body.magnets", Some(tip))]).unwrap_err(),
        "magnet.height_m is 0.005 m; allowed: at most body.thickness_m = 0.004 m"
    );
    let full = magnet.replace("0.002", "0.004");
    assert_eq!(
        edited("cantilever", &[("magnet", Some(&full)), ("body.magnets", Some(tip))]).unwrap_err(),
        "magnet.height_m is 0.004 m; allowed: less than the body's thickness where the body ends \
         with a magnet as wide"
    );
    assert_eq!(
        edited("cantilever", &[("body.magnets", Some(tip))]).unwrap_err(),
        "magnet is missing; allowed: a table that describes the magnets of the body"
    );
    refuses(
        "cantilever",
        "body.elements",
        "1",
        "body.elements is 1; allowed: 2 or more where body.clamp is \"head\"",
    );
    assert!(edited("incline-block", &[("body.elements", Some("1"))]).is_ok());
}

#[test]
fn refuses_surroundings_at_odds() {
    for (path, value, rest) in [
        ("ground.dynamic_friction", "0.9", "is 0.9; allowed: at most ground.static_friction = 0.8"),
        ("start.height_m", "-0.001", "is -0.001 m; allowed: 0 m or more where there is ground"),
    ] {
        refuses("example", path, value, &format!("{path} {rest}"));
    }
    assert!(edited("cantilever", &[("start.height_m", Some("-0.001"))]).is_ok());
}

#[test]
fn refuses_periods_that_are_not_whole() {
    for (path, value, sentence) in [
        (
            "control.step_s",
            "0.0205",
            "control.step_s is 0.0205 s; allowed: 1 to 1e8 times solver.step_s = 0.002 s, a whole number of times",
        ),
        (
            "control.episode_s",
            "0.01",
            "control.episode_s is 0.01 s; allowed: 1 to 1e8 times control.step_s = 0.02 s, a whole number of times",
        ),
        (
            "solver.step_s",
            "5e-6",
            "solver.step_s is 5e-6 s; allowed: 1e-5 s or more for newmark and euler",
        ),
        (
            "solver.wrench_interval",
            "3",
            "solver.wrench_interval is 3; allowed: a divisor of 10, the solver steps in control.step_s = 0.02 s",
        ),
        (
            "solver.wrench_interval",
            "20",
            "solver.wrench_interval is 20; allowed: a divisor of 10, the solver steps in control.step_s = 0.02 s",
        ),
    ] {
        refuses("example", path, value, sentence);
    }
    for (field, value) in [("solver.step_s", "4e-4"), ("solver.integrator", "\"explicit\"")] {
        let single = [("solver.precision", Some("\"single\"")), (field, Some(value))];
        let message = edited("example", &single).expect_err("too short a step").to_string();
        assert_eq!(
            message,
            "solver.precision is \"single\"; allowed: \"double\" with explicit and with steps below 5e-4 s, which move \
             less than single precision tells apart"
        );
    }
    let explicit = [("solver.integrator", Some("\"explicit\"")), ("solver.step_s", Some("1e-7"))];
    assert!(edited("example", &explicit).is_ok());
    assert!(edited("example", &[("solver.step_s", Some("0.0033333333333333335"))]).is_ok());
    assert!(edited("example", &[("solver.wrench_interval", Some("10"))]).is_ok());
}

#[test]
fn refuses_variations_without_sense() {
    for (value, sentence) in [
        (
            "[{ parameter = \"mass\", low = 1.2, high = 0.8 }]",
            "reset.vary[0].low is 1.2; allowed: at most reset.vary[0].high = 0.8",
        ),
        (
            "[{ parameter = \"mass\", low = 0, high = 1 }]",
            "reset.vary[0].low is 0; allowed: 0.001 to 1000",
        ),
        (
            "[{ parameter = \"mass\", low = 1, high = 1 }, { parameter = \"mass\", low = 1, high = 2 }]",
            "reset.vary[1].parameter is \"mass\"; allowed: each parameter at most once",
        ),
        (
            "[{ parameter = \"colour\", low = 1, high = 1 }]",
            "reset.vary[0].parameter is \"colour\"; allowed: stiffness, damping, mass, remanence, \
             static_friction, dynamic_friction, drive_speed, horizontal_force, vertical_force, torque, mutual",
        ),
        (
            "[{ parameter = \"mass\", low = 1 }]",
            "reset.vary[0].high is missing; allowed: 0.001 to 1000",
        ),
    ] {
        refuses("example", "reset.vary", value, sentence);
    }
}
