//! Generalised forces and matrices in space against finite differences of an energy written down here.

use crate::report::Case;
use crate::space_frames::carried;
use crate::space_world::Vector;
use crate::world::{ROD, World};
use magworm::internals::Anchor;
use magworm::internals::lanes::Space;
use magworm::scene::Curvature;
use nalgebra::{DMatrix, DVector, Rotation3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::cell::RefCell;

/// Node places and up directions of the elements.
#[derive(Clone)]
struct Shape {
    place: Vec<Vector>,
    up: Vec<Vector>,
}

/// A strain s, its stiffness k (E = Σ ½ k s²) and the element that it stretches.
struct Strain {
    value: f64,
    stiffness: f64,
    element: Option<usize>,
}

impl Shape {
    fn of(world: &World) -> Self {
        let up = (0..world.last()).map(|e| world.up(e)).collect();
        Self { place: world.places(), up }
    }

    fn tangent(&self, e: usize) -> Vector {
        (self.place[e + 1] - self.place[e]).normalize()
    }

    /// Moves along one unknown. The frames of soft elements follow their tangents by parallel transport.
    fn moved(&self, world: &World, dof: usize, by: f64) -> Self {
        let coordinates = &world.model.coordinates;
        let mut after = self.clone();
        for (node, anchor) in coordinates.anchors.iter().enumerate() {
            match *anchor {
                Anchor::Free { dof: first } if (first..first + 3).contains(&dof) => {
                    after.place[node][dof - first] += by;
                }
                Anchor::Rigid { body, side } => {
                    let first = coordinates.bodies[body];
                    let e = world.model.bodies[body].element;
                    let arm = self.tangent(e)
                        * (f64::from(side) * world.model.bodies[body].half_length_m);
                    let motion = dof.checked_sub(first).filter(|k| *k < 6);
                    match motion {
                        Some(k) if k < 3 => after.place[node][k] += by,
                        Some(k) => {
                            let turn = Rotation3::new(Vector::ith(k - 3, by));
                            after.place[node] += turn * arm - arm;
                            after.up[e] = turn * self.up[e];
                        }
                        None => {}
                    }
                }
                _ => {}
            }
        }
        for e in 0..self.up.len() {
            if coordinates.rigid[e].is_none() {
                after.up[e] = carried(self.up[e], self.tangent(e), after.tangent(e));
            }
            if coordinates.twists[e] == Some(dof) {
                after.up[e] = Rotation3::new(self.tangent(e) * by) * self.up[e];
            }
        }
        after
    }

    /// Δl with EA/l; the turn φ (or 2 tan ½φ) from one element to the next about the mean of their sides, and of their
    /// ups, with half elements in series; and the angle about t_f from u_e, carried over, to u_f.
    fn strains(&self, world: &World) -> Vec<Strain> {
        let (mesh, scene) = (&world.model.mesh, &world.model.scene);
        let modulus = scene.material.youngs_modulus_pa;
        let shear = modulus / (2.0 * (1.0 + scene.material.poisson_ratio));
        let rest = |e: usize| mesh.arc_m[e + 1] - mesh.arc_m[e];
        let soft = |e: usize| mesh.elements[e].body.is_none();
        let mut out = Vec::new();
        for e in (0..self.up.len()).filter(|&e| soft(e) && e + 2 > mesh.fixed_nodes) {
            let value = (self.place[e + 1] - self.place[e]).norm() - rest(e);
            let stiffness =
                modulus * mesh.elements[e].width_m * mesh.elements[e].thickness_m / rest(e);
            out.push(Strain { value, stiffness, element: Some(e) });
        }
        let series = |node: usize, rigidity: &dyn Fn(f64, f64) -> f64| {
            let half = |e: usize| match soft(e) {
                true => {
                    0.5 * rest(e) / rigidity(mesh.elements[e].thickness_m, mesh.elements[e].width_m)
                }
                false => 0.0,
            };
            1.0 / (half(node - 1) + half(node))
        };
        for node in 1..self.up.len() {
            let (te, tf) = (self.tangent(node - 1), self.tangent(node));
            let (ue, uf) = (self.up[node - 1], self.up[node]);
            let axis = te.cross(&tf);
            let phi = axis.norm().atan2(te.dot(&tf));
            let size = match scene.solver.curvature {
                Curvature::Angle => phi,
                Curvature::Tangent => 2.0 * (0.5 * phi).tan(),
            };
            let turn = axis.normalize() * size;
            let carried_up = carried(ue, te, tf);
            let twist = tf.dot(&carried_up.cross(&uf)).atan2(carried_up.dot(&uf));
            let values = [
                turn.dot(&(te.cross(&ue) + tf.cross(&uf))) / 2.0,
                -turn.dot(&(ue + uf)) / 2.0,
                twist,
            ];
            let stiffness = [
                series(node, &|h, w| modulus * w * h.powi(3) / 12.0),
                series(node, &|h, w| modulus * h * w.powi(3) / 12.0),
                series(node, &|h, w| {
                    let (long, short) = (w.max(h), w.min(h));
                    let ratio = short / long;
                    let form = 1.0 / 3.0 - 0.21 * ratio * (1.0 - ratio.powi(4) / 12.0);
                    shear * long * short.powi(3) * form
                }),
            ];
            for (value, stiffness) in values.into_iter().zip(stiffness) {
                out.push(Strain { value, stiffness, element: None });
            }
        }
        out
    }
}

/// Elastic energy of a world as it stands [J].
pub fn elastic_energy(world: &World) -> f64 {
    let strains = Shape::of(world).strains(world);
    strains.iter().map(|s| 0.5 * s.stiffness * s.value * s.value).sum()
}

/// Central difference over every unknown of numbers of a shape.
fn differences(world: &World, numbers: impl Fn(&Shape) -> Vec<f64>) -> Vec<DVector<f64>> {
    let (shape, step) = (Shape::of(world), 1e-7);
    let count = world.model.coordinates.count;
    let mut out = vec![DVector::zeros(count); numbers(&shape).len()];
    for dof in 0..count {
        let [up, down] = [step, -step].map(|by| numbers(&shape.moved(world, dof, by)));
        for (row, (up, down)) in out.iter_mut().zip(up.into_iter().zip(down)) {
            row[dof] = (up - down) / (2.0 * step);
        }
    }
    out
}

fn gradients(world: &World) -> Vec<DVector<f64>> {
    differences(world, |shape| shape.strains(world).iter().map(|s| s.value).collect())
}

/// Names and edits: free and clamped rods, with magnets of which two leave a node between them, and the robot.
fn bodies() -> Vec<(&'static str, Vec<(&'static str, &'static str)>)> {
    let magnet = "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}";
    let close = "[{position_m=0.03,polarity=1},{position_m=0.0403,polarity=-1}]";
    let magnets = vec![("magnet", magnet), ("body.magnets", close)];
    let clamped = [&magnets[..], &[("body.clamp", "'head'")]].concat();
    let tangent = [&magnets[..], &[("solver.curvature", "'tangent'")]].concat();
    let robot = vec![("gravity_m_s2", "0.0"), ("ground", ""), ("drive", "")];
    vec![
        (ROD, vec![]),
        (ROD, vec![("body.clamp", "'head'"), ("solver.curvature", "'tangent'")]),
        (ROD, magnets),
        (ROD, clamped),
        (ROD, tangent),
        ("robot", robot),
    ]
}

/// A body bent, stretched and twisted at random by numbers in [−1, 1].
fn bent(body: usize, random: &[f64]) -> World {
    let (base, edits) = &bodies()[body];
    let mut all = vec![("dimensions", "3"), ("material.damping_time_s", "0.003")];
    all.extend_from_slice(edits);
    let mut world = World::new(base, &all);
    let mut next = random.iter().copied().cycle();
    let mut draw = || next.next().expect("numbers");
    let dofs: Vec<usize> = world.carriers().collect();
    for dof in dofs {
        for axis in 0..3 {
            world.block.q[dof + axis][0] += 6e-4 * draw();
        }
    }
    for body in world.model.bodies.clone() {
        let turn = Rotation3::new(Vector::from_fn(|_, _| 0.4 * draw()));
        let (up, tangent) = (world.up(body.element), world.frame_tangent(body.element));
        world.set_frame(body.element, turn * up, turn * tangent);
    }
    world.refresh();
    for element in 0..world.last() {
        if world.model.coordinates.rigid[element].is_none() {
            let (up, tangent) = (world.up(element), world.frame_tangent(element));
            world.set_frame(element, Rotation3::new(tangent * draw()) * up, tangent);
        }
    }
    world.refresh();
    world
}

/// The matrix of the implicit step, dense.
fn expected_matrix(world: &World, strains: &[Strain], gradients: &[DVector<f64>]) -> DMatrix<f64> {
    let (dt, tau) = (world.model.step_s, world.model.scene.material.damping_time_s);
    let masses: Vec<f64> = world.block.mass.iter().map(|m| m[0]).collect();
    let mut matrix = DMatrix::from_diagonal(&DVector::from_vec(masses));
    for (body, &dof) in world.model.coordinates.bodies.iter().enumerate() {
        let pose = world.block.magnet_pose(&world.model, body, 0).orientation;
        let axes = pose.to_rotation_matrix().into_inner();
        let moments = Vector::from_fn(|k, _| world.block.mass[dof + 3 + k][0]);
        let inertia = axes * nalgebra::Matrix3::from_diagonal(&moments) * axes.transpose();
        matrix.view_mut((dof + 3, dof + 3), (3, 3)).copy_from(&inertia);
    }
    let shape = Shape::of(world);
    for (strain, gradient) in strains.iter().zip(gradients) {
        matrix += gradient * gradient.transpose() * (dt * (0.5 * dt + tau) * strain.stiffness);
        let Some(e) = strain.element.filter(|_| strain.value > 0.0) else { continue };
        let edge = shape.place[e + 1] - shape.place[e];
        // Any two normals: only their projector counts.
        let first = edge.cross(&Vector::new(0.3, 0.5, 0.8)).normalize();
        let second = edge.cross(&first).normalize();
        let across = differences(world, |shape| {
            let edge = shape.place[e + 1] - shape.place[e];
            vec![first.dot(&edge), second.dot(&edge)]
        });
        for n in across {
            matrix += &n
                * n.transpose()
                * (0.51 * dt * dt * strain.stiffness * strain.value / edge.norm());
        }
    }
    matrix
}

/// Errors of the forces and of the matrix of one body, as parts of the largest force and of the diagonal.
fn errors(mut world: World) -> [f64; 2] {
    world.assemble::<Space>();
    let (strains, gradients) = (Shape::of(&world).strains(&world), gradients(&world));
    let count = world.model.coordinates.count;
    let mut expected = DVector::zeros(count);
    for (strain, gradient) in strains.iter().zip(&gradients) {
        expected -= gradient * (strain.stiffness * strain.value);
    }
    let dt = world.model.step_s;
    let force = DVector::from_iterator(count, world.block.rhs.iter().map(|r| r[0] / dt));
    let matrix = expected_matrix(&world, &strains, &gradients);
    let mut off = 0.0f64;
    for (row, column) in (0..count).flat_map(|r| (0..=r).map(move |c| (r, c))) {
        let place = world.model.system.find(row, column);
        let entry = place.map_or(0.0, |place| world.block.matrix[place][0]);
        let scale = (matrix[(row, row)] * matrix[(column, column)]).sqrt();
        off = off.max((entry - matrix[(row, column)]).abs() / scale);
    }
    [(&force - &expected).amax() / expected.amax(), off]
}

/// −∂E/∂q and M + Δt (½ Δt + τ) Σ k g gᵀ + 0.51 Δt² Σ (T/|e|)(I − t tᵀ) of random bent, stretched and twisted bodies. Central
/// differences of 1e-7 leave 1e-9 of the strains' scale; any wrong term would be of order one.
#[test]
fn validates_space_derivatives() {
    let found = RefCell::new((Vec::new(), Vec::new()));
    let mut runner = TestRunner::new_with_rng(
        Config { cases: 40, max_shrink_iters: 0, failure_persistence: None, ..Config::default() },
        proptest::test_runner::TestRng::deterministic_rng(
            proptest::test_runner::RngAlgorithm::ChaCha,
        ),
    );
    let strategy = (0..bodies().len(), prop::collection::vec(-1.0..1.0f64, 97));
    runner
        .run(&strategy, |(body, random)| {
            let [force, matrix] = errors(bent(body, &random));
            let mut found = found.borrow_mut();
            found.0.push(force);
            found.1.push(matrix);
            prop_assert!(force < 1e-7 && matrix < 1e-7, "body {body}: {force:e}, {matrix:e}");
            Ok(())
        })
        .expect("forces and matrices of random shapes");
    let mut case = Case::new("space_derivatives", "Forces and matrix of the implicit step in space")
        .equation(
            "F = −∂E/∂q, E = Σ ½ k s²; A = M + Δt (½ Δt + τ) Σ k g gᵀ + 0.51 Δt² Σ (T/|e|)(I − t tᵀ) over elements \
            in tension",
        )
        .source("Central differences of the energy written down in the test from positions and frames")
        .scene(ROD, &[("dimensions", "3"), ("material.damping_time_s", "0.003")])
        .note(
            "Rods and the three-magnet robot, free and clamped, with both laws of curvature, their nodes off by \
            up to 0.6 mm, magnets turned by 0.4 rad and elements rolled by 1 rad, at random. When a node moves, \
            the frames of its elements follow by parallel transport.",
        );
    let (forces, matrices) = found.into_inner();
    case.spread("forces", "of the largest", &forces, 1e-7);
    case.spread("entries of the matrix", "of the diagonal", &matrices, 1e-7);
    case.finish();
}
