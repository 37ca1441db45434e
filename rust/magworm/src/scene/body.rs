//! The soft body and its magnets.

use serde::{Deserialize, Serialize};

/// The soft body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Body {
    /// Thick feet that hold one magnet each, joined by thin bridges.
    Worm(Worm),
    /// A rod of constant section.
    Rod(Rod),
    /// Segments that each have their own section and magnet; what worms and rods are made of, too.
    Segments(Segments),
}

impl Body {
    /// The length that describes it [m]: the pitch of a worm, the length of a rod; none where segments differ.
    pub fn scale_m(&self) -> Option<f64> {
        match self {
            Self::Worm(worm) => Some(worm.pitch_m),
            Self::Rod(rod) => Some(rod.length_m),
            Self::Segments(_) => None,
        }
    }
}

/// Feet joined by bridges: length = (magnets − 1) · pitch + foot length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worm {
    /// Number of feet, each made for one magnet.
    pub magnets: usize,
    /// Distance between the centres of adjacent magnets [m].
    pub pitch_m: f64,
    /// Length of a foot along the robot [m].
    pub foot_length_m: f64,
    /// Thickness of the body at a foot [m].
    pub foot_thickness_m: f64,
    /// Thickness of the body between feet [m].
    pub bridge_thickness_m: f64,
    /// Width of the body, along z of the rest robot [m].
    pub width_m: f64,
    /// Polarity of the first magnet: 1 attracted by the drive beneath it, −1 repelled. The others alternate.
    #[serde(default = "one")]
    pub first_polarity: i8,
    /// Magnets taken out, counted from 0 at the head. The cavity is filled with rubber and the
    /// foot stays as stiff as before: an assumption, so that robots with different damage fit in one batch.
    #[serde(default)]
    pub removed: Vec<usize>,
    /// Rod elements per bridge.
    pub elements_per_bridge: usize,
    /// Rod elements between the end of a magnet and the end of its foot.
    pub elements_per_foot_end: usize,
}

/// A rod of constant rectangular section along x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rod {
    /// Length [m].
    pub length_m: f64,
    /// Width, along z of the rest rod [m].
    pub width_m: f64,
    /// Thickness, along y of the rest rod [m].
    pub thickness_m: f64,
    /// Number of rod elements; more are added where magnets end.
    pub elements: usize,
    /// Whether the head end is clamped.
    #[serde(default)]
    pub clamp: Clamp,
    /// Magnets in the rod.
    #[serde(default)]
    pub magnets: Vec<RodMagnet>,
}

/// How the head end of a rod is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clamp {
    /// Free.
    #[default]
    None,
    /// Position and direction held.
    Head,
}

/// A magnet in a rod.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RodMagnet {
    /// Position of its centre along the rod, from the head [m].
    pub position_m: f64,
    /// 1: magnetised along +y of the rest rod, −1: along −y.
    pub polarity: i8,
}

/// Segments in a line, head first.
///
/// The corners of feet may touch the ground; where no segment is a foot, every node of the body may.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Segments {
    /// Whether the head end is clamped.
    #[serde(default)]
    pub clamp: Clamp,
    /// The segments.
    pub segment: Vec<Segment>,
}

/// A length of constant rectangular section, with a magnet or without.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Segment {
    /// Length along the body [m].
    pub length_m: f64,
    /// Thickness, along y of the rest body [m].
    pub thickness_m: f64,
    /// Width, along z of the rest body [m].
    pub width_m: f64,
    /// Whether it is a foot, whose corners stand on the ground and turn with its magnet.
    #[serde(default)]
    pub foot: bool,
    /// Rod elements in it; where it holds a magnet, on each side of the magnet.
    pub elements: usize,
    /// The magnet that it holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magnet: Option<SegmentMagnet>,
}

/// A cuboid permanent magnet in a segment, its edges along the segment's.
///
/// Angles and places are those of the rest body: along it from head to tail, up, and to its side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SegmentMagnet {
    /// Edge along the body [m].
    pub length_m: f64,
    /// Edge along the width [m].
    pub width_m: f64,
    /// Edge along the thickness [m].
    pub height_m: f64,
    /// Magnitude of the remanence |Br| [T].
    pub remanence_t: f64,
    /// Density [kg/m³].
    pub density_kg_m3: f64,
    /// Direction of the remanence in the plane of length and thickness, from up towards the head [°]: 0 is up, 90 towards the
    /// head, 180 down, −90 towards the tail.
    #[serde(default)]
    pub angle_deg: f64,
    /// By how much the remanence leans out of that plane, towards the side [°]; 0 in the plane.
    #[serde(default)]
    pub aside_deg: f64,
    /// Place of its centre from that of the segment, towards the tail [m].
    #[serde(default)]
    pub along_m: f64,
    /// The same upwards [m].
    #[serde(default)]
    pub up_m: f64,
    /// The same towards the side [m]; 0 in the plane.
    #[serde(default)]
    pub aside_m: f64,
    /// Whether it is in its place; else its cavity is filled with rubber, and the segment is as stiff as before.
    #[serde(default = "present")]
    pub present: bool,
}

impl SegmentMagnet {
    /// Volume [m³].
    pub fn volume_m3(&self) -> f64 {
        self.length_m * self.width_m * self.height_m
    }

    /// Mass of the magnet alone [kg].
    pub fn mass_kg(&self) -> f64 {
        self.density_kg_m3 * self.length_m * self.width_m * self.height_m
    }

    /// Place of its centre from the middle of its body along it, up and to the side [m].
    pub fn offset_m(&self) -> [f64; 3] {
        [0.0, self.up_m, self.aside_m]
    }
}

/// Rubber: linear elastic with Kelvin–Voigt damping, σ = E (ε + τ ε̇), and where it relaxes with a Maxwell branch for each
/// time in which it does: σ = E (ε + τ ε̇ + Σ rᵢ (ε − βᵢ)), β̇ᵢ = (ε − βᵢ)/τᵢ, the generalised Maxwell solid or Prony series.
///
/// One branch is the standard linear solid: with x = ωτ₁ it stores E′ = E (1 + r x²/(1 + x²)) and loses E″ = E r x/(1 + x²), at
/// most tan δ = r/(2√(1 + r)), at x = 1/√(1 + r).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E [Pa]; where the rubber relaxes, that in the long run.
    pub youngs_modulus_pa: f64,
    /// Density [kg/m³].
    pub density_kg_m3: f64,
    /// Kelvin–Voigt retardation time τ [s].
    #[serde(default)]
    pub damping_time_s: f64,
    /// Poisson's ratio ν; only space needs it, for the shear modulus G = E/(2(1 + ν)) of a twisted
    /// body. Rubber hardly changes its volume: 0.5.
    #[serde(default = "incompressible")]
    pub poisson_ratio: f64,
    /// Maxwell branches; none: the rubber does not relax. At a start they have relaxed in its shape.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub relaxation: Vec<Relaxation>,
}

impl Material {
    /// What stands beside the modulus of the long run before any branch relaxes: Σ r.
    pub fn relaxing_ratio(&self) -> f64 {
        self.relaxation.iter().map(|branch| branch.ratio).sum()
    }
}

/// A Maxwell branch of the rubber.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Relaxation {
    /// r: its stiffness over that in the long run.
    pub ratio: f64,
    /// Its relaxation time [s].
    pub time_s: f64,
}

/// A cuboid permanent magnet of the body, magnetised along its height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Magnet {
    /// Edge along the robot [m].
    pub length_m: f64,
    /// Edge along the width [m].
    pub width_m: f64,
    /// Edge along the thickness [m].
    pub height_m: f64,
    /// Magnitude of the remanence |Br| [T].
    pub remanence_t: f64,
    /// Density [kg/m³].
    pub density_kg_m3: f64,
}

fn one() -> i8 {
    1
}

fn present() -> bool {
    true
}

fn incompressible() -> f64 {
    0.5
}
