//! One environment whose state a test may set and read freely.

use crate::base::base;
use magworm::internals::lanes::Scalar;
use magworm::internals::{Anchor, Block, Draws, Rod, advance, equations, reset, scene_start};
use magworm::scene::Scene;
use magworm::{Model, StartPose, Status};

/// A rod in free space: edits turn it into what a test needs.
pub const ROD: &str = r#"
gravity_m_s2 = 0.0
[body]
kind = "rod"
length_m = 0.1
width_m = 0.01
thickness_m = 0.004
elements = 20
[material]
youngs_modulus_pa = 100e3
density_kg_m3 = 1000
[magnetic_terms]
mutual = false
[solver]
step_s = 0.001
[control]
step_s = 1.0
episode_s = 10.0
"#;

/// A single rigid foot of `robot` on ground that holds it.
pub const RIGID_FOOT: [(&str, &str); 7] = [
    ("drive", ""),
    ("body.magnets", "1"),
    ("magnet.length_m", "0.014"),
    ("ground.static_friction", "10.0"),
    ("ground.dynamic_friction", "10.0"),
    ("ground.adhesion_n", "0.0"),
    ("control.step_s", "1.0"),
];

/// Both laws of `solver.curvature`, the default first: κ = φ and the paper's κ = 2 tan(φ/2).
pub const CURVATURES: [(&str, &str); 2] = [("'angle'", "κ = φ"), ("'tangent'", "κ = 2 tan(φ/2)")];

/// The scene of a text or preset with fields replaced by values written in TOML; an empty text removes.
pub fn scene(name: &str, edits: &[(&str, &str)]) -> Scene {
    let start =
        if name.contains('\n') { Scene::from_toml(name).expect("a scene") } else { base(name) };
    let values: Vec<(String, Option<toml::Value>)> =
        edits.iter().map(|(path, text)| (path.to_string(), value(text))).collect();
    start.with_values(&values).expect("a valid scene")
}

fn value(text: &str) -> Option<toml::Value> {
    (!text.is_empty()).then(|| text.parse().expect("a TOML value"))
}

/// A number as TOML writes it.
pub fn number(value: f64) -> String {
    format!("{value:e}")
}

/// One environment.
pub struct World {
    pub model: Model,
    pub block: Block<[f64; 1]>,
}

impl World {
    /// A scene in its start pose.
    pub fn new(base: &str, edits: &[(&str, &str)]) -> Self {
        let model = Model::compile(&scene(base, edits)).expect("a model");
        let start = scene_start(&model);
        Self::from_model(model, start)
    }

    /// A scene in a pose of the test's own.
    pub fn started(base: &str, edits: &[(&str, &str)], start: StartPose) -> Self {
        Self::from_model(Model::compile(&scene(base, edits)).expect("a model"), start)
    }

    fn from_model(model: Model, start: StartPose) -> Self {
        let mut block = Block::new(&model);
        let present = model.present();
        let factors = [1.0; Model::PARAMETERS.len()];
        reset(&model, &mut block, 0, start, &factors, &present, Draws::new(0, 0));
        Self { model, block }
    }

    pub fn steps(&mut self, steps: u32) {
        advance(Scalar, &self.model, &mut self.block, steps);
        assert_eq!(self.block.status[0], Status::Running);
    }

    pub fn run(&mut self, seconds: f64) {
        self.steps((seconds / self.model.step_s).round() as u32);
    }

    pub fn node(&self, node: usize) -> [f64; 2] {
        self.block.node_position(&self.model, node, 0).xy().into()
    }

    /// Nodes over a length, from the wall of a clamped rod.
    pub fn shape(&self, length_m: f64) -> Vec<[f64; 2]> {
        let nodes = (1..=self.last()).map(|n| self.node(n));
        nodes.map(|[x, y]| [x / length_m, y / length_m]).collect()
    }

    pub fn last(&self) -> usize {
        self.model.nodes() - 1
    }

    /// Velocity of a node, by rigid motion where it is on a magnet.
    pub fn node_velocity(&self, node: usize) -> [f64; 2] {
        match self.model.coordinates.anchors[node] {
            Anchor::Free { dof } => [self.block.v[dof][0], self.block.v[dof + 1][0]],
            Anchor::Fixed => [0.0; 2],
            Anchor::Rigid { body, .. } => {
                let ([x, y, _], here) =
                    (self.block.planar_pose(&self.model, body, 0), self.node(node));
                let [vx, vy, rate] = self.block.planar_velocity(&self.model, body, 0);
                [vx - rate * (here[1] - y), vy + rate * (here[0] - x)]
            }
        }
    }

    /// The equations of a step in D dimensions, without contact, from the kinematics as they stand.
    pub fn assemble<D: Rod>(&mut self) {
        let (model, block) = (&self.model, &mut self.block);
        equations::inertia::<D, _>(Scalar, model, block);
        equations::gravity::<D, _>(Scalar, model, block);
        equations::magnets::<D, _>(Scalar, model, block);
        equations::springs::<D, _>(Scalar, model, block);
    }

    /// Sets a rigid motion: velocity at the origin and angular velocity.
    pub fn set_motion(&mut self, velocity: [f64; 2], rate: f64) {
        self.set_velocity(|[x, y]| [velocity[0] - rate * y, velocity[1] + rate * x], rate);
    }

    /// Sets the velocity of nodes and magnets from their place, and the magnets' rate.
    pub fn set_velocity(&mut self, field: impl Fn([f64; 2]) -> [f64; 2], rate: f64) {
        let coordinates = &self.model.coordinates;
        let free = coordinates.anchors.iter().filter_map(|anchor| match *anchor {
            Anchor::Free { dof } => Some(dof),
            _ => None,
        });
        for dof in free.chain(coordinates.bodies.iter().copied()) {
            let velocity = field([self.block.q[dof][0], self.block.q[dof + 1][0]]);
            self.block.v[dof][0] = velocity[0];
            self.block.v[dof + 1][0] = velocity[1];
        }
        for &dof in &coordinates.bodies {
            self.block.v[dof + 2][0] = rate;
        }
    }

    /// Total mass [kg], centre of mass [m].
    pub fn mass_and_centre(&self) -> (f64, [f64; 2]) {
        let (mut mass, mut moment) = (0.0, [0.0; 2]);
        for &(dof, axis) in &self.model.translations {
            let m = self.block.mass[dof][0];
            moment[axis] += m * self.block.q[dof][0];
            mass += 0.5 * m;
        }
        (mass, moment.map(|x| x / mass))
    }

    /// Momentum [kg·m/s] and angular momentum about the origin [kg·m²/s].
    pub fn momenta(&self) -> ([f64; 2], f64) {
        let (mut linear, mut angular) = ([0.0; 2], 0.0);
        for &(dof, axis) in &self.model.translations {
            let p = self.block.mass[dof][0] * self.block.v[dof][0];
            linear[axis] += p;
            angular += if axis == 0 {
                -p * self.block.q[dof + 1][0]
            } else {
                p * self.block.q[dof - 1][0]
            };
        }
        for &dof in &self.model.coordinates.bodies {
            angular += self.block.mass[dof + 2][0] * self.block.v[dof + 2][0];
        }
        (linear, angular)
    }

    /// Kinetic energy [J].
    pub fn kinetic(&self) -> f64 {
        let energy = |(m, v): (&[f64; 1], &[f64; 1])| 0.5 * m[0] * v[0] * v[0];
        self.block.mass.iter().zip(self.block.v.iter()).map(energy).sum()
    }

    /// Mean velocity of the centre of mass [m/s].
    pub fn drift(&self) -> [f64; 2] {
        let mass = self.mass_and_centre().0;
        self.momenta().0.map(|p| p / mass)
    }

    /// Sum of the normal impulses of the last step over the step [N].
    pub fn normal_force(&self) -> f64 {
        self.block.normal_impulse.iter().map(|row| row[0]).sum::<f64>() / self.model.step_s
    }

    /// Greatest speed of a node along an axis [m/s].
    pub fn fastest(&self, axis: usize) -> f64 {
        (0..=self.last()).map(|n| self.node_velocity(n)[axis].abs()).fold(0.0, f64::max)
    }
}
