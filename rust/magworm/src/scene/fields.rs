//! Every field of a scene with its unit and range. What it means stands at the field of the struct.
//!
//! Ranges are wide: they keep out slips of unit and what no method here can compute, not scenes
//! that are merely unusual. Where fields depend on each other, see the rules beside this file.

use super::Integrator;
use super::schema::{Kind, Table, Variant, optional, real, required, whole};

/// Most magnets in a body.
pub(super) const MAX_MAGNETS: i64 = 32;
/// Most branches of a rubber that relaxes.
const MAX_BRANCHES: usize = 16;
/// Most segments of a body.
const MAX_SEGMENTS: usize = 100;
/// Shortest rod element [m]: shorter ones make the stiffness of a step too badly scaled to solve.
pub(super) const SHORTEST_ELEMENT_M: f64 = 1e-5;
/// Most drive magnets.
pub(super) const MAX_DRIVE_MAGNETS: i64 = 16;
/// Most steps for which a wrench acts.
const MAX_STEPS_OF_A_WRENCH: i64 = 10_000;
/// Greatest speed of a drive [m/s].
pub(super) const GREATEST_DRIVE_SPEED_M_S: f64 = 10.0;
/// Greatest speed of yaw of a drive between waypoints [°/s].
pub(super) const GREATEST_DRIVE_YAW_SPEED_DEG_S: f64 = 1e4;
/// Most parts that a body is bent in at the start, and the greatest angle of each list in all [°].
const MAX_BENT_PARTS: usize = 1000;
pub(super) const GREATEST_BEND_DEG: f64 = 36_000.0;
/// Most points in time of a drive that moves between waypoints.
pub(super) const MAX_WAYPOINTS: usize = 10_000;

const EDGE: Kind = real("m", 1e-4, 0.5);
const THICKNESS: Kind = real("m", 1e-4, 0.03);
const OFFSET: Kind = real("m", -0.5, 0.5);
const REMANENCE: Kind = real("T", 0.0, 10.0);
const DENSITY: Kind = real("kg/m³", 1.0, 1e5);
const POSITION: Kind = real("m", -10.0, 10.0);
const HEIGHT: Kind = real("m", -1.0, 1.0);
const FLUX_DENSITY: Kind = real("T", -10.0, 10.0);
const TURN: Kind = real("°", -360.0, 360.0);
const MANY_TURNS: Kind = real("°", -36_000.0, 36_000.0);
const BENDS: Kind =
    Kind::List { of: &real("°", -GREATEST_BEND_DEG, GREATEST_BEND_DEG), most: MAX_BENT_PARTS };
const FRICTION: Kind = real("", 0.0, 10.0);
const FACTOR: Kind = real("", 1e-3, 1e3);
const SHORT: Kind = real("s", 1e-7, 0.05);

pub(super) static SCENE: Table = Table {
    fields: &[
        optional("name", Kind::Text),
        optional("gravity_m_s2", real("m/s²", 0.0, 981.0)),
        optional("dimensions", whole(2, 3)),
        required("body", Kind::Variants(BODY)),
        required("material", Kind::Table(&MATERIAL)),
        optional("magnet", Kind::Table(&MAGNET)),
        optional("ground", Kind::Table(&GROUND)),
        optional("contact", Kind::Table(&CONTACT)),
        optional("drive", Kind::Table(&DRIVE)),
        optional("field", Kind::Table(&FIELD)),
        optional("magnetic_terms", Kind::Table(&MAGNETIC_TERMS)),
        optional("start", Kind::Table(&START)),
        optional("solver", Kind::Table(&SOLVER)),
        optional("control", Kind::Table(&CONTROL)),
        optional("reset", Kind::Table(&RESET)),
    ],
};

const BODY: &[Variant] = &[
    Variant { name: "worm", table: &WORM },
    Variant { name: "rod", table: &ROD },
    Variant { name: "segments", table: &SEGMENTS },
];

static WORM: Table = Table {
    fields: &[
        required("magnets", whole(1, MAX_MAGNETS)),
        required("pitch_m", real("m", 1e-3, 1.0)),
        required("foot_length_m", EDGE),
        required("foot_thickness_m", THICKNESS),
        required("bridge_thickness_m", THICKNESS),
        required("width_m", EDGE),
        optional("first_polarity", Kind::Polarity),
        optional("removed", Kind::List { of: &whole(0, MAX_MAGNETS - 1), most: 32 }),
        required("elements_per_bridge", whole(1, 999)),
        required("elements_per_foot_end", whole(1, 999)),
    ],
};

static ROD: Table = Table {
    fields: &[
        required("length_m", real("m", 1e-3, 10.0)),
        required("width_m", EDGE),
        required("thickness_m", THICKNESS),
        required("elements", whole(1, 999)),
        optional("clamp", Kind::Choice(&["none", "head"])),
        optional("magnets", Kind::List { of: &Kind::Table(&ROD_MAGNET), most: 32 }),
    ],
};

static ROD_MAGNET: Table = Table {
    fields: &[required("position_m", real("m", 0.0, 10.0)), required("polarity", Kind::Polarity)],
};

static SEGMENTS: Table = Table {
    fields: &[
        optional("clamp", Kind::Choice(&["none", "head"])),
        required("segment", Kind::List { of: &Kind::Table(&SEGMENT), most: MAX_SEGMENTS }),
    ],
};

static SEGMENT: Table = Table {
    fields: &[
        required("length_m", real("m", SHORTEST_ELEMENT_M, 10.0)),
        required("thickness_m", THICKNESS),
        required("width_m", EDGE),
        optional("foot", Kind::Flag),
        required("elements", whole(1, 999)),
        optional("magnet", Kind::Table(&SEGMENT_MAGNET)),
    ],
};

static SEGMENT_MAGNET: Table = Table {
    fields: &[
        required("length_m", EDGE),
        required("width_m", EDGE),
        required("height_m", EDGE),
        required("remanence_t", REMANENCE),
        required("density_kg_m3", DENSITY),
        optional("angle_deg", TURN),
        optional("aside_deg", real("°", -90.0, 90.0)),
        optional("along_m", OFFSET),
        optional("up_m", OFFSET),
        optional("aside_m", OFFSET),
        optional("present", Kind::Flag),
    ],
};

static MATERIAL: Table = Table {
    fields: &[
        required("youngs_modulus_pa", real("Pa", 1e2, 1e11)),
        required("density_kg_m3", DENSITY),
        optional("damping_time_s", real("s", 0.0, 1.0)),
        optional("poisson_ratio", real("", 0.0, 0.5)),
        optional("relaxation", Kind::List { of: &Kind::Table(&RELAXATION), most: MAX_BRANCHES }),
    ],
};

static RELAXATION: Table = Table {
    fields: &[required("ratio", real("", 0.0, 100.0)), required("time_s", real("s", 1e-6, 1e4))],
};

static MAGNET: Table = Table {
    fields: &[
        required("length_m", EDGE),
        required("width_m", EDGE),
        required("height_m", EDGE),
        required("remanence_t", REMANENCE),
        required("density_kg_m3", DENSITY),
    ],
};

static GROUND: Table = Table {
    fields: &[
        required("static_friction", FRICTION),
        required("dynamic_friction", FRICTION),
        optional("transition_speed_m_s", real("m/s", 1e-9, 1.0)),
        optional("adhesion_n", real("N", 0.0, 100.0)),
        optional("incline_deg", real("°", -90.0, 90.0)),
    ],
};

static CONTACT: Table = Table {
    fields: &[
        optional("points", Kind::Choice(&["feet", "nodes"])),
        optional("edge_radius_m", real("m", 0.0, 0.25)),
        optional("between_feet", Kind::Flag),
        optional("restitution", real("", 0.0, 1.0)),
        optional("restitution_from_m_s", real("m/s", 0.0, 100.0)),
    ],
};

static DRIVE: Table = Table {
    fields: &[
        required("length_m", EDGE),
        required("width_m", EDGE),
        required("height_m", EDGE),
        required("remanence_t", REMANENCE),
        optional("reference", Kind::Choice(&["centre", "top"])),
        optional("arrangement", Kind::Variants(ARRANGEMENT)),
        required("motion", Kind::Variants(MOTION)),
        optional("suspension", Kind::Table(&SUSPENSION)),
    ],
};

static SUSPENSION: Table = Table {
    fields: &[
        required("mass_kg", real("kg", 1e-3, 100.0)),
        required("stiffness_n_m", real("N/m", 1.0, 1e7)),
        optional("damping_n_s_m", real("N·s/m", 0.0, 1e4)),
    ],
};

const ARRANGEMENT: &[Variant] = &[
    Variant { name: "single", table: &Table { fields: &[] } },
    Variant { name: "pair", table: &PAIR },
    Variant { name: "belt", table: &BELT },
];

static PAIR: Table = Table {
    fields: &[
        required("spacing_m", real("m", 1e-4, 1.0)),
        required("second_polarity", Kind::Polarity),
    ],
};

static BELT: Table = Table {
    fields: &[
        required("pitch_m", real("m", 1e-3, 10.0)),
        required("count", whole(1, MAX_DRIVE_MAGNETS)),
    ],
};

const MOTION: &[Variant] = &[
    Variant { name: "controlled", table: &STAGE_LIMITS },
    Variant { name: "constant", table: &CONSTANT },
    Variant { name: "waypoints", table: &WAYPOINTS },
];

static STAGE_LIMITS: Table = Table {
    fields: &[
        required("reach_m", real("m", 1e-4, 10.0)),
        required("lowest_m", HEIGHT),
        required("highest_m", HEIGHT),
        optional("speed_m_s", real("m/s", 1e-4, GREATEST_DRIVE_SPEED_M_S)),
        optional("acceleration_m_s2", real("m/s²", 1e-3, 1e6)),
        optional("lateral_reach_m", real("m", 0.0, 10.0)),
        optional("yaw_reach_deg", real("°", 0.0, 180.0)),
        optional("yaw_speed_deg_s", real("°/s", 1e-3, 1e5)),
        optional("yaw_acceleration_deg_s2", real("°/s²", 1e-3, 1e8)),
    ],
};

static CONSTANT: Table = Table {
    fields: &[
        required("x_m", POSITION),
        required("y_m", HEIGHT),
        required("speed_m_s", real("m/s", -GREATEST_DRIVE_SPEED_M_S, GREATEST_DRIVE_SPEED_M_S)),
        optional("z_m", POSITION),
        optional("yaw_deg", TURN),
    ],
};

static WAYPOINTS: Table = Table {
    fields: &[
        required("time_s", Kind::List { of: &real("s", 0.0, 1e5), most: MAX_WAYPOINTS }),
        required("x_m", Kind::List { of: &POSITION, most: MAX_WAYPOINTS }),
        required("y_m", Kind::List { of: &HEIGHT, most: MAX_WAYPOINTS }),
        optional("z_m", Kind::List { of: &POSITION, most: MAX_WAYPOINTS }),
        optional("yaw_deg", Kind::List { of: &MANY_TURNS, most: MAX_WAYPOINTS }),
    ],
};

static FIELD: Table = Table {
    fields: &[
        required("x_t", FLUX_DENSITY),
        required("y_t", FLUX_DENSITY),
        optional("z_t", FLUX_DENSITY),
    ],
};

static MAGNETIC_TERMS: Table = Table {
    fields: &[
        optional("horizontal_force", Kind::Flag),
        optional("vertical_force", Kind::Flag),
        optional("torque", Kind::Flag),
        optional("mutual", Kind::Flag),
    ],
};

static START: Table = Table {
    fields: &[
        optional("x_m", POSITION),
        optional("height_m", POSITION),
        optional("angle_deg", TURN),
        optional("z_m", POSITION),
        optional("yaw_deg", TURN),
        optional("bends_deg", BENDS),
        optional("bends_aside_deg", BENDS),
        optional("twists_deg", BENDS),
    ],
};

static SOLVER: Table = Table {
    fields: &[
        optional("integrator", Kind::Choice(&Integrator::NAMES)),
        optional("step_s", SHORT),
        optional("magnet_model", Kind::Choice(&["cuboid", "dipole"])),
        optional("quadrature_order", whole(1, 10)),
        optional("wrench_interval", whole(1, MAX_STEPS_OF_A_WRENCH)),
        optional("contact_iterations", whole(1, 1000)),
        optional("fastest_m_s", real("m/s", 1e-3, 1e4)),
        optional("curvature", Kind::Choice(&["angle", "tangent"])),
        optional("precision", Kind::Choice(&["double", "single"])),
    ],
};

static CONTROL: Table = Table {
    fields: &[
        optional("step_s", real("s", 1e-7, 10.0)),
        optional("episode_s", real("s", 1e-7, 1e5)),
    ],
};

static RESET: Table = Table {
    fields: &[
        optional("random_drive", Kind::Flag),
        optional("vary", Kind::List { of: &Kind::Table(&VARIATION), most: PARAMETERS.len() }),
    ],
};

const PARAMETERS: &[&str] = &[
    "stiffness",
    "damping",
    "mass",
    "remanence",
    "static_friction",
    "dynamic_friction",
    "drive_speed",
    "horizontal_force",
    "vertical_force",
    "torque",
    "mutual",
];

static VARIATION: Table = Table {
    fields: &[
        required("parameter", Kind::Choice(PARAMETERS)),
        required("low", FACTOR),
        required("high", FACTOR),
    ],
};

#[cfg(test)]
mod tests;
