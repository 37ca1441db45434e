//! Accuracy: one word that chooses step, mesh, wrench, integrator and precision.
//!
//! `solver.accuracy` is not part of a [`Scene`](super::Scene): it is replaced by the values it stands for as the scene is
//! read, so that a scene always shows what it runs with. Their errors and costs are measured in
//! docs/performance.md, for the presets; a scene with other lengths and times has others.

use toml::{Table, Value};

use super::error::Problem;

/// Field that holds the word.
pub(super) const ACCURACY: &str = "accuracy";

/// The words.
pub(super) const ACCURACIES: &[&str] = &["fast", "balanced", "reference"];

/// What a word stands for.
struct Level {
    name: &'static str,
    precision: &'static str,
    /// Step in the plane and in space [s]: there feet jam more easily.
    step_s: [f64; 2],
    elements_per_bridge: i64,
    elements_per_foot_end: i64,
    quadrature_order: i64,
}

const LEVELS: [Level; 3] = [
    Level {
        name: ACCURACIES[0],
        precision: "single",
        step_s: [5e-3, 2e-3],
        elements_per_bridge: 4,
        elements_per_foot_end: 2,
        quadrature_order: 2,
    },
    Level {
        name: ACCURACIES[1],
        precision: "double",
        step_s: [5e-4, 5e-4],
        elements_per_bridge: 8,
        elements_per_foot_end: 2,
        quadrature_order: 2,
    },
    Level {
        name: ACCURACIES[2],
        precision: "double",
        step_s: [1e-4, 1e-4],
        elements_per_bridge: 16,
        elements_per_foot_end: 4,
        quadrature_order: 4,
    },
];

/// Replaces the word in a scene's table that was written by a person.
///
/// # Errors
/// A word that is none, or a value that it stands for beside it.
pub(super) fn expand(scene: &mut Table) -> Result<(), Problem> {
    let solver = scene.get_mut("solver").and_then(Value::as_table_mut);
    let Some(word) = solver.and_then(|solver| solver.remove(ACCURACY)) else { return Ok(()) };
    let before = scene.clone();
    choose(scene, &word)?;
    for (table, field) in CHOSEN {
        if before.get(table).and_then(|table| table.get(field)).is_some() {
            return Err(Problem::Value {
                field: format!("solver.{ACCURACY}"),
                value: word.to_string(),
                allowed: format!("no {table}.{field} beside it, which it chooses"),
            });
        }
    }
    Ok(())
}

/// Fields that a word writes; those of the body for worms alone.
const CHOSEN: [(&str, &str); 8] = [
    ("solver", "integrator"),
    ("solver", "precision"),
    ("solver", "step_s"),
    ("solver", "magnet_model"),
    ("solver", "quadrature_order"),
    ("solver", "wrench_interval"),
    ("body", "elements_per_bridge"),
    ("body", "elements_per_foot_end"),
];

/// Writes what a word stands for over a scene's values.
///
/// # Errors
/// A word that is none.
pub(super) fn choose(scene: &mut Table, word: &Value) -> Result<(), Problem> {
    let named = |level: &&Level| word.as_str() == Some(level.name);
    let Some(level) = LEVELS.iter().find(named) else {
        return Err(Problem::Value {
            field: format!("solver.{ACCURACY}"),
            value: word.to_string(),
            allowed: format!("one of {}", ACCURACIES.join(", ")),
        });
    };
    let space = scene.get("dimensions").and_then(Value::as_integer) == Some(3);
    let body = scene.get("body").and_then(|body| body.get("kind")).and_then(Value::as_str);
    let values = [
        Value::from("newmark"),
        Value::from(level.precision),
        Value::from(level.step_s[usize::from(space)]),
        Value::from("cuboid"),
        Value::from(level.quadrature_order),
        Value::from(1),
        Value::from(level.elements_per_bridge),
        Value::from(level.elements_per_foot_end),
    ];
    let count = if body == Some("worm") { values.len() } else { values.len() - 2 };
    for ((table, field), value) in CHOSEN.into_iter().zip(values).take(count) {
        let table = scene.entry(table).or_insert_with(|| Value::Table(Table::new()));
        if let Some(table) = table.as_table_mut() {
            table.insert(field.into(), value);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::CHOSEN;
    use crate::scene::Scene;

    fn with(word: &str) -> Result<Scene, String> {
        let values = [("solver.accuracy".to_string(), Some(word.into()))];
        Scene::preset("paper-3")
            .expect("a preset")
            .with_values(&values)
            .map_err(|error| error.to_string())
    }

    #[test]
    fn a_word_stands_for_values() {
        let scene = with("balanced").expect("a word");
        assert_eq!((scene.solver.step_s, scene.solver.quadrature_order), (5e-4, 2));
        assert!(scene.to_toml().contains("elements_per_bridge = 8"));
        assert!(!scene.to_toml().contains("accuracy"));
    }

    #[test]
    fn later_values_hold() {
        let values = [
            ("solver.accuracy".to_string(), Some("fast".into())),
            ("solver.step_s".to_string(), Some(1e-3.into())),
        ];
        let scene = Scene::preset("paper-3").expect("a preset").with_values(&values);
        assert_eq!(scene.expect("both").solver.step_s, 1e-3);
    }

    #[test]
    fn every_word_computes_wrenches_in_every_step() {
        let holds = [("solver.wrench_interval".to_string(), Some(5.into()))];
        let holding = Scene::preset("paper-3").and_then(|scene| scene.with_values(&holds));
        let word = [("solver.accuracy".to_string(), Some("reference".into()))];
        let scene = holding.expect("a divisor").with_values(&word);
        assert_eq!(scene.expect("a word").solver.wrench_interval, 1);
    }

    #[test]
    fn a_word_that_is_none_is_refused() {
        let message = with("exact").expect_err("not a word");
        assert_eq!(
            message,
            "solver.accuracy is \"exact\"; allowed: one of fast, balanced, reference"
        );
    }

    #[test]
    fn a_file_says_it_once() {
        let text = Scene::preset("paper-3").expect("a preset").to_toml();
        let both = text.replace("[solver]", "[solver]\naccuracy = \"fast\"");
        let message = Scene::from_toml(&both).expect_err("twice").to_string();
        assert!(message.contains("no solver.integrator beside it"), "{message}");
    }

    #[test]
    fn a_file_may_leave_the_rest_out() {
        let text = Scene::preset("paper-3").expect("a preset").to_toml();
        let chosen: Vec<&str> = CHOSEN.iter().map(|(_, field)| *field).collect();
        let mut in_solver_or_body = false;
        let mut kept = String::new();
        for line in text.lines() {
            if line.starts_with('[') {
                in_solver_or_body = matches!(line, "[solver]" | "[body]");
            }
            if !(in_solver_or_body && chosen.iter().any(|name| line.starts_with(name))) {
                kept += &format!("{line}\n");
            }
        }
        let short = kept.replace("[solver]", "[solver]\naccuracy = \"reference\"");
        let scene = Scene::from_toml(&short).expect("short");
        assert_eq!(Ok(scene), with("reference"));
    }
}
