//! Scenes from text: presets, types, unknown fields, lines; and copies with replaced values.

mod scene_example;

use magworm::scene::{Body, Motion, PRESETS, Problem, Scene, Solver};
use scene_example::{EXAMPLE, edited, refuses};

/// Asserts that `old` → `new` in the example is refused on the line of `anchor`.
#[track_caller]
fn refuses_text(old: &str, new: &str, anchor: &str, sentence: &str) {
    assert!(EXAMPLE.contains(old), "{old:?} is not in the example");
    let text = EXAMPLE.replacen(old, new, 1);
    let line = 1 + text[..text.find(anchor).expect("an anchor")].matches('\n').count();
    let error = Scene::from_toml(&text).unwrap_err();
    assert_eq!(error.to_string(), format!("line {line}: {sentence}"));
    assert_eq!(error.line, Some(line));
}

#[test]
fn presets_load_and_survive_toml() {
    for name in PRESETS {
        let scene = Scene::preset(name).unwrap();
        assert_eq!(scene.name, *name);
        assert_eq!(scene.validate(), Ok(()));
        assert_eq!(Scene::from_toml(&scene.to_toml()), Ok(scene));
    }
    assert_eq!(
        Scene::preset("paper-6").unwrap_err().to_string(),
        "there is no preset \"paper-6\"; presets: \
         paper-3, paper-3-simulation, paper-4, paper-5, turn-3, turn-3-pair, cantilever, belt-125, \
         incline-block"
    );
}

#[test]
fn refuses_wrong_types() {
    for (path, value, rest) in [
        ("gravity_m_s2", "\"Mars\"", "is \"Mars\"; allowed: 0 to 981 m/s²"),
        ("gravity_m_s2", "[9.81]", "is a list of 1; allowed: 0 to 981 m/s²"),
        ("body.magnets", "3.0", "is 3; allowed: a whole number from 1 to 32"),
        ("name", "1979-05-27", "is the date 1979-05-27; allowed: a text"),
        ("reset.random_drive", "1", "is 1; allowed: true or false"),
        ("solver.integrator", "\"rk4\"", "is \"rk4\"; allowed: newmark, euler, explicit"),
        ("drive.reference", "{}", "is a table; allowed: centre, top"),
        (
            "body.removed",
            "1",
            "is 1; allowed: a list of at most 32, each a whole number from 0 to 31",
        ),
        ("field", "1.0", "is 1; allowed: a table with x_t, y_t, z_t"),
        ("body", "3", "is 3; allowed: a table whose kind is one of worm, rod, segments"),
    ] {
        refuses("example", path, value, &format!("{path} {rest}"));
    }
}

#[test]
fn text_errors_name_the_line() {
    let friction = "ground.dynamic_friction is 0.6; allowed: at most ground.static_friction = 0.5";
    for (old, new, anchor, sentence) in [
        ("80e3", "-3", "youngs", "material.youngs_modulus_pa is -3 Pa; allowed: 100 to 1e11 Pa"),
        ("= 0.8", "= 0.5", "dynamic_friction", friction),
        (
            "= 0.8",
            "= ",
            "static_friction",
            "not valid TOML: string values must be quoted, expected literal string",
        ),
        ("pitch_m = 0.020", "", "[body]", "body.pitch_m is missing; allowed: 0.001 to 1 m"),
        (
            "width_m = 0.015",
            "width_m = []",
            "width_m = []",
            "body.width_m is a list of 0; allowed: 1e-4 to 0.5 m",
        ),
        (
            "kind = \"controlled\"",
            "",
            "[drive.motion]",
            "drive.motion.kind is missing; allowed: controlled, constant, waypoints",
        ),
        (
            "[control]",
            "[[reset.vary]]\nparameter = \"mass\"\nlow = 0\nhigh = 1\n[control]",
            "low = 0",
            "reset.vary[0].low is 0; allowed: 0.001 to 1000",
        ),
    ] {
        refuses_text(old, new, anchor, sentence);
    }
    let table =
        "a table with youngs_modulus_pa, density_kg_m3, damping_time_s, poisson_ratio, relaxation";
    let text = Scene::preset_text("cantilever").unwrap().replace("[material]", "[start]");
    let error = Scene::from_toml(&text).unwrap_err();
    assert_eq!(error.to_string(), format!("material is missing; allowed: {table}"));
}

#[test]
fn unknown_fields_are_refused_everywhere() {
    for (path, rest) in [
        (
            "colour",
            "the scene has: name, gravity_m_s2, dimensions, body, material, magnet, ground, contact, drive, field, magnetic_terms, start, solver, control, reset",
        ),
        (
            "body.colour",
            "body has: kind, magnets, pitch_m, foot_length_m, foot_thickness_m, bridge_thickness_m, width_m, first_polarity, removed, elements_per_bridge, elements_per_foot_end",
        ),
        (
            "body.clamp",
            "body has: kind, magnets, pitch_m, foot_length_m, foot_thickness_m, bridge_thickness_m, width_m, first_polarity, removed, elements_per_bridge, elements_per_foot_end",
        ),
        ("drive.arrangement.count", "drive.arrangement has: kind"),
        (
            "drive.motion.y_m",
            "drive.motion has: kind, reach_m, lowest_m, highest_m, speed_m_s, acceleration_m_s2, lateral_reach_m, yaw_reach_deg, yaw_speed_deg_s, yaw_acceleration_deg_s2",
        ),
        ("gravity_m_s2.x", "gravity_m_s2 has: no fields"),
        ("reset.vary.0", "reset.vary has: no fields"),
    ] {
        let sentence = format!("{path} is not a field of a scene; {rest}");
        refuses("example", path, "1", &sentence);
        assert_eq!(edited("example", &[(path, None)]).unwrap_err(), sentence);
    }
    for (old, table, known) in [
        ("kind = \"single\"", "drive.arrangement", "kind"),
        (
            "kind = \"controlled\"",
            "drive.motion",
            "kind, reach_m, lowest_m, highest_m, speed_m_s, acceleration_m_s2, lateral_reach_m, yaw_reach_deg, yaw_speed_deg_s, yaw_acceleration_deg_s2",
        ),
        (
            "[solver]",
            "solver",
            "integrator, step_s, magnet_model, quadrature_order, wrench_interval, contact_iterations, fastest_m_s, curvature, precision",
        ),
    ] {
        let sentence = format!("{table}.colour is not a field of a scene; {table} has: {known}");
        refuses_text(old, &format!("{old}\ncolour = 1"), "colour", &sentence);
    }
}

/// Also without the grammar: serde itself refuses fields that a variant does not know.
#[test]
fn serde_refuses_unknown_fields_of_variants() {
    let text = Scene::preset_text("belt-125").unwrap();
    for old in ["kind = \"worm\"", "kind = \"belt\"", "kind = \"constant\""] {
        let spoiled = text.replacen(old, &format!("{old}\ncolour = 1"), 1);
        assert!(toml::from_str::<Scene>(&spoiled).is_err(), "{old}");
    }
}

#[test]
fn values_replace_tables_and_remove_them() {
    let motion = "{ kind = \"constant\", x_m = -0.05, y_m = -0.022, speed_m_s = 0.1 }";
    let scene = edited("example", &[("drive.motion", Some(motion)), ("ground", None)]).unwrap();
    assert_eq!(scene.ground, None);
    let constant =
        Motion::Constant { x_m: -0.05, y_m: -0.022, speed_m_s: 0.1, z_m: 0.0, yaw_deg: 0.0 };
    assert_eq!(scene.drive.unwrap().motion, constant);

    let field = [("field.x_t", Some("0.01")), ("field.y_t", Some("0"))];
    assert_eq!(edited("cantilever", &field).unwrap().field.unwrap().x_t, 0.01);
    assert_eq!(
        edited("cantilever", &field[..1]).unwrap_err(),
        "field.y_t is missing; allowed: -10 to 10 T"
    );

    let damaged = edited("paper-5", &[("body.removed", Some("[1, 3]"))]).unwrap();
    assert!(matches!(&damaged.body, Body::Worm(worm) if worm.removed == [1, 3]));
    let whole = damaged.with_values(&[("body.removed".into(), None)]).unwrap();
    assert_eq!(whole, Scene::preset("paper-5").unwrap());
    assert_eq!(edited("example", &[("solver", None)]).unwrap().solver, Solver::default());
    assert_eq!(
        edited("example", &[("material", None)]).unwrap_err(),
        "material cannot be removed; it is needed by the scene"
    );
    assert_eq!(
        edited("example", &[("drive.motion.kind", None)]).unwrap_err(),
        "drive.motion.kind cannot be removed; it is needed by drive.motion"
    );
}

#[test]
fn deep_text_is_refused_without_exhausting_the_stack() {
    for text in ["a.".repeat(100_000) + "a = 1", "a = ".to_owned() + &"[".repeat(100_000)] {
        assert!(Scene::from_toml(&text).is_err());
    }
}

#[test]
fn scenes_are_planar_unless_they_say_otherwise() {
    let scene = Scene::from_toml(EXAMPLE).unwrap();
    assert_eq!((scene.dimensions, scene.material.poisson_ratio), (2, 0.5));
    assert_eq!((scene.start.z_m, scene.start.yaw_deg), (0.0, 0.0));
    let Motion::Controlled(limits) = scene.drive.unwrap().motion else { panic!("a stage") };
    assert_eq!((limits.lateral_reach_m, limits.yaw_reach_deg), (0.0, 0.0));
    assert_eq!((limits.yaw_speed_deg_s, limits.yaw_acceleration_deg_s2), (180.0, 3600.0));
}

/// Whatever the grammar calls optional has a default in serde too: no removal ends in serde's words.
#[test]
fn every_removal_is_a_scene_or_a_clear_refusal() {
    for name in PRESETS {
        let scene = Scene::preset(name).unwrap();
        let table = toml::Table::try_from(&scene).unwrap();
        for path in paths(&table, "") {
            if let Err(error) = scene.with_values(&[(path.clone(), None)]) {
                let needed = matches!(error.problem, Problem::Needed { .. });
                let spoils_others = ["magnet", "solver", "dimensions"].contains(&path.as_str());
                assert!(needed || spoils_others, "{path}: {error}");
            }
        }
    }
}

fn paths(values: &toml::Table, before: &str) -> Vec<String> {
    let mut found = vec![];
    for (name, value) in values {
        let path = format!("{before}{name}");
        if let toml::Value::Table(inner) = value {
            found.extend(paths(inner, &format!("{path}.")));
        }
        found.push(path);
    }
    found
}
