//! Generalised forces and matrices against finite differences of an energy written down here.

use crate::world::{ROD, World, scene};
use magworm::Model;
use magworm::internals::lanes::{Plane, Scalar};
use magworm::internals::{Anchor, kinematics};
use magworm::scene::{Curvature, Scene};
use nalgebra::{DMatrix, DVector};

/// A strain s, its stiffness k (E = Σ ½ k s²) and whether it is a stretch.
struct Strain {
    value: f64,
    stiffness: f64,
    axial: bool,
}

/// The rod as the mesh cuts it: lengths, thicknesses, which elements are rigid.
pub struct Cut<'a> {
    model: &'a Model,
    scene: &'a Scene,
}

impl Cut<'_> {
    /// Strains of given node positions: Δl with EA/l, and φ or 2 tan(φ/2) with φ from atan2 and two half
    /// elements in series, 1/(l⁻/2EI⁻ + l⁺/2EI⁺).
    fn strains(&self, node: &[[f64; 2]]) -> Vec<Strain> {
        let mesh = &self.model.mesh;
        let modulus = self.scene.material.youngs_modulus_pa;
        let rest = |e: usize| mesh.arc_m[e + 1] - mesh.arc_m[e];
        let edge = |e: usize| [node[e + 1][0] - node[e][0], node[e + 1][1] - node[e][1]];
        let soft = |e: &usize| mesh.elements[*e].body.is_none();
        let mut out = Vec::new();
        for e in (0..mesh.elements.len()).filter(soft) {
            let area = mesh.elements[e].width_m * mesh.elements[e].thickness_m;
            let value = edge(e)[0].hypot(edge(e)[1]) - rest(e);
            out.push(Strain { value, stiffness: modulus * area / rest(e), axial: true });
        }
        for i in 1..mesh.elements.len() {
            let (a, b) = (edge(i - 1), edge(i));
            let turn = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
            let half = |e: usize| match mesh.elements[e].body {
                Some(_) => 0.0,
                None => {
                    let section = mesh.elements[e];
                    6.0 * rest(e) / (modulus * section.width_m * section.thickness_m.powi(3))
                }
            };
            let stiffness = 1.0 / (half(i - 1) + half(i));
            let value = match self.scene.solver.curvature {
                Curvature::Angle => turn,
                Curvature::Tangent => 2.0 * (0.5 * turn).tan(),
            };
            out.push(Strain { value, stiffness, axial: false });
        }
        out
    }
}

/// Node positions from unknowns, independently of the simulator's kinematics.
fn nodes(world: &World, q: &[f64]) -> Vec<[f64; 2]> {
    let coordinates = &world.model.coordinates;
    coordinates
        .anchors
        .iter()
        .enumerate()
        .map(|(node, anchor)| match *anchor {
            Anchor::Free { dof } => [q[dof], q[dof + 1]],
            Anchor::Rigid { body, side } => {
                let dof = coordinates.bodies[body];
                let arm = f64::from(side) * world.model.bodies[body].half_length_m;
                [q[dof] + arm * q[dof + 2].cos(), q[dof + 1] + arm * q[dof + 2].sin()]
            }
            Anchor::Fixed => [
                world.block.fixed_position[2 * node][0],
                world.block.fixed_position[2 * node + 1][0],
            ],
        })
        .collect()
}

fn unknowns(world: &World) -> Vec<f64> {
    world.block.q.iter().map(|row| row[0]).collect()
}

fn strains(world: &World, q: &[f64]) -> Vec<Strain> {
    Cut { model: &world.model, scene: &world.model.scene }.strains(&nodes(world, q))
}

/// Elastic energy of a world as it stands [J].
pub fn energy_of_world(world: &World) -> f64 {
    strains(world, &unknowns(world)).iter().map(|s| 0.5 * s.stiffness * s.value * s.value).sum()
}

/// ∂s/∂q of every strain by central differences.
fn gradients(world: &World, q: &[f64]) -> Vec<DVector<f64>> {
    let step = 1e-7;
    let values = |q: &[f64]| -> Vec<f64> { strains(world, q).iter().map(|s| s.value).collect() };
    let mut out = vec![DVector::zeros(q.len()); values(q).len()];
    for k in 0..q.len() {
        let moved = |by: f64| {
            let mut moved = q.to_vec();
            moved[k] += by;
            values(&moved)
        };
        for (gradient, (up, down)) in out.iter_mut().zip(moved(step).into_iter().zip(moved(-step)))
        {
            gradient[k] = (up - down) / (2.0 * step);
        }
    }
    out
}

/// A worm whose feet hold magnets, and rods, clamped or not, bent strongly.
fn bodies() -> Vec<(&'static str, World)> {
    let still = [
        ("gravity_m_s2", "0.0"),
        ("ground", ""),
        ("drive", ""),
        ("material.damping_time_s", "0.0"),
    ];
    let magnets = [
        (
            "magnet",
            "{length_m=8e-3,width_m=0.008,height_m=0.002,remanence_t=1.22,density_kg_m3=7500}",
        ),
        ("body.magnets", "[{position_m=0.025,polarity=1},{position_m=0.096,polarity=-1}]"),
    ];
    let clamped = [magnets[0], magnets[1], ("body.clamp", "'head'")];
    vec![
        ("rod", World::new(ROD, &[])),
        ("rod with κ = 2 tan(φ/2)", World::new(ROD, &[("solver.curvature", "'tangent'")])),
        ("rod with magnets", World::new(ROD, &magnets)),
        ("clamped rod with magnets", World::new(ROD, &clamped)),
        ("robot", World::new("robot", &still)),
    ]
}

fn bend(world: &mut World) {
    for k in 0..world.model.coordinates.count {
        // Up to 0.4 mm and 0.4 rad: elements of 2 to 5 mm turn and stretch visibly.
        let body = world.model.coordinates.bodies.iter().any(|&dof| dof + 2 == k);
        let size = if body { 0.4 } else { 4e-4 };
        world.block.q[k][0] += size * (0.7 + 2.3 * k as f64).sin();
    }
}

/// −∂E/∂q of the energy above against the impulse of one step from rest, over Δt. Central differences of 1e-7
/// leave 1e-16/1e-7 = 1e-9 of the strains' scale: 1e-6 of the largest force is safe and any wrong
/// term would be of order one.
#[test]
fn validates_elastic_forces() {
    for (name, mut world) in bodies() {
        bend(&mut world);
        let q = unknowns(&world);
        kinematics::<Plane, _>(Scalar, &world.model, &mut world.block);
        world.assemble::<Plane>();
        let mut expected = DVector::zeros(q.len());
        for (strain, gradient) in strains(&world, &q).iter().zip(gradients(&world, &q)) {
            expected -= gradient * (strain.stiffness * strain.value);
        }
        let force = DVector::from_iterator(
            q.len(),
            world.block.rhs.iter().map(|r| r[0] / world.model.step_s),
        );
        let error = (&force - &expected).amax() / expected.amax();
        println!("elastic forces of {name}: error {error:.1e} of {:.2e} N", expected.amax());
        assert!(error < 1e-6);
    }
}

/// The equations of a step of Newmark's scheme from any velocities, from finite differences and dense: the matrix
/// M + Δt (τ + ½ Δt) Σ k g gᵀ + Δt² (0.01 + ½) Σ (T/|e|) n nᵀ over elements in tension; the right-hand side, where both
/// sums stand with ½ Δt² and the velocity of the springs; and the solution, by a dense factorisation, against one step.
#[test]
fn validates_implicit_step() {
    for (name, mut world) in bodies() {
        bend(&mut world);
        world.model.scene.material.damping_time_s = 3e-3;
        let (q, dt) = (unknowns(&world), world.model.step_s);
        for k in 0..q.len() {
            world.block.v[k][0] = 0.1 * (1.3 + 3.1 * k as f64).sin();
            world.block.spring_velocity[k][0] = 0.1 * (0.7 + 2.3 * k as f64).sin();
        }
        kinematics::<Plane, _>(Scalar, &world.model, &mut world.block);
        world.assemble::<Plane>();
        let matrix = expected_matrix(&world, &q, [3e-3 + 0.5 * dt, 0.51 * dt]);
        let taken_back = expected_matrix(&world, &q, [0.5 * dt, 0.5 * dt]);
        let masses = expected_matrix(&world, &q, [0.0; 2]);
        let v = DVector::from_iterator(q.len(), world.block.v.iter().map(|v| v[0]));
        let of_springs =
            DVector::from_iterator(q.len(), world.block.spring_velocity.iter().map(|v| v[0]));
        let mut balance = &masses * v + (taken_back - &masses) * of_springs;
        for (strain, gradient) in strains(&world, &q).iter().zip(gradients(&world, &q)) {
            balance -= gradient * (dt * strain.stiffness * strain.value);
        }
        let mut error = 0.0f64;
        for (row, column) in (0..q.len()).flat_map(|r| (0..=r).map(move |c| (r, c))) {
            let place = world.model.system.find(row, column);
            let entry = place.map_or(0.0, |place| world.block.matrix[place][0]);
            let scale = (matrix[(row, row)] * matrix[(column, column)]).sqrt();
            error = error.max((entry - matrix[(row, column)]).abs() / scale);
        }
        let rhs = DVector::from_iterator(q.len(), world.block.rhs.iter().map(|r| r[0]));
        let unbalanced = (&rhs - &balance).amax() / balance.amax();
        let expected = matrix.lu().solve(&rhs).expect("regular");
        world.steps(1);
        let solved = DVector::from_iterator(q.len(), world.block.v.iter().map(|v| v[0]));
        let off = (&solved - &expected).amax() / expected.amax();
        println!(
            "implicit step of {name}: matrix {error:.1e}, right-hand side {unbalanced:.1e}, velocities {off:.1e}"
        );
        // Finite differences leave 1e-8; the solution may lose the condition number, about 1e3.
        assert!(error < 1e-6 && unbalanced < 1e-6 && off < 1e-5);
    }
}

/// M + Δt t Σ k g gᵀ + Δt t' Σ (T/|e|) n nᵀ for the two times t, t'.
fn expected_matrix(world: &World, q: &[f64], [spring_s, geometric_s]: [f64; 2]) -> DMatrix<f64> {
    let dt = world.model.step_s;
    let masses: Vec<f64> = world.block.mass.iter().map(|m| m[0]).collect();
    let mut matrix = DMatrix::from_diagonal(&DVector::from_vec(masses));
    let place = nodes(world, q);
    let soft: Vec<usize> =
        (0..place.len() - 1).filter(|&e| world.model.mesh.elements[e].body.is_none()).collect();
    for (index, (strain, gradient)) in strains(world, q).iter().zip(gradients(world, q)).enumerate()
    {
        matrix += &gradient * gradient.transpose() * (dt * spring_s * strain.stiffness);
        if strain.axial && strain.value > 0.0 {
            let e = soft[index];
            let edge = [place[e + 1][0] - place[e][0], place[e + 1][1] - place[e][1]];
            let length = edge[0].hypot(edge[1]);
            let across = across_gradient(world, q, e, [-edge[1] / length, edge[0] / length]);
            let tension = strain.stiffness * strain.value;
            matrix += &across * across.transpose() * (dt * geometric_s * tension / length);
        }
    }
    matrix
}

/// Gradient of n·(x_{e+1} − x_e) with n held, by central differences.
fn across_gradient(world: &World, q: &[f64], e: usize, normal: [f64; 2]) -> DVector<f64> {
    let step = 1e-7;
    let value = |q: &[f64]| {
        let place = nodes(world, q);
        (0..2).map(|k| normal[k] * (place[e + 1][k] - place[e][k])).sum::<f64>()
    };
    DVector::from_fn(q.len(), |k, _| {
        let moved = |by: f64| {
            let mut moved = q.to_vec();
            moved[k] += by;
            value(&moved)
        };
        (moved(step) - moved(-step)) / (2.0 * step)
    })
}

/// Scenes of this file compile; their springs are as many as elements and inner nodes.
#[test]
fn validates_spring_count() {
    let model = Model::compile(&scene(ROD, &[])).expect("a model");
    assert_eq!((model.stretch.len(), model.bend.len()), (20, 19));
}
