//! Scenes that start bent, and one robot of such a scene.

use crate::base::base;
use magworm::internals::lanes::{Plane, Scalar, Space};
use magworm::internals::{Block, Draws, advance, kinematics, reset, scene_start};
use magworm::scene::Scene;
use magworm::{Model, StartPose, Status};
use nalgebra::Vector3;

pub type Vector = Vector3<f64>;
pub type Edits<'a> = [(&'a str, &'a str)];

/// A free rod of twelve elements without weight.
pub const ROD: &Edits<'_> =
    &[("body.clamp", "'none'"), ("body.elements", "12"), ("gravity_m_s2", "0")];
pub const SPACE: (&str, &str) = ("dimensions", "3");
pub const MANY: (&str, &str) = ("start.bends_deg", "[30, -200, 0, 120, 65.5]");
pub const ASIDE: (&str, &str) = ("start.bends_aside_deg", "[100, -10, -90]");
pub const TWISTS: (&str, &str) = ("start.twists_deg", "[-50, 300]");

pub fn scene(preset: &str, edits: &[&Edits<'_>]) -> Scene {
    let value = |text: &str| Some(text.parse().expect("a TOML value"));
    let edits: Vec<_> =
        edits.concat().iter().map(|(path, text)| (path.to_string(), value(text))).collect();
    base(preset).with_values(&edits).expect("a valid scene")
}

/// Bodies with many elements, with magnets, with a clamp; under reduced coordinates and under multipliers.
pub const BODIES: &[(&str, &Edits<'static>)] = &[
    ("cantilever", ROD),
    ("cantilever", &[]),
    (
        "cantilever",
        &[
            (
                "magnet",
                "{ length_m = 0.005, width_m = 0.005, height_m = 0.003, remanence_t = 1, density_kg_m3 = 7500 }",
            ),
            (
                "body.magnets",
                "[{ position_m = 0.02, polarity = 1 }, { position_m = 0.0515, polarity = -1 }]",
            ),
        ],
    ),
    ("robot-4", &[]),
    (
        "robot",
        &[
            ("solver.integrator", "'explicit'"),
            ("solver.step_s", "1e-7"),
            ("control.step_s", "1e-3"),
        ],
    ),
];

pub struct World {
    pub model: Model,
    pub block: Block<[f64; 1]>,
}

impl World {
    pub fn new(preset: &str, edits: &[&Edits<'_>]) -> Self {
        let model = Model::compile(&scene(preset, edits)).expect("a model");
        let pose = scene_start(&model);
        Self::started(model, pose)
    }

    pub fn started(model: Model, pose: StartPose) -> Self {
        let mut block = Block::new(&model);
        let present = vec![true; model.magnets()];
        let factors = [1.0; Model::PARAMETERS.len()];
        reset(&model, &mut block, 0, pose, &factors, &present, Draws::new(0, 0));
        Self { model, block }
    }

    /// Brings tangents and frames up to date, as the first step would.
    pub fn refresh(&mut self) {
        self.block.running[0][0] = 1.0;
        match self.model.dimensions() {
            2 => kinematics::<Plane, _>(Scalar, &self.model, &mut self.block),
            _ => kinematics::<Space, _>(Scalar, &self.model, &mut self.block),
        }
    }

    pub fn elements(&self) -> usize {
        self.model.nodes() - 1
    }

    pub fn place(&self, node: usize) -> Vector {
        self.block.node_position(&self.model, node, 0)
    }

    pub fn tail(&self) -> Vector {
        self.place(self.elements())
    }

    pub fn tangent(&self, element: usize) -> Vector {
        (self.place(element + 1) - self.place(element)).normalize()
    }

    pub fn frame(&self, element: usize, first: usize) -> Vector {
        Vector::from_fn(|axis, _| self.block.director[6 * element + first + axis][0])
    }

    pub fn up(&self, element: usize) -> Vector {
        self.frame(element, 0)
    }

    /// κ₁, κ₂, τ at the node after an element, as Bergou (2010) defines them, for κ = φ. In the plane κ₁ alone.
    pub fn strains(&self, e: usize) -> [f64; 3] {
        let (te, tf) = (self.tangent(e), self.tangent(e + 1));
        let chi = 1.0 + te.dot(&tf);
        let binormal = te.cross(&tf) * (2.0 / chi);
        let tangent_half = 0.5 * binormal.norm();
        let factor = if tangent_half > 1e-9 { tangent_half.atan() / tangent_half } else { 1.0 };
        if self.model.dimensions() == 2 {
            return [binormal.z * factor, 0.0, 0.0];
        }
        let (ue, uf) = (self.up(e), self.up(e + 1));
        let (se, sf) = (te.cross(&ue), tf.cross(&uf));
        let carried = ue - (te + tf) * (ue.dot(&tf) / chi);
        [
            0.5 * factor * binormal.dot(&(se + sf)),
            -0.5 * factor * binormal.dot(&(ue + uf)),
            carried.cross(&uf).dot(&tf).atan2(carried.dot(&uf)),
        ]
    }

    pub fn all_strains(&self) -> Vec<[f64; 3]> {
        (0..self.elements() - 1).map(|element| self.strains(element)).collect()
    }

    pub fn bits(&self) -> Vec<u64> {
        let rows = self.block.state_rows();
        rows.iter().flat_map(|rows| rows.iter().map(|row| row[0].to_bits())).collect()
    }

    pub fn runs(&mut self, steps: u32) {
        advance(Scalar, &self.model, &mut self.block, steps);
        assert_eq!(self.block.status[0], Status::Running);
    }
}
