//! Wrench between magnets that are near each other or touch, to a tolerance.
//!
//! Beside the drive's edges B grows without bound, and across the plane of a face it turns within the gap. A face of the
//! body that lies along such a plane would have to be cut into panels as small as the gap, so faces across the gap are
//! left out. With c the body's axis across the gap, its magnetisation J = J_c c + J_⊥ acts as charge where it is J_⊥, and
//! as current where it is J_c c (Furlani 2001, ch. 3): both stand on the four faces along c alone. On a face with the
//! outward normal m these are σ = J_⊥·m/μ0 and K = J_c c × m/μ0, and an area feels
//!
//! f = σ B + K × B = [(J_⊥·m) B + J_c (m (c·B) − c (m·B))]/μ0.
//!
//! Charge and current of one magnetisation feel the same force and the same torque, as the drive's field has neither
//! divergence nor curl within the body. Panels whose integrals change by being halved are halved, in the direction that
//! changes them most, so that they become slender along an edge, until what changes is within the tolerance.

use super::{GaussLegendre, MU_0, Magnet, Wrench, field_t};
use nalgebra::{Matrix3, Vector3, Vector6};

/// The most panels of a wrench: magnets whose edges touch along their length take a thousand at order 5.
const MAX_PANELS: usize = 4000;
/// Where parts cancel to less than this of their sum, what is left counts as this much.
const CANCELLED: f64 = 1e-4;

/// A body near its drive.
pub(super) struct Near<'a> {
    pub drive: &'a Magnet,
    pub body: &'a Magnet,
    pub position_m: Vector3<f64>,
    /// Edges of the body as columns.
    pub axes: Matrix3<f64>,
    /// The body's axis across the gap.
    pub across: usize,
    pub rule: GaussLegendre,
    /// What is allowed to change by halving all panels, of the sum.
    pub tolerance: f64,
}

impl Near<'_> {
    /// Force and torque on the body.
    pub fn wrench(&self) -> Wrench {
        let faces = self.faces().map(|face| self.halved(face, self.integral(&face)));
        let mut panels = Vec::from(faces);
        loop {
            let total: Vector6<f64> = panels.iter().map(|panel| panel.value).sum();
            let parts: f64 = panels.iter().map(|panel| self.size(&panel.value)).sum();
            let change: f64 = panels.iter().map(|panel| panel.change).sum();
            let allowed = self.tolerance * self.size(&total).max(CANCELLED * parts);
            if change <= allowed || panels.len() > MAX_PANELS {
                let [fx, fy, fz, tx, ty, tz] = total.into();
                let (force_n, torque_n_m) = (Vector3::new(fx, fy, fz), Vector3::new(tx, ty, tz));
                return Wrench { force_n, torque_n_m };
            }
            let share = allowed / panels.len() as f64;
            panels = panels.into_iter().flat_map(|panel| self.cut(panel, share)).collect();
        }
    }

    /// The four faces along the gap.
    fn faces(&self) -> [Panel; 4] {
        let [s, t] = [1, 2].map(|k| (self.across + k) % 3);
        let half = 0.5 * self.body.size_m;
        [(s, t, 1.0), (s, t, -1.0), (t, s, 1.0), (t, s, -1.0)].map(|(normal, along, side)| Panel {
            normal,
            side,
            centre: [0.0; 2],
            half: [half[self.across], half[along]],
        })
    }

    /// Both halves of a panel that changes by more than its share, or the panel itself.
    fn cut(&self, whole: Halved, share: f64) -> Vec<Halved> {
        if whole.change <= share {
            return vec![whole];
        }
        let halves = whole.panel.halves(whole.direction).into_iter().zip(whole.halves);
        halves.map(|(half, value)| self.halved(half, value)).collect()
    }

    /// A panel of that integral, halved in either direction.
    fn halved(&self, panel: Panel, integral: Vector6<f64>) -> Halved {
        let halves =
            [0, 1].map(|direction| panel.halves(direction).map(|half| self.integral(&half)));
        let changes = halves.map(|[first, second]| first + second - integral);
        let [first, second] = changes.map(|change| self.size(&change));
        let direction = usize::from(second > first);
        Halved {
            panel,
            value: integral + changes[0] + changes[1],
            change: first + second,
            direction,
            halves: halves[direction],
        }
    }

    /// Force and torque on a panel.
    fn integral(&self, panel: &Panel) -> Vector6<f64> {
        let remanence_t = self.body.remanence_t;
        let (c, n) = (self.across, panel.normal);
        let [across, along] = [c, 3 - c - n].map(|k| self.axes.column(k).into_owned());
        let normal = self.axes.column(n) * panel.side;
        let face = normal * (0.5 * self.body.size_m[n]);
        let mut total = Vector6::zeros();
        for (x, wx) in self.rule.points() {
            for (y, wy) in self.rule.points() {
                let r = face
                    + across * (panel.centre[0] + x * panel.half[0])
                    + along * (panel.centre[1] + y * panel.half[1]);
                let b = field_t(self.drive.size_m, self.drive.remanence_t, self.position_m + r);
                let charge = b * (panel.side * remanence_t[n]);
                let current = (normal * across.dot(&b) - across * normal.dot(&b)) * remanence_t[c];
                let f = (charge + current) * (wx * wy);
                let t = r.cross(&f);
                total += Vector6::new(f.x, f.y, f.z, t.x, t.y, t.z);
            }
        }
        total * (panel.half[0] * panel.half[1] / MU_0)
    }

    /// Size of a wrench [N]: its torque counts at half the body's diagonal.
    fn size(&self, wrench: &Vector6<f64>) -> f64 {
        let arm_m = 0.5 * self.body.size_m.norm();
        wrench.fixed_rows::<3>(0).norm() + wrench.fixed_rows::<3>(3).norm() / arm_m
    }
}

/// A part of a face.
#[derive(Clone, Copy)]
struct Panel {
    /// The body's axis that the face is across, and the side of it.
    normal: usize,
    side: f64,
    /// Along the axis across the gap and along the other one [m].
    centre: [f64; 2],
    half: [f64; 2],
}

impl Panel {
    fn halves(self, direction: usize) -> [Self; 2] {
        [-0.5, 0.5].map(|side| {
            let mut part = self;
            part.half[direction] = 0.5 * self.half[direction];
            part.centre[direction] += side * self.half[direction];
            part
        })
    }
}

/// A panel and what halving it changes.
struct Halved {
    panel: Panel,
    /// Force and torque, both changes included.
    value: Vector6<f64>,
    /// Size of the changes.
    change: f64,
    /// The direction of the greater change, and the halves in it.
    direction: usize,
    halves: [Vector6<f64>; 2],
}
