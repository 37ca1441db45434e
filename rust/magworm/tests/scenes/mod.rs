//! Scenes that the contracts of stepping are checked in, in the plane and in space.

#[path = "../base/mod.rs"]
mod base;

use base::base;
use magworm::Model;
use std::sync::Arc;

/// Three magnets of three sizes and directions in feet of three sections, the second one above the middle of its foot, the
/// third one towards its tail.
const MIXED: &str = "{ kind = 'segments', segment = [
    { length_m = 0.014, thickness_m = 0.007, width_m = 0.011, foot = true, elements = 1, magnet = {
        length_m = 0.006, height_m = 0.002, width_m = 0.007, remanence_t = 1.2, density_kg_m3 = 7500 } },
    { length_m = 0.006, thickness_m = 0.004, width_m = 0.011, elements = 4 },
    { length_m = 0.012, thickness_m = 0.008, width_m = 0.013, foot = true, elements = 1, magnet = {
        length_m = 0.008, height_m = 0.002, width_m = 0.006, remanence_t = 1.3, density_kg_m3 = 7500,
        angle_deg = 180, up_m = 0.0015 } },
    { length_m = 0.007, thickness_m = 0.004, width_m = 0.010, elements = 3 },
    { length_m = 0.014, thickness_m = 0.006, width_m = 0.012, foot = true, elements = 2, magnet = {
        length_m = 0.004, height_m = 0.003, width_m = 0.008, remanence_t = 1.1, density_kg_m3 = 7300,
        angle_deg = 50, along_m = 0.002 } } ] }";

/// Fields of a scene and their values in TOML; an empty text takes a field out.
type Edits = &'static [(&'static str, &'static str)];

/// Rubber that magnets of any strength drawn do not fold up.
const FIRM: (&str, &str) = ("material.youngs_modulus_pa", "5e5");

/// Name, preset and edits of each scene.
pub const SCENES: &[(&str, &str, Edits)] = &[
    ("three magnets", "robot", &[]),
    ("experiment", "paper-3", &[]),
    ("experiment in space", "turn-3", &[]),
    ("four magnets", "robot-4", &[]),
    ("five magnets", "robot-5", &[]),
    ("steps of half a millisecond", "robot", &[("solver.step_s", "0.0005")]),
    ("belt", "robot-belt", &[]),
    ("cantilever", "cantilever", &[]),
    ("incline", "incline-block", &[]),
    (
        "multipliers",
        "robot",
        &[
            ("solver.integrator", "'explicit'"),
            ("solver.step_s", "1e-5"),
            ("control.step_s", "5e-4"),
            ("material.damping_time_s", "1e-4"),
        ],
    ),
    (
        "relaxing rubber",
        "robot",
        &[(
            "material.relaxation",
            "[{ ratio = 0.34, time_s = 0.084 }, { ratio = 0.1, time_s = 5e-4 }]",
        )],
    ),
    (
        "suspended drive",
        "robot",
        &[("drive.suspension", "{ mass_kg = 0.05, stiffness_n_m = 200, damping_n_s_m = 0.5 }")],
    ),
    (
        "rebound",
        "robot",
        &[
            ("contact.restitution", "0.7"),
            ("contact.between_feet", "true"),
            ("start.height_m", "0.01"),
            ("start.angle_deg", "20"),
        ],
    ),
    ("uniform field", "robot-4", &[("field", "{ x_t = 0.01, y_t = -0.02 }")]),
    (
        "dipoles with varied parameters",
        "robot",
        &[
            ("solver.magnet_model", "'dipole'"),
            ("ground.adhesion_n", "1e-4"),
            ("drive.arrangement", "{ kind = 'pair', spacing_m = 0.06, second_polarity = -1 }"),
            ("reset.vary", "[{ parameter = 'stiffness', low = 0.5, high = 2.0 }]"),
        ],
    ),
    (
        "waypoints",
        "robot",
        &[(
            "drive.motion",
            "{ kind = 'waypoints', time_s = [0.0, 0.3, 1.1], x_m = [0.02, 0.02, 0.1], \
             y_m = [-0.052, -0.022, -0.03] }",
        )],
    ),
    ("single precision", "robot", &[("solver.precision", "'single'"), ("solver.step_s", "5e-3")]),
    (
        "belt in single precision",
        "robot-belt",
        &[("solver.precision", "'single'"), ("solver.integrator", "'euler'")],
    ),
    (
        "single precision in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("solver.precision", "'single'"),
            ("drive.motion.lateral_reach_m", "0.04"),
            ("drive.motion.yaw_reach_deg", "120"),
        ],
    ),
    (
        "dipoles in single precision in space",
        "robot-4",
        &[
            ("dimensions", "3"),
            ("solver.precision", "'single'"),
            ("solver.magnet_model", "'dipole'"),
            ("drive.motion.lateral_reach_m", "0.03"),
            ("field", "{ x_t = 0.01, y_t = -0.02, z_t = 0.015 }"),
        ],
    ),
    (
        "cantilever in single precision in space",
        "cantilever",
        &[
            ("dimensions", "3"),
            ("solver.precision", "'single'"),
            ("start.yaw_deg", "40"),
            ("start.angle_deg", "20"),
        ],
    ),
    (
        "held wrenches",
        "robot",
        &[("solver.wrench_interval", "5"), ("field", "{ x_t = 0.001, y_t = -0.002 }")],
    ),
    (
        "three magnets in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.04"),
            ("drive.motion.yaw_reach_deg", "120"),
        ],
    ),
    (
        "four magnets in space without yaw",
        "robot-4",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.03"),
            ("start.yaw_deg", "130"),
            ("solver.curvature", "'tangent'"),
        ],
    ),
    (
        "belt in space",
        "robot-belt",
        &[
            ("dimensions", "3"),
            ("drive.motion.z_m", "0.004"),
            ("drive.motion.yaw_deg", "25"),
            ("start.yaw_deg", "-8"),
        ],
    ),
    (
        "cantilever in space",
        "cantilever",
        &[("dimensions", "3"), ("start.yaw_deg", "40"), ("start.angle_deg", "20")],
    ),
    ("incline in space", "incline-block", &[("dimensions", "3"), ("start.yaw_deg", "65")]),
    (
        "multipliers in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.02"),
            ("drive.motion.yaw_reach_deg", "90"),
            ("solver.integrator", "'explicit'"),
            ("solver.step_s", "1e-5"),
            ("control.step_s", "5e-4"),
            ("material.damping_time_s", "2e-5"),
            // Short elements bend fast to the side, where the body is wide.
            ("body.elements_per_bridge", "2"),
        ],
    ),
    (
        "relaxing rubber in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.02"),
            ("start.bends_aside_deg", "[20, -15]"),
            ("solver.integrator", "'euler'"),
            ("material.relaxation", "[{ ratio = 0.5, time_s = 0.02 }]"),
            ("reset.vary", "[{ parameter = 'stiffness', low = 0.5, high = 2.0 }]"),
        ],
    ),
    (
        "rebound in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.02"),
            ("contact.restitution", "0.7"),
            ("start.height_m", "0.01"),
            ("start.angle_deg", "20"),
        ],
    ),
    (
        "suspended drive in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.02"),
            ("drive.suspension", "{ mass_kg = 0.02, stiffness_n_m = 200 }"),
        ],
    ),
    (
        "uniform field in space",
        "robot-4",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.02"),
            ("field", "{ x_t = 0.01, y_t = -0.02, z_t = 0.015 }"),
        ],
    ),
    (
        "dipoles with varied parameters in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.03"),
            ("drive.motion.yaw_reach_deg", "180"),
            ("solver.magnet_model", "'dipole'"),
            ("ground.adhesion_n", "1e-4"),
            ("drive.arrangement", "{ kind = 'pair', spacing_m = 0.06, second_polarity = -1 }"),
            ("reset.vary", "[{ parameter = 'stiffness', low = 0.5, high = 2.0 }]"),
        ],
    ),
    (
        "held wrenches in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.04"),
            ("drive.motion.yaw_reach_deg", "120"),
            ("solver.wrench_interval", "2"),
        ],
    ),
    (
        "waypoints in space",
        "robot",
        &[
            ("dimensions", "3"),
            (
                "drive.motion",
                "{ kind = 'waypoints', time_s = [0.0, 0.3, 1.1], x_m = [0.02, 0.02, 0.1], \
                 y_m = [-0.052, -0.022, -0.03], z_m = [0.01, 0.005, -0.03], \
                 yaw_deg = [-30, 20, 200] }",
            ),
        ],
    ),
    (
        "mixed magnets",
        "robot",
        &[
            ("magnet", ""),
            ("body", MIXED),
            ("field", "{ x_t = 0.002, y_t = -0.001 }"),
            ("magnetic_terms.mutual", "true"),
            FIRM,
        ],
    ),
    (
        "mixed magnets in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.03"),
            ("drive.motion.yaw_reach_deg", "120"),
            ("magnet", ""),
            ("body", MIXED),
            ("magnetic_terms.mutual", "true"),
            FIRM,
            ("body.segment[2].magnet.aside_m", "-0.001"),
            ("body.segment[4].magnet.aside_deg", "35"),
        ],
    ),
    (
        "mixed dipoles in single precision in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("solver.precision", "'single'"),
            ("solver.magnet_model", "'dipole'"),
            ("drive.motion.lateral_reach_m", "0.03"),
            ("magnet", ""),
            ("body", MIXED),
            ("magnetic_terms.mutual", "true"),
            FIRM,
            ("body.segment[2].magnet.aside_m", "-0.001"),
            ("body.segment[4].magnet.aside_deg", "35"),
        ],
    ),
    (
        "five magnets on each other",
        "robot-5",
        &[("magnetic_terms.mutual", "true"), FIRM, ("solver.wrench_interval", "5")],
    ),
    (
        "three magnets on each other in single precision in space",
        "robot",
        &[
            ("magnetic_terms.mutual", "true"),
            FIRM,
            ("dimensions", "3"),
            ("solver.precision", "'single'"),
            ("drive.motion.lateral_reach_m", "0.04"),
            ("drive.motion.yaw_reach_deg", "120"),
        ],
    ),
    ("rolled up", "robot-4", &[("start.bends_deg", "[150, 0, 270]")]),
    (
        "twisted in space",
        "robot",
        &[
            ("dimensions", "3"),
            ("drive.motion.lateral_reach_m", "0.02"),
            ("start.bends_deg", "[40, -60]"),
            ("start.bends_aside_deg", "[90]"),
            ("start.twists_deg", "[-100, 300, 100]"),
        ],
    ),
];

/// The model of a scene; its name is that of the list.
pub fn model(name: &str) -> Arc<Model> {
    let place = SCENES.iter().position(|(listed, ..)| *listed == name);
    let (_, preset, edits) = SCENES[place.expect("a listed scene")];
    let edits: Vec<_> = edits
        .iter()
        .map(|(path, value)| {
            let value = (!value.is_empty()).then(|| value.parse().expect("TOML"));
            (path.to_string(), value)
        })
        .chain([("name".to_string(), Some(name.into()))])
        .collect();
    let scene = base(preset).with_values(&edits);
    Arc::new(Model::compile(&scene.expect("a valid scene")).expect("a model"))
}
