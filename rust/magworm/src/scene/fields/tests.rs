use super::super::Scene;
use super::super::schema::{Kind, Table, Variant};
use super::SCENE;

/// Paths of the grammar that a serialised scene with every table lacks.
fn lacking(values: &toml::Table, table: &Table, path: &str) -> Vec<String> {
    let mut found = vec![];
    for field in table.fields {
        let path = format!("{path}.{}", field.name);
        match (values.get(field.name), &field.kind) {
            (None, _) => found.push(path),
            (Some(toml::Value::Table(inner)), Kind::Table(table)) => {
                found.extend(lacking(inner, table, &path));
            }
            (Some(toml::Value::Table(inner)), Kind::Variants(variants)) => {
                found.extend(lacking(inner, chosen(inner, variants), &path));
            }
            _ => {}
        }
    }
    found
}

fn chosen(values: &toml::Table, variants: &[Variant]) -> &'static Table {
    let name = values["kind"].as_str().expect("a kind");
    variants.iter().find(|variant| variant.name == name).expect("a variant").table
}

#[test]
fn the_structs_have_every_field_of_the_grammar() {
    let pair = "{ kind = \"pair\", spacing_m = 0.05, second_polarity = 1 }";
    let points = "{ kind = \"waypoints\", time_s = [0], x_m = [0], y_m = [0] }";
    let bent = "{ bends_deg = [9], bends_aside_deg = [9], twists_deg = [9] }";
    let relaxation = "[{ ratio = 0.3, time_s = 0.08 }]";
    let suspension = "{ mass_kg = 0.1, stiffness_n_m = 500, damping_n_s_m = 1 }";
    let rod = "{ kind = \"rod\", length_m = 1, width_m = 0.1, thickness_m = 0.01, elements = 9 }";
    for (preset, path, value) in [
        ("paper-3", "name", "\"controlled\""),
        ("belt-125", "name", "\"constant\""),
        ("paper-3", "drive.arrangement", pair),
        ("paper-3", "drive.motion", points),
        ("paper-3", "body", rod),
    ] {
        let edits = [
            ("dimensions", "3"),
            ("field", "{ x_t = 0, y_t = 0 }"),
            ("start", bent),
            ("material.relaxation", relaxation),
            ("drive.suspension", suspension),
            (path, value),
        ]
        .map(|(path, value)| (path.into(), Some(value.parse().expect("TOML"))));
        let scene = Scene::preset(preset).and_then(|scene| scene.with_values(&edits));
        let values = scene.and_then(|scene| Ok(scene.to_table()?)).expect("a scene");
        assert_eq!(lacking(&values, &SCENE, ""), Vec::<String>::new());
    }
}
