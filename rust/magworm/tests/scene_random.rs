//! Random scenes, valid and spoiled: none may panic, and what validates is finite.

mod scene_strategy;

use magworm::scene::{Body, PRESETS, Problem, Scene};
use proptest::prelude::*;
use proptest::sample::Index;
use toml::{Table, Value};

/// What may be done to one field of a scene.
#[derive(Clone, Debug)]
enum Harm {
    Replace(Value),
    Remove,
    Add(String),
}

fn spoiled_value() -> impl Strategy<Value = Value> {
    let table = Table::from_iter([("kind".into(), Value::from("rod"))]);
    prop_oneof![
        prop::num::f64::ANY.prop_map(Value::Float),
        any::<i64>().prop_map(Value::Integer),
        (-3..40_i64).prop_map(Value::Integer),
        (-1.0..1.0).prop_map(Value::Float),
        prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 1e300])
            .prop_map(Value::Float),
        any::<bool>().prop_map(Value::Boolean),
        ".{0,80}".prop_map(Value::String),
        prop::sample::select(vec!["worm", "rod", "belt", "pair", "constant", "waypoints", "mass"])
            .prop_map(Value::from),
        prop::collection::vec(-2..3_i64, 0..4).prop_map(Value::from),
        prop::collection::vec(prop::num::f64::ANY, 0..4).prop_map(Value::from),
        Just(Value::Table(table)),
        Just(Value::Table(Table::new())),
        Just(Value::Datetime("1979-05-27".parse().expect("a date"))),
    ]
}

fn harm() -> impl Strategy<Value = Harm> {
    prop_oneof![
        4 => spoiled_value().prop_map(Harm::Replace),
        1 => Just(Harm::Remove),
        1 => "[a-z_.\"\\[\\]]{0,9}".prop_map(Harm::Add),
    ]
}

/// Paths of all tables and fields.
fn paths(values: &Table, before: &[String]) -> Vec<Vec<String>> {
    let mut found = vec![];
    for (name, value) in values {
        let path = [before, std::slice::from_ref(name)].concat();
        if let Value::Table(inner) = value {
            found.extend(paths(inner, &path));
        }
        found.push(path);
    }
    found
}

fn spoil(values: &mut Table, path: &[String], harm: &Harm) {
    let (name, rest) = path.split_first().expect("a path");
    match (values.get_mut(name), rest.is_empty(), harm) {
        (Some(Value::Table(inner)), false, _) => spoil(inner, rest, harm),
        (Some(Value::Table(inner)), true, Harm::Add(new)) => {
            inner.insert(new.clone(), Value::Boolean(true));
        }
        (_, _, Harm::Replace(value)) => {
            values.insert(name.clone(), value.clone());
        }
        (_, _, Harm::Remove) => {
            values.remove(name);
        }
        (_, _, Harm::Add(new)) => {
            values.insert(new.clone(), Value::Boolean(true));
        }
    }
}

/// What every scene that leaves the library must keep to.
fn sound(result: &Result<Scene, magworm::scene::SceneError>) -> Result<(), TestCaseError> {
    match result {
        Ok(scene) => {
            prop_assert_eq!(scene.validate(), Ok(()));
            prop_assert!(finite(&Value::try_from(scene).expect("a scene is TOML")));
            prop_assert_eq!(&Scene::from_toml(&scene.to_toml()), result);
        }
        Err(error) => {
            let sentence = error.to_string();
            prop_assert!(!sentence.is_empty() && !sentence.contains('\n'), "{sentence:?}");
        }
    }
    Ok(())
}

fn finite(value: &Value) -> bool {
    match value {
        Value::Float(number) => number.is_finite(),
        Value::Array(values) => values.iter().all(finite),
        Value::Table(values) => values.values().all(finite),
        _ => true,
    }
}

/// Scenes of the plane and of space.
fn scene(most_nodes: usize) -> impl Strategy<Value = Scene> {
    prop_oneof![scene_strategy::scene(most_nodes, 2), scene_strategy::scene(most_nodes, 3)]
}

fn preset() -> impl Strategy<Value = Scene> {
    prop::sample::select(PRESETS).prop_map(|name| Scene::preset(name).expect("a preset"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10_000, ..ProptestConfig::default() })]

    #[test]
    fn random_valid_scenes_validate_and_survive_toml(scene in scene(1000)) {
        sound(&Ok(scene))?;
    }

    #[test]
    fn spoiled_scenes_do_not_panic(
        scene in prop_oneof![preset(), scene(50)],
        harms in prop::collection::vec((any::<Index>(), harm()), 1..4),
    ) {
        let mut values = Table::try_from(&scene).expect("a scene is TOML");
        for (index, harm) in &harms {
            let paths = paths(&values, &[]);
            if !paths.is_empty() {
                spoil(&mut values, &paths[index.index(paths.len())], harm);
            }
        }
        let result = Scene::from_toml(&toml::to_string(&values).expect("TOML"));
        sound(&result)?;
        // The grammar and the structs agree: nothing that passes the grammar is refused by serde.
        let syntax = matches!(result, Err(error) if matches!(error.problem, Problem::Syntax(_)));
        prop_assert!(!syntax);
    }

    #[test]
    fn random_edits_do_not_panic(
        scene in preset(),
        donor in scene(50),
        index in any::<Index>(),
        value in prop::option::of(spoiled_value()),
        tail in prop_oneof![Just(String::new()), "\\.[a-z_.]{0,6}"],
    ) {
        let donor = Table::try_from(&donor).expect("a scene is TOML");
        let path = index.get(&paths(&donor, &[])).join(".") + &tail;
        sound(&scene.with_values(&[(path, value)]))?;
    }

    #[test]
    fn random_bytes_do_not_panic(
        name in prop::sample::select(PRESETS),
        edits in prop::collection::vec((any::<Index>(), 0..24_usize, any::<Vec<u8>>()), 1..5),
    ) {
        let mut text = Scene::preset_text(name).expect("a preset").as_bytes().to_vec();
        for (index, length, bytes) in edits {
            let start = index.index(text.len() + 1);
            let end = (start + length).min(text.len());
            text.splice(start..end, bytes.into_iter().take(length));
        }
        sound(&Scene::from_toml(&String::from_utf8_lossy(&text)))?;
    }

    #[test]
    fn cut_and_doubled_lines_do_not_panic(
        name in prop::sample::select(PRESETS),
        moves in prop::collection::vec((any::<Index>(), any::<Index>(), any::<bool>()), 1..4),
    ) {
        let text = Scene::preset_text(name).expect("a preset");
        let mut lines: Vec<&str> = text.lines().collect();
        for (from, to, keep) in moves {
            let line = if keep { *from.get(&lines) } else { lines.remove(from.index(lines.len())) };
            lines.insert(to.index(lines.len() + 1), line);
        }
        sound(&Scene::from_toml(&lines.join("\n")))?;
    }

    #[test]
    fn scenes_spoiled_in_code_do_not_panic(
        mut scene in scene(50),
        number in prop::num::f64::ANY,
        count in any::<usize>(),
        place in 0..11,
    ) {
        match place {
            0 => scene.gravity_m_s2 = number,
            1 => scene.material.youngs_modulus_pa = number,
            2 => scene.control.episode_s = number,
            3 => scene.solver.quadrature_order = count,
            4 => scene.solver.step_s = number,
            5 => scene.magnet = None,
            6 => scene.start.height_m = number,
            7 => scene.start.yaw_deg = number,
            8 => scene.dimensions = count,
            9 => scene.solver.wrench_interval = count,
            _ => match &mut scene.body {
                Body::Worm(worm) => worm.removed.push(count),
                Body::Rod(rod) => rod.elements = count,
                Body::Segments(body) => body.segment[0].elements = count,
            },
        }
        let result = scene.validate().map(|()| scene.clone());
        sound(&result)?;
        prop_assert_eq!(scene.with_values(&[]), result);
        let _ = scene.to_toml();
    }
}
