//! The tasks: a scene, and what is done with it.

use magworm::Model;
use magworm::scene::Scene;

/// What is counted.
#[derive(Clone, Copy, PartialEq)]
pub enum Work {
    /// Solver steps of a block of eight robots, sixteen in single precision.
    Block,
    /// Solver steps of one robot in plain `f64`, observations included.
    Scalar,
    /// Wrenches of eight lanes.
    Wrench,
    /// Control steps of a batch of eight environments.
    Control,
}

/// Fields of a scene and their values in TOML; an empty value takes a field out.
type Edits = &'static [(&'static str, &'static str)];

/// A task.
pub struct Case {
    pub name: &'static str,
    preset: &'static str,
    edits: Edits,
    pub work: Work,
}

impl Case {
    /// Compiles the scene.
    pub fn model(&self) -> Result<Model, String> {
        let mut values = Vec::new();
        for (path, text) in self.edits {
            let value = match *text {
                "" => None,
                text => Some(parse(text)?),
            };
            values.push((path.to_string(), value));
        }
        let scene = Scene::preset(self.preset).and_then(|scene| scene.with_values(&values));
        scene.and_then(|scene| Model::compile(&scene)).map_err(|error| error.to_string())
    }
}

fn parse(text: &str) -> Result<toml::Value, String> {
    let mut table: toml::Table =
        toml::from_str(&format!("value = {text}")).map_err(|e| e.to_string())?;
    table.remove("value").ok_or_else(|| format!("{text} is no value"))
}

const fn case(name: &'static str, work: Work, preset: &'static str, edits: Edits) -> Case {
    Case { name, preset, edits, work }
}

/// So high that the fall ends above the ground.
const IN_THE_AIR: Edits = &[("start.height_m", "4.0")];
const NO_GROUND: Edits = &[("ground", "")];
const NO_ADHESION: Edits = &[("ground.adhesion_n", "0.0")];
const NO_FRICTION: Edits = &[
    ("ground.static_friction", "0.0"),
    ("ground.dynamic_friction", "0.0"),
    ("ground.adhesion_n", "0.0"),
];
/// A rod that bends, and nothing else; then one effect more.
const BARE: Edits = &[
    ("ground", ""),
    ("drive", ""),
    ("gravity_m_s2", "0.0"),
    ("material.damping_time_s", "0.0"),
    ("magnetic_terms.mutual", "false"),
];
const GRAVITY: Edits = &[
    ("ground", ""),
    ("drive", ""),
    ("material.damping_time_s", "0.0"),
    ("magnetic_terms.mutual", "false"),
];
const DAMPING: Edits =
    &[("ground", ""), ("drive", ""), ("gravity_m_s2", "0.0"), ("magnetic_terms.mutual", "false")];
/// One relaxing branch.
const RELAXATION: Edits = &[
    ("ground", ""),
    ("drive", ""),
    ("gravity_m_s2", "0.0"),
    ("material.damping_time_s", "0.0"),
    ("material.relaxation", "[{ ratio = 0.34, time_s = 0.084 }]"),
    ("magnetic_terms.mutual", "false"),
];
const DRIVE: Edits = &[
    ("ground", ""),
    ("gravity_m_s2", "0.0"),
    ("material.damping_time_s", "0.0"),
    ("magnetic_terms.mutual", "false"),
];
const FIELD: Edits = &[
    ("ground", ""),
    ("drive", ""),
    ("gravity_m_s2", "0.0"),
    ("material.damping_time_s", "0.0"),
    ("field", "{ x_t = 0.01, y_t = -0.02 }"),
    ("magnetic_terms.mutual", "false"),
];
const MUTUAL: Edits =
    &[("ground", ""), ("drive", ""), ("gravity_m_s2", "0.0"), ("material.damping_time_s", "0.0")];
/// The whole robot without forces between its magnets.
const NO_MUTUAL: Edits = &[("magnetic_terms.mutual", "false")];
const DAMAGE: Edits = &[
    ("ground", ""),
    ("drive", ""),
    ("gravity_m_s2", "0.0"),
    ("material.damping_time_s", "0.0"),
    ("body.removed", "[1]"),
    ("magnetic_terms.mutual", "false"),
];
const GROUND: Edits = &[
    ("drive", ""),
    ("gravity_m_s2", "0.0"),
    ("material.damping_time_s", "0.0"),
    ("start.height_m", "4.0"),
    ("magnetic_terms.mutual", "false"),
];
const SINGLE: Edits = &[("solver.precision", "'single'")];
/// Sixteen drive magnets, most of them far away.
const BELT: Edits = &[("drive.arrangement.count", "16")];
/// Wrenches that act for five steps.
const HELD: Edits = &[("solver.wrench_interval", "5")];
const BELT_HELD: Edits = &[("drive.arrangement.count", "16"), ("solver.wrench_interval", "5")];

/// All tasks.
pub const CASES: &[Case] = &[
    case("step-plane", Work::Block, "paper-3", &[]),
    case("step-space", Work::Block, "turn-3", &[]),
    case("step-plane-scalar", Work::Scalar, "paper-3", &[]),
    case("step-space-scalar", Work::Scalar, "turn-3", &[]),
    case("step-plane-single", Work::Block, "paper-3", SINGLE),
    case("step-space-single", Work::Block, "turn-3", SINGLE),
    case("wrench-plane", Work::Wrench, "paper-3", &[]),
    case("wrench-space", Work::Wrench, "turn-3", &[]),
    case("wrench-plane-order-1", Work::Wrench, "paper-3", &[("solver.quadrature_order", "1")]),
    case("wrench-space-order-1", Work::Wrench, "turn-3", &[("solver.quadrature_order", "1")]),
    case("control-plane-no-ground", Work::Control, "paper-3", NO_GROUND),
    case("control-space-no-ground", Work::Control, "turn-3", NO_GROUND),
    case("no-ground-plane", Work::Block, "paper-3", NO_GROUND),
    case("no-ground-space", Work::Block, "turn-3", NO_GROUND),
    case("air-plane", Work::Block, "paper-3", IN_THE_AIR),
    case("air-space", Work::Block, "turn-3", IN_THE_AIR),
    case("no-adhesion-plane", Work::Block, "paper-3", NO_ADHESION),
    case("no-adhesion-space", Work::Block, "turn-3", NO_ADHESION),
    case("no-friction-plane", Work::Block, "paper-3", NO_FRICTION),
    case("no-friction-space", Work::Block, "turn-3", NO_FRICTION),
    case("bare-plane", Work::Block, "paper-3", BARE),
    case("bare-space", Work::Block, "turn-3", BARE),
    case("gravity-plane", Work::Block, "paper-3", GRAVITY),
    case("gravity-space", Work::Block, "turn-3", GRAVITY),
    case("damping-plane", Work::Block, "paper-3", DAMPING),
    case("damping-space", Work::Block, "turn-3", DAMPING),
    case("relaxation-plane", Work::Block, "paper-3", RELAXATION),
    case("relaxation-space", Work::Block, "turn-3", RELAXATION),
    case("drive-plane", Work::Block, "paper-3", DRIVE),
    case("drive-space", Work::Block, "turn-3", DRIVE),
    case("field-plane", Work::Block, "paper-3", FIELD),
    case("field-space", Work::Block, "turn-3", FIELD),
    case("mutual-plane", Work::Block, "paper-3", MUTUAL),
    case("mutual-space", Work::Block, "turn-3", MUTUAL),
    case("no-mutual-plane", Work::Block, "paper-3", NO_MUTUAL),
    case("no-mutual-space", Work::Block, "turn-3", NO_MUTUAL),
    case("damage-plane", Work::Block, "paper-3", DAMAGE),
    case("damage-space", Work::Block, "turn-3", DAMAGE),
    case("ground-plane", Work::Block, "paper-3", GROUND),
    case("ground-space", Work::Block, "turn-3", GROUND),
    case("belt-plane", Work::Block, "belt-125", &[]),
    case("belt-16-plane", Work::Block, "belt-125", BELT),
    case("held-plane", Work::Block, "paper-3", HELD),
    case("held-space", Work::Block, "turn-3", HELD),
    case("held-belt-16-plane", Work::Block, "belt-125", BELT_HELD),
];
