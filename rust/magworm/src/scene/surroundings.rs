//! Ground, uniform field, and the choice of magnetic terms.

use super::Parameter;
use serde::{Deserialize, Serialize};

/// Flat, rigid ground with static and dynamic friction (paper, contact section):
/// a foot that moves no faster than `v_d` holds up to μ_s N + D_f, beyond that it slides with μ_d N + D_f.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ground {
    /// Static coefficient of friction μ_s.
    pub static_friction: f64,
    /// Dynamic coefficient of friction μ_d ≤ μ_s.
    pub dynamic_friction: f64,
    /// Speed v_d up to which a contact may stick [m/s].
    #[serde(default = "transition_speed")]
    pub transition_speed_m_s: f64,
    /// Tangential adhesion D_f of each contact point [N].
    #[serde(default)]
    pub adhesion_n: f64,
    /// Incline [°]: positive runs downhill towards +x. Gravity is turned, the frame stays with the ground.
    #[serde(default)]
    pub incline_deg: f64,
}

/// A uniform magnetic flux density.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UniformField {
    /// Component along x [T].
    pub x_t: f64,
    /// Component along y [T].
    pub y_t: f64,
    /// Component along z [T]; 0 in the plane.
    #[serde(default)]
    pub z_t: f64,
}

/// Components of the drive's wrench that act, and the forces between the body's magnets; the paper has none of the latter, and
/// its ablations switch single components off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MagneticTerms {
    /// Force along x; in space along z too.
    pub horizontal_force: bool,
    /// Force along y.
    pub vertical_force: bool,
    /// Torque about z; in space about all axes.
    pub torque: bool,
    /// Force and torque of the body's magnets on each other.
    pub mutual: bool,
}

impl Default for MagneticTerms {
    fn default() -> Self {
        Self { horizontal_force: true, vertical_force: true, torque: true, mutual: true }
    }
}

impl MagneticTerms {
    /// Whether the term that a parameter is a factor of acts; other parameters have none.
    pub fn has(&self, parameter: Parameter) -> bool {
        match parameter {
            Parameter::HorizontalForce => self.horizontal_force,
            Parameter::VerticalForce => self.vertical_force,
            Parameter::Torque => self.torque,
            Parameter::Mutual => self.mutual,
            _ => true,
        }
    }
}

fn transition_speed() -> f64 {
    1e-3
}
