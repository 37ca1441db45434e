//! Scenes that tests begin with: presets, and a robot of the tests' own, which no identification moves.

use magworm::Scene;

const IN_SPACE: &[(&str, &str)] = &[
    ("dimensions", "3"),
    ("drive.motion.lateral_reach_m", "0.030"),
    ("drive.motion.yaw_reach_deg", "90.0"),
];
const ON_A_BELT: &[(&str, &str)] = &[
    ("drive.arrangement", "{ kind = 'belt', pitch_m = 0.125, count = 3 }"),
    ("drive.motion", "{ kind = 'constant', x_m = -0.050, y_m = -0.022, speed_m_s = 0.100 }"),
    ("reset", ""),
];

/// The robot of `data/robot.toml`, whose magnets do not act on each other, with three magnets (`robot`) or more (`robot-4`,
/// `robot-5`), over a belt (`robot-belt`), in space over a stage that moves aside and yaws (`robot-turn`); or a preset.
pub fn base(name: &str) -> Scene {
    let edits: &[(&str, &str)] = match name {
        "robot" => &[],
        "robot-4" => &[("body.magnets", "4")],
        "robot-5" => &[("body.magnets", "5")],
        "robot-belt" => ON_A_BELT,
        "robot-turn" => IN_SPACE,
        preset => return Scene::preset(preset).expect("a preset"),
    };
    let values: Vec<_> = edits
        .iter()
        .map(|(path, text)| {
            (path.to_string(), (!text.is_empty()).then(|| text.parse().expect("TOML")))
        })
        .collect();
    let robot = Scene::from_toml(include_str!("../data/robot.toml"));
    robot.and_then(|scene| scene.with_values(&values)).expect("a valid scene")
}
