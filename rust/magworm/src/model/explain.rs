//! A compiled scene in words: which terms are in, which were left out, and why.

use super::{ContactParameters, Model, UniformTorque};
use crate::scene::{Curvature, MagnetModel, Plan, Precision, Scene, Segment, Suspension};
use std::fmt::Write;

impl Model {
    /// Terms compiled into the model, and those left out with the reason, a line each.
    pub fn explain(&self) -> String {
        let mut text = String::new();
        let mut line = |name: &str, words: String| {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{name:<14}{words}");
        };
        let scheme = self.scene.solver.integrator.coefficients().words;
        line("integrator", format!("{scheme}, step {} s{}", self.step_s, self.explain_limit()));
        let precision = match self.scene.solver.precision {
            Precision::Double => "double, eight robots in a vector",
            Precision::Single => "single, sixteen robots in a vector",
        };
        line("precision", precision.into());
        let (unknowns, half) = (self.coordinates.count, self.system.half_bandwidth());
        line("unknowns", format!("{unknowns}, half-bandwidth {half}"));
        line("stretching", format!("{} elements", self.stretch.len()));
        let curvature = match self.scene.solver.curvature {
            Curvature::Angle => "κ = φ",
            Curvature::Tangent => "κ = 2 tan(φ/2)",
        };
        let ways = match self.dimensions() {
            2 => "in the plane",
            _ => "about two axes and twisting",
        };
        line("bending", format!("{} nodes {ways}, {curvature}", self.bend.len()));
        line("relaxation", self.explain_relaxation());
        if let Some(shape) = &self.shape {
            line("start", shape.explain());
        }
        line("gravity", self.explain_gravity());
        line("ground", self.explain_ground());
        line("feet", self.explain_between_feet());
        line("drive", self.explain_drive());
        line("mutual", self.explain_mutual());
        line("uniform field", self.explain_field());
        text
    }

    fn explain_limit(&self) -> String {
        if !self.scene.solver.integrator.is_explicit() {
            return String::new();
        }
        let limit = self.explicit_limit();
        format!(" of at most {:.3e} s for {}", limit.step_s, limit.reason())
    }

    fn explain_relaxation(&self) -> String {
        let branches = &self.scene.material.relaxation;
        if branches.is_empty() {
            return "left out: the material has no [[relaxation]]".to_string();
        }
        let words = branches.iter().map(|one| format!("{} in {} s", one.ratio, one.time_s));
        let words = words.collect::<Vec<_>>().join(", ");
        format!("{words}: stiffness over that in the long run, relaxation time")
    }

    fn explain_gravity(&self) -> String {
        match self.program.gravity_m_s2 {
            Some([x, y, _]) => format!("({x:.4}, {y:.4}) m/s²"),
            None => "left out: gravity_m_s2 is 0".to_string(),
        }
    }

    fn explain_ground(&self) -> String {
        match &self.program.contact {
            Some(law) => format!(
                "{} contact points{} that {} of the unknowns move, static friction {}, dynamic {}{}",
                self.contacts.len() - self.moving_surfaces(),
                self.explain_edges(),
                self.system.unknowns().len(),
                law.static_friction,
                law.dynamic_friction,
                explain_rebound(law)
            ),
            None => "left out: the scene has no [ground]".to_string(),
        }
    }

    fn explain_edges(&self) -> String {
        match self.scene.contact.edge_radius_m {
            0.0 => String::new(),
            radius_m => format!(" on edges rounded by {radius_m} m"),
        }
    }

    fn explain_between_feet(&self) -> String {
        match self.moving_surfaces() {
            0 => "pass through each other: contact.between_feet is false".into(),
            corners => format!(
                "{corners} corners stop at neighbouring feet, without friction; bridges let them pass, which they meet only \
                where the inner side of one is compressed by more than {:.0} %",
                100.0 * compression_where_feet_meet_bridges(&self.scene)
            ),
        }
    }

    fn explain_drive(&self) -> String {
        if self.program.actuators.is_empty() {
            return "left out: the scene has no [drive]".to_string();
        }
        let Some(magnetics) = &self.program.magnetics else {
            return "wrench left out: the body has no magnets".to_string();
        };
        let pair = match self.scene.solver.magnet_model {
            MagnetModel::Cuboid => {
                format!("cuboids, quadrature order {}", self.scene.solver.quadrature_order)
            }
            MagnetModel::Dipole => "dipoles".to_string(),
        };
        let pairs = magnetics.count();
        let often = match magnetics.interval {
            1 => "a step".to_string(),
            n => format!("every {n} steps, held between"),
        };
        format!("{pairs} wrenches {often}, {pair}{}", self.explain_suspension())
    }

    fn explain_suspension(&self) -> String {
        let suspension = self.scene.drive.as_ref().and_then(|drive| drive.suspension.as_ref());
        suspension.map_or_else(String::new, |one| {
            let Suspension { mass_kg, stiffness_n_m, damping_n_s_m } = one;
            let swing_hz = (stiffness_n_m / mass_kg).sqrt() / std::f64::consts::TAU;
            let damping = 0.5 * damping_n_s_m / (stiffness_n_m * mass_kg).sqrt();
            format!("; the stage gives way at {swing_hz:.3} Hz, damping ratio {damping:.3}")
        })
    }

    fn explain_mutual(&self) -> String {
        match &self.program.mutual {
            Some(mutual) => mutual.explain(self),
            None if self.scene.magnetic_terms.mutual => {
                "left out: the body has fewer than two magnets".to_string()
            }
            None => "left out: magnetic_terms.mutual is false".to_string(),
        }
    }

    fn explain_field(&self) -> String {
        match (&self.program.uniform_field, &self.scene.field) {
            (Some(UniformTorque { field_t, .. }), _) => {
                let components = field_t[..self.dimensions()].iter().map(f64::to_string);
                format!("({}) T", components.collect::<Vec<_>>().join(", "))
            }
            (None, Some(_)) => "left out: the body has no magnets".to_string(),
            (None, None) => "left out: the scene has no [field]".to_string(),
        }
    }
}

/// Compression of the inner side of a bridge below which it cannot meet the foot that it begins at: ε = π/(4 Σ l/h).
///
/// Up to a right angle the sides of a bridge lead away from the face of that foot; a bridge of length l and thickness h whose inner
/// side is compressed by ε turns by 2 ε l/h.
fn compression_where_feet_meet_bridges(scene: &Scene) -> f64 {
    let slenderness = |bridge: &[Segment]| -> f64 {
        bridge.iter().map(|part| part.length_m / part.thickness_m.min(part.width_m)).sum()
    };
    let plan = Plan::new(scene);
    let most = plan.segments.split(|part| part.foot).map(slenderness).fold(0.0, f64::max);
    std::f64::consts::FRAC_PI_4 / most
}

fn explain_rebound(law: &ContactParameters) -> String {
    law.restitution.as_ref().map_or_else(String::new, |one| {
        format!(", restitution {} from {} m/s", one.coefficient, one.from_m_s)
    })
}
