//! A scene whose values stay as they are, whatever the presets are calibrated to.

use magworm::scene::{PRESETS, Scene};
use toml::Value;

/// A worm over a controlled drive, with every table that a preset writes.
pub const EXAMPLE: &str = r#"
name = "example"
gravity_m_s2 = 9.81

[body]
kind = "worm"
magnets = 3
pitch_m = 0.020
foot_length_m = 0.014
foot_thickness_m = 0.007
bridge_thickness_m = 0.004
width_m = 0.015
elements_per_bridge = 4
elements_per_foot_end = 1

[material]
youngs_modulus_pa = 80e3
density_kg_m3 = 1070

[magnet]
length_m = 0.008
width_m = 0.010
height_m = 0.002
remanence_t = 1.22
density_kg_m3 = 7500

[ground]
static_friction = 0.8
dynamic_friction = 0.6

[drive]
length_m = 0.040
width_m = 0.030
height_m = 0.004
remanence_t = 1.22

[drive.arrangement]
kind = "single"

[drive.motion]
kind = "controlled"
reach_m = 0.060
lowest_m = -0.062
highest_m = -0.022

[solver]
step_s = 0.002

[control]
step_s = 0.020
episode_s = 10.0
"#;

/// The example, or a preset, with fields replaced by values written in TOML; `None` removes.
pub fn edited(name: &str, edits: &[(&str, Option<&str>)]) -> Result<Scene, String> {
    let values: Vec<(String, Option<Value>)> = edits
        .iter()
        .map(|(path, text)| (path.to_string(), text.map(|text| text.parse().expect("TOML"))))
        .collect();
    let scene =
        if PRESETS.contains(&name) { Scene::preset(name) } else { Scene::from_toml(EXAMPLE) };
    scene.expect("a scene").with_values(&values).map_err(|error| error.to_string())
}

/// Asserts the sentence that refuses one replaced field.
#[track_caller]
pub fn refuses(name: &str, path: &str, value: &str, sentence: &str) {
    assert_eq!(edited(name, &[(path, Some(value))]).unwrap_err(), sentence);
}
