//! What a test sets and reads of a world in space.

use crate::world::World;
use magworm::internals::lanes::{Scalar, Space};
use magworm::internals::{Anchor, kinematics};
use nalgebra::Vector3;

/// A vector along x, y, z.
pub type Vector = Vector3<f64>;

fn vector(rows: &[[f64; 1]], first: usize) -> Vector {
    Vector::new(rows[first][0], rows[first + 1][0], rows[first + 2][0])
}

fn put(rows: &mut [[f64; 1]], first: usize, value: Vector) {
    (0..3).for_each(|axis| rows[first + axis][0] = value[axis]);
}

impl World {
    /// Place of a node [m].
    pub fn place(&self, node: usize) -> Vector {
        self.block.node_position(&self.model, node, 0)
    }

    /// Places of all nodes [m].
    pub fn places(&self) -> Vec<Vector> {
        (0..=self.last()).map(|node| self.place(node)).collect()
    }

    /// Brings frames and tangents up to date with the nodes, as the next step would.
    pub fn refresh(&mut self) {
        // Frames of an environment that does not run stay as they are.
        self.block.running[0][0] = 1.0;
        kinematics::<Space, _>(Scalar, &self.model, &mut self.block);
    }

    /// Up direction of an element.
    pub fn up(&self, element: usize) -> Vector {
        vector(&self.block.director, 6 * element)
    }

    /// Tangent that the frame of an element was last brought to.
    pub fn frame_tangent(&self, element: usize) -> Vector {
        vector(&self.block.director, 6 * element + 3)
    }

    /// Direction of an element from node to node.
    pub fn tangent(&self, element: usize) -> Vector {
        (self.place(element + 1) - self.place(element)).normalize()
    }

    pub fn set_frame(&mut self, element: usize, up: Vector, tangent: Vector) {
        put(&mut self.block.director, 6 * element, up);
        put(&mut self.block.director, 6 * element + 3, tangent);
    }

    /// Turns all frames about their tangents, the clamped one's as well [rad].
    pub fn roll(&mut self, angle: f64) {
        for element in 0..self.last() {
            let (up, tangent) = (self.up(element), self.frame_tangent(element));
            let rolled = up * angle.cos() + tangent.cross(&up) * angle.sin();
            self.set_frame(element, rolled, tangent);
        }
    }

    /// Sets the velocity of nodes and magnets from their place, and one angular velocity for all.
    pub fn set_flow(&mut self, field: impl Fn(Vector) -> Vector, rate: Vector) {
        let dofs: Vec<usize> = self.carriers().collect();
        for dof in dofs {
            let velocity = field(vector(&self.block.q, dof));
            put(&mut self.block.v, dof, velocity);
        }
        for &dof in &self.model.coordinates.bodies {
            put(&mut self.block.v, dof + 3, rate);
        }
        for element in 0..self.last() {
            if let Some(dof) = self.model.coordinates.twists[element] {
                self.block.v[dof][0] = self.tangent(element).dot(&rate);
            }
        }
    }

    /// First unknown of everything that has a mass and a place: free nodes, then magnets.
    pub fn carriers(&self) -> impl Iterator<Item = usize> + '_ {
        let free = self.model.coordinates.anchors.iter().filter_map(|anchor| match *anchor {
            Anchor::Free { dof } => Some(dof),
            _ => None,
        });
        free.chain(self.model.coordinates.bodies.iter().copied())
    }

    /// Mass [kg] and place of the centre of mass [m].
    pub fn centre(&self) -> (f64, Vector) {
        let (mut mass, mut moment) = (0.0, Vector::zeros());
        for dof in self.carriers() {
            let m = self.block.mass[dof][0];
            mass += m;
            moment += vector(&self.block.q, dof) * m;
        }
        (mass, moment / mass)
    }

    /// Angular momentum of a magnet about its own centre [kg·m²/s].
    fn spin(&self, body: usize) -> Vector {
        let (dof, element) = (self.model.coordinates.bodies[body], self.model.bodies[body].element);
        let (up, tangent) = (self.up(element), self.frame_tangent(element));
        let rate = vector(&self.block.v, dof + 3);
        let axes = [tangent, up, tangent.cross(&up)];
        (0..3).map(|k| axes[k] * (axes[k].dot(&rate) * self.block.mass[dof + 3 + k][0])).sum()
    }

    /// Momentum [kg·m/s] and angular momentum about the origin [kg·m²/s]: of the nodes and magnets, of the magnets'
    /// rotation, and of the elements' about their tangents.
    pub fn momenta_in_space(&self) -> (Vector, Vector) {
        let (mut linear, mut angular) = (Vector::zeros(), Vector::zeros());
        for dof in self.carriers() {
            let p = vector(&self.block.v, dof) * self.block.mass[dof][0];
            linear += p;
            angular += vector(&self.block.q, dof).cross(&p);
        }
        for body in 0..self.model.magnets() {
            angular += self.spin(body);
        }
        for element in 0..self.last() {
            if let Some(dof) = self.model.coordinates.twists[element] {
                let spin = self.block.mass[dof][0] * self.block.v[dof][0];
                angular += self.tangent(element) * spin;
            }
        }
        (linear, angular)
    }

    /// Kinetic energy [J].
    pub fn kinetic_in_space(&self) -> f64 {
        let moving = self
            .carriers()
            .map(|dof| 0.5 * self.block.mass[dof][0] * vector(&self.block.v, dof).norm_squared());
        let turning = (0..self.model.magnets()).map(|body| {
            let dof = self.model.coordinates.bodies[body];
            0.5 * vector(&self.block.v, dof + 3).dot(&self.spin(body))
        });
        let twisting = self.model.coordinates.twists.iter().flatten();
        let twisting =
            twisting.map(|&dof| 0.5 * self.block.mass[dof][0] * self.block.v[dof][0].powi(2));
        moving.sum::<f64>() + turning.sum::<f64>() + twisting.sum::<f64>()
    }

    /// Mean velocity of the centre of mass [m/s].
    pub fn drift_in_space(&self) -> Vector {
        self.momenta_in_space().0 / self.centre().0
    }

    /// Greatest speed of anything with a place [m/s], and of a rotation [rad/s].
    pub fn quickest(&self) -> (f64, f64) {
        let speeds = self.carriers().map(|dof| vector(&self.block.v, dof).norm());
        let rates =
            self.model.coordinates.bodies.iter().map(|dof| vector(&self.block.v, dof + 3).norm());
        let twists = self.model.coordinates.twists.iter().flatten();
        let twists = twists.map(|&dof| self.block.v[dof][0].abs());
        (speeds.fold(0.0, f64::max), rates.chain(twists).fold(0.0, f64::max))
    }

    /// Runs until nothing moves.
    pub fn come_to_rest(&mut self) {
        for _ in 0..400 {
            self.steps(50);
            let (speed, rate) = self.quickest();
            if speed < 1e-10 && rate < 1e-8 {
                return;
            }
        }
        panic!("still moving: {:?}", self.quickest());
    }
}
