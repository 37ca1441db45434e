//! The wrench that acts in a step in space: a lone body magnet in free space, at any place and orientation over drives
//! at any yaw, gains the momentum that the reference asks for.

use crate::magnet_symmetry::poses;
use crate::report::Case;
use crate::world::{ROD, World, number};
use magworm::internals::magnetic::{MU_0, Magnet, Wrench, dipole_wrench, wrench};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

const REFERENCE: &str = include_str!("../data/magnet_reference.csv");

/// A body magnet and what acts on it. Edges are length, height and width.
#[derive(Clone)]
struct Setup {
    dimensions: usize,
    drive_size: Vector3<f64>,
    drive_remanence: f64,
    body_size: Vector3<f64>,
    /// With its sign.
    body_remanence: f64,
    order: usize,
    model: &'static str,
    arrangement: &'static str,
    /// x, y, z [m] and yaw [rad].
    stage: [f64; 4],
    field: [f64; 3],
    /// Components of the drive's wrench that act.
    terms: &'static str,
}

impl Setup {
    /// Magnets of about the presets' size.
    fn usual(model: &'static str, order: usize) -> Self {
        Self {
            dimensions: 3,
            drive_size: Vector3::new(0.015, 0.004, 0.026),
            drive_remanence: 1.22,
            body_size: Vector3::new(0.0063, 0.0016, 0.0075),
            body_remanence: 1.22,
            order,
            model,
            arrangement: "{ kind = 'single' }",
            stage: [0.0; 4],
            field: [0.0; 3],
            terms: "{}",
        }
    }

    fn world(&self) -> World {
        let [length, height, width] = self.body_size.into();
        let [drive_length, drive_height, drive_width] = self.drive_size.into();
        let (n, polarity) = (number, if self.body_remanence < 0.0 { -1 } else { 1 });
        let [x, y, z, yaw] = self.stage;
        let [bx, by, bz] = self.field;
        let body = format!(
            "{{ kind = 'rod', length_m = {}, width_m = {}, thickness_m = {}, elements = 1, \
             magnets = [{{ position_m = {}, polarity = {polarity} }}] }}",
            n(length),
            n(1.01 * width),
            n(height),
            n(0.5 * length),
        );
        let magnet = format!(
            "{{ length_m = {}, height_m = {}, width_m = {}, remanence_t = {}, density_kg_m3 = 7500 }}",
            n(length),
            n(height),
            n(width),
            n(self.body_remanence.abs()),
        );
        let drive = format!(
            "{{ length_m = {}, height_m = {}, width_m = {}, remanence_t = {}, arrangement = {}, \
             motion = {{ kind = 'constant', x_m = {}, y_m = {}, speed_m_s = 0, z_m = {}, \
             yaw_deg = {} }} }}",
            n(drive_length),
            n(drive_height),
            n(drive_width),
            n(self.drive_remanence),
            self.arrangement,
            n(x),
            n(y),
            n(z),
            n(yaw.to_degrees()),
        );
        let field = format!("{{ x_t = {}, y_t = {}, z_t = {} }}", n(bx), n(by), n(bz));
        World::new(
            ROD,
            &[
                ("dimensions", &self.dimensions.to_string()),
                ("body", &body),
                ("magnet", &magnet),
                ("drive", &drive),
                ("field", if self.field == [0.0; 3] { "" } else { &field }),
                ("magnetic_terms", self.terms),
                ("solver.step_s", "1e-4"),
                ("control.step_s", "1e-4"),
                ("solver.magnet_model", self.model),
                ("solver.quadrature_order", &self.order.to_string()),
            ],
        )
    }

    /// Momentum over time that one step gives the body at rest at a place, with these tangent, up and side.
    fn acts(&self, place: Vector3<f64>, axes: Matrix3<f64>) -> Wrench {
        let World { model, mut block } = self.world();
        let dof = model.coordinates.bodies[0];
        for axis in 0..self.dimensions {
            block.q[dof + axis][0] = place[axis];
        }
        if self.dimensions == 2 {
            block.q[dof + 2][0] = axes[(1, 0)].atan2(axes[(0, 0)]);
        } else {
            for axis in 0..3 {
                block.director[axis][0] = axes[(axis, 1)];
                block.director[3 + axis][0] = axes[(axis, 0)];
            }
        }
        let mut world = World { model, block };
        world.steps(1);
        let World { model, block } = &world;
        let velocity = block.magnet_velocity(model, 0, 0);
        let mass = block.mass[dof][0];
        let spin = velocity.angular_rad_s;
        let momentum = if self.dimensions == 2 {
            spin * block.mass[dof + 2][0]
        } else {
            let turned = block.magnet_pose(model, 0, 0).orientation;
            let moments = Vector3::from_fn(|k, _| block.mass[dof + 3 + k][0]);
            turned * turned.inverse_transform_vector(&spin).component_mul(&moments)
        };
        Wrench {
            force_n: velocity.linear_m_s * mass / model.step_s,
            torque_n_m: momentum / model.step_s,
        }
    }

    /// The magnets as those of [`wrench`], in the axes of the simulator.
    fn magnets(&self) -> [Magnet; 2] {
        [(self.drive_size, self.drive_remanence), (self.body_size, self.body_remanence)]
            .map(|(size_m, remanence)| Magnet { size_m, remanence_t: remanence * Vector3::y() })
    }

    /// Moments of the magnets along their up directions [T·m³].
    fn moments(&self) -> [f64; 2] {
        self.magnets().map(|magnet| magnet.remanence_t.y * magnet.size_m.product())
    }
}

/// Sums of forces and of torques, and the difference of two wrenches: of |F|, and of |T| + |F| times the arm.
fn plus(a: Wrench, b: Wrench) -> Wrench {
    Wrench { force_n: a.force_n + b.force_n, torque_n_m: a.torque_n_m + b.torque_n_m }
}

const NOTHING: Wrench =
    Wrench { force_n: Vector3::new(0.0, 0.0, 0.0), torque_n_m: Vector3::new(0.0, 0.0, 0.0) };

fn difference(found: &Wrench, exact: &Wrench, arm: f64) -> f64 {
    let force = exact.force_n.norm();
    let off = (found.force_n - exact.force_n).norm() / force;
    let turned_off = (found.torque_n_m - exact.torque_n_m).norm();
    off.max(turned_off / (exact.torque_n_m.norm() + force * arm))
}

fn turned(by: UnitQuaternion<f64>, wrench: &Wrench) -> Wrench {
    Wrench { force_n: by * wrench.force_n, torque_n_m: by * wrench.torque_n_m }
}

fn yawed(yaw: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::y_axis(), yaw)
}

/// A stage for the k-th pose: anywhere, at any yaw.
fn stage(k: usize) -> [f64; 4] {
    let part = |by: f64| (k as f64 * by.sqrt()).fract() - 0.5;
    [0.3 * part(7.0), 0.2 * part(11.0), 0.3 * part(13.0), 6.0 * part(17.0)]
}

/// Poses of a body relative to its drive, in any orientation.
fn spatial_poses() -> impl Iterator<Item = (usize, Vector3<f64>, UnitQuaternion<f64>)> {
    poses([0.06, 0.022, 0.03]).step_by(6).enumerate().map(|(k, [x, y, angle])| {
        let z = 0.06 * ((k as f64 * 19f64.sqrt()).fract() - 0.5);
        let turn = UnitQuaternion::from_euler_angles(2.0 * angle + k as f64, 0.7 * angle, angle);
        (k, Vector3::new(x, y, z), turn)
    })
}

/// A row of the reference as scenes. The reference's drives are magnetised along its z, here y. A body that is
/// magnetised askew is up to three bodies, each magnetised along one edge: wrenches add up.
fn reference_error(row: &[f64], order: usize, k: usize) -> f64 {
    let vector = |column: usize| Vector3::new(row[column], row[column + 1], row[column + 2]);
    let here = Rotation3::from_matrix_unchecked(Matrix3::new(
        1.0, 0.0, 0.0, //
        0.0, 0.0, 1.0, //
        0.0, -1.0, 0.0,
    ));
    assert_eq!(vector(13), Vector3::z());
    let stage = stage(k);
    let turn = yawed(stage[3]);
    let quaternion = nalgebra::Quaternion::new(row[9], row[10], row[11], row[12]);
    let orientation =
        turn * here * UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix();
    let place = Vector3::new(stage[0], stage[1], stage[2]) + turn * (here * vector(6));
    let (drive, body) = (vector(0), vector(3));
    let found = (0..3).filter(|n| row[16 + n] != 0.0).map(|n| {
        let (s, t) = ((n + 1) % 3, (n + 2) % 3);
        let setup = Setup {
            drive_size: Vector3::new(drive.x, drive.z, drive.y),
            drive_remanence: row[19],
            body_size: Vector3::new(body[s], body[n], body[t]),
            body_remanence: row[20] * row[16 + n],
            stage,
            ..Setup::usual("'cuboid'", order)
        };
        let column = |k: usize| orientation * Vector3::ith(k, 1.0);
        setup.acts(place, Matrix3::from_columns(&[column(s), column(n), -column(t)]))
    });
    let found = found.fold(NOTHING, plus);
    let exact = Wrench { force_n: here * vector(21), torque_n_m: here * vector(24) };
    difference(&found, &turned(turn, &exact), 0.5 * body.x)
}

/// A lone drive against `wrench()` in the drive's frame, with as many points.
fn free_error(k: usize, offset: Vector3<f64>, orientation: UnitQuaternion<f64>) -> f64 {
    let setup = Setup { stage: stage(k), ..Setup::usual("'cuboid'", 4) };
    let [drive, body] = setup.magnets();
    let turn = yawed(setup.stage[3]);
    let exact = wrench(&drive, &body, offset, orientation, 4).expect("magnets apart");
    let exact = turned(turn, &exact);
    let [x, y, z, _] = setup.stage;
    let axes = (turn * orientation).to_rotation_matrix().into_inner();
    let found = setup.acts(Vector3::new(x, y, z) + turn * offset, axes);
    difference(&found, &exact, offset.norm())
}

/// Magnets of a drive: offset along x at yaw 0 [m], and polarity.
type Magnets = &'static [(f64, f64)];

/// Drives of dipoles against Yung's formula, magnet by magnet.
fn dipole_error(
    arrangement: &'static str,
    magnets: Magnets,
    (k, offset, orientation): (usize, Vector3<f64>, UnitQuaternion<f64>),
) -> f64 {
    let setup = Setup { stage: stage(k), arrangement, ..Setup::usual("'dipole'", 1) };
    let turn = yawed(setup.stage[3]);
    let [x, y, z, _] = setup.stage;
    let place = Vector3::new(x, y, z) + turn * offset;
    let [drive, body] = setup.moments();
    let moment = orientation * Vector3::y() * body;
    // A belt keeps its direction along x.
    let along = if arrangement.contains("belt") { Vector3::x() } else { turn * Vector3::x() };
    let exact = magnets.iter().map(|(at, polarity)| {
        let source = Vector3::new(x, y, z) + along * *at;
        dipole_wrench(Vector3::y() * drive * *polarity, moment, place - source)
    });
    let exact = exact.fold(NOTHING, plus);
    let found = setup.acts(place, orientation.to_rotation_matrix().into_inner());
    difference(&found, &exact, offset.norm())
}

/// The spatial step against the planar one, for a body in the plane.
fn planar_error([x, y, angle]: [f64; 3], order: usize) -> f64 {
    let axes = Rotation3::from_axis_angle(&Vector3::z_axis(), angle).into_inner();
    let [flat, spatial] = [2, 3].map(|dimensions| {
        let setup = Setup { dimensions, ..Setup::usual("'cuboid'", order) };
        setup.acts(Vector3::new(x, y, 0.0), axes)
    });
    difference(&spatial, &flat, x.hypot(y))
}

/// Torque of a uniform field against m × B, and the force, which is none, over it and the body's length.
fn uniform_errors(k: usize, orientation: UnitQuaternion<f64>) -> [f64; 2] {
    let [x, y, z, _] = stage(k);
    let field = Vector3::new(x, y, z);
    let setup = Setup { drive_remanence: 0.0, field: field.into(), ..Setup::usual("'cuboid'", 1) };
    let moment = orientation * Vector3::y() * (setup.moments()[1] / MU_0);
    let exact = moment.cross(&field);
    let found = setup.acts(Vector3::y(), orientation.to_rotation_matrix().into_inner());
    let size = moment.norm() * field.norm();
    [(found.torque_n_m - exact).norm() / size, found.force_n.norm() * setup.body_size.x / size]
}

#[test]
fn validates_the_wrench_in_a_step_in_space() {
    let mut case = Case::new(
        "the_wrench_in_a_step_in_space",
        "Wrench of a drive at any yaw on a body in any orientation",
    )
    .equation(
        "m v⁺ = Δt F, I ω⁺ = Δt T of a body at rest, with F and T turned by the drive's yaw; \
         uniform field: T = m × B",
    )
    .source(
        "Charge model, converged values, `rust/magworm/tests/data/magnet_reference.csv`; K. W. \
         Yung, P. B. Landecker, D. D. Villani, Magn. Electr. Sep. 9 (1998) 39",
    )
    .scene(ROD, &[("dimensions", "3"), ("body", "…"), ("magnet", "…"), ("drive", "…")])
    .note(
        "A lone magnet at rest in free space: what one step gives it is momentum and angular \
         momentum over the step. Drives stand anywhere, at any yaw. Errors of force are parts of \
         |F|, of torque parts of |T| + |F| times the distance, in the first rows times half the \
         body's length. All 21 poses of the reference, a body that is magnetised askew as a sum \
         of up to three; 100 poses of about the presets' magnets 22 mm above the drive or \
         higher, 600 in the plane.",
    );
    let parse = |line: &str| line.split(',').map(|cell| cell.trim().parse().unwrap()).collect();
    let rows: Vec<Vec<f64>> = REFERENCE.lines().skip(1).map(parse).collect();
    assert_eq!(rows.len(), 21);
    for (order, band) in [(8, 1e-8), (2, 2e-2)] {
        let errors = rows.iter().enumerate().map(|(k, row)| reference_error(row, order, k));
        let errors: Vec<f64> = errors.collect();
        case.spread(format!("reference, order {order}"), "relative", &errors, band);
    }
    let errors: Vec<f64> = spatial_poses().map(|(k, at, turn)| free_error(k, at, turn)).collect();
    case.spread("`wrench()`, order 4 of both", "relative", &errors, 1e-11);
    for (order, band) in [(8, 1e-9), (2, 1e-4)] {
        let errors: Vec<f64> =
            poses([0.12, 0.022, 0.04]).map(|pose| planar_error(pose, order)).collect();
        case.spread(format!("planar step, order {order} of both"), "relative", &errors, band);
    }
    let arrangements: [(&str, &str, Magnets); 3] = [
        ("one dipole", "{ kind = 'single' }", &[(0.0, 1.0)]),
        (
            "a pair of opposed dipoles",
            "{ kind = 'pair', spacing_m = 0.05, second_polarity = -1 }",
            &[(-0.025, 1.0), (0.025, -1.0)],
        ),
        (
            // Places of the robot are less than half a pitch from the stage.
            "a belt of dipoles",
            "{ kind = 'belt', pitch_m = 0.125, count = 3 }",
            &[(0.0, 1.0), (-0.125, 1.0), (0.125, 1.0)],
        ),
    ];
    for (name, arrangement, magnets) in arrangements {
        let errors: Vec<f64> =
            spatial_poses().map(|pose| dipole_error(arrangement, magnets, pose)).collect();
        case.spread(name, "relative", &errors, 1e-13);
    }
    let errors = spatial_poses().map(|(k, _, turn)| uniform_errors(k, turn));
    let (torque, force): (Vec<f64>, Vec<f64>) =
        errors.map(|[torque, force]| (torque, force)).unzip();
    case.spread("torque of a uniform field", "of |m| |B|", &torque, 1e-13);
    case.spread("force of a uniform field", "of |m| |B| over the length", &force, 0.0);
    case.finish();
}

#[test]
fn terms_that_are_switched_off_do_not_act_in_space() {
    let (k, offset, orientation) = spatial_poses().last().expect("a pose");
    let terms = [
        ("{ horizontal_force = false }", [0.0, 1.0, 0.0], 1.0),
        ("{ vertical_force = false }", [1.0, 0.0, 1.0], 1.0),
        ("{ torque = false }", [1.0, 1.0, 1.0], 0.0),
    ];
    let acts = |terms: &'static str| {
        let setup = Setup { stage: stage(k), terms, ..Setup::usual("'cuboid'", 2) };
        let [x, y, z, yaw] = setup.stage;
        let turn = yawed(yaw);
        let axes = (turn * orientation).to_rotation_matrix().into_inner();
        setup.acts(Vector3::new(x, y, z) + turn * offset, axes)
    };
    let all = acts("{}");
    for (switched, force, torque) in terms {
        let exact = Wrench {
            force_n: all.force_n.component_mul(&Vector3::from(force)),
            torque_n_m: all.torque_n_m * torque,
        };
        assert!(difference(&acts(switched), &exact, offset.norm()) < 1e-12, "{switched}");
    }
}
