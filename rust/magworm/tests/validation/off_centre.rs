//! Rigid bodies whose centre of mass lies beside the middle of their element.

use crate::report::{farthest_from, orders};
use crate::space_world::Vector;
use crate::world::{ROD, World, number};
use magworm::internals::magnetic::MU_0;
use nalgebra::{Matrix3, Rotation3};

const RUBBER_KG_M3: f64 = 1000.0;
/// Length, height and width of the magnet, and the height and width of its section [m].
const MAGNET_M: [f64; 3] = [0.01, 0.002, 0.003];
const SECTION_M: [f64; 2] = [0.006, 0.008];

/// A body that is one magnet and the rubber around it.
fn body(up_m: f64, aside_m: f64) -> String {
    let ([length, height, width], [thickness, wide]) = (MAGNET_M, SECTION_M);
    format!(
        "{{ kind = 'segments', segment = [{{ length_m = {length}, thickness_m = {thickness}, width_m = {wide}, \
         elements = 1, foot = true, magnet = {{ length_m = {length}, height_m = {height}, width_m = {width}, \
         remanence_t = 1.2, density_kg_m3 = 7500, up_m = {up_m}, aside_m = {aside_m} }} }}] }}"
    )
}

/// Mass [kg], and place of its centre over the middle of a body by a magnet `beside_m` from it [m].
fn centre_m(beside_m: f64) -> (f64, f64) {
    let magnet_m3: f64 = MAGNET_M.iter().product();
    let rubber_kg = RUBBER_KG_M3 * MAGNET_M[0] * SECTION_M[0] * SECTION_M[1];
    let more_kg = (7500.0 - RUBBER_KG_M3) * magnet_m3;
    (rubber_kg + more_kg, more_kg * beside_m / (rubber_kg + more_kg))
}

/// Axes of a body in the columns: tangent, up and side.
fn axes(world: &World) -> Matrix3<f64> {
    let pose = world.block.magnet_pose(&world.model, 0, 0);
    *pose.orientation.to_rotation_matrix().matrix()
}

fn middle(world: &World) -> Vector {
    world.block.magnet_pose(&world.model, 0, 0).position_m
}

fn motion(world: &World) -> (Vector, Vector) {
    let twist = world.block.magnet_velocity(&world.model, 0, 0);
    (twist.linear_m_s, twist.angular_rad_s)
}

/// Sets the velocity of the middle and the angular velocity.
fn set_motion(world: &mut World, velocity: Vector, rate: Vector) {
    let (dof, space) = (world.model.coordinates.bodies[0], world.model.dimensions() == 3);
    let mut rows = vec![velocity.x, velocity.y];
    rows.extend(if space { vec![velocity.z, rate.x, rate.y, rate.z] } else { vec![rate.z] });
    for (k, value) in rows.into_iter().enumerate() {
        world.block.v[dof + k][0] = value;
    }
}

/// A free body in the plane flies as its centre of mass does: straight and at a constant rate, to rounding.
#[test]
fn validates_free_flight_off_centre() {
    let (mass_kg, height_m) = centre_m(0.0015);
    let body = body(0.0015, 0.0);
    for integrator in ["'newmark'", "'euler'"] {
        let edits =
            [("body", body.as_str()), ("start.angle_deg", "30"), ("solver.integrator", integrator)];
        let mut world = World::new(ROD, &edits);
        let arm = axes(&world) * Vector::new(0.0, height_m, 0.0);
        let (flight, rate) = (Vector::new(0.3, -0.2, 0.0), Vector::z() * 25.0);
        set_motion(&mut world, flight - rate.cross(&arm), rate);
        let start = middle(&world) + arm;
        world.run(1.0);
        let arm = axes(&world) * Vector::new(0.0, height_m, 0.0);
        let (velocity, spin) = motion(&world);
        let moved = middle(&world) + arm - start - flight;
        let momentum = (velocity + spin.cross(&arm) - flight) * mass_kg;
        println!("{integrator}: centre of mass off by {:.1e} m after 1 s", moved.norm());
        assert!(moved.norm() < 1e-12 && momentum.norm() < 1e-14 * mass_kg, "{moved} {momentum}");
        assert!((spin - rate).norm() < 1e-11 && (world.block.mass[0][0] - mass_kg).abs() < 1e-15);
        assert!((world.block.q[2][0] - 30f64.to_radians() - 25.0).abs() < 1e-10);
    }
}

/// A body that is let go falls without turning, wherever its centre of mass is.
#[test]
fn validates_fall_off_centre() {
    for (dimensions, aside_m) in [("2", 0.0), ("3", 0.001)] {
        let body = body(0.0015, aside_m);
        let edits = [
            ("body", body.as_str()),
            ("dimensions", dimensions),
            ("gravity_m_s2", "9.81"),
            ("start.angle_deg", "40"),
        ];
        let mut world = World::new(ROD, &edits);
        world.run(0.5);
        let (velocity, rate) = motion(&world);
        assert!((velocity - Vector::y() * (-0.5 * 9.81)).norm() < 1e-12, "{velocity}");
        assert!(rate.norm() < 1e-10, "{rate}");
    }
}

/// Inertia of the body about its centre of mass along its own axes, from what the model says of it about its middle.
fn central_inertia(world: &World, centre: Vector, mass_kg: f64) -> Matrix3<f64> {
    let dof = world.model.coordinates.bodies[0];
    let mut inertia =
        Matrix3::from_diagonal(&Vector::from_fn(|k, _| world.block.mass[dof + 3 + k][0]));
    for (row, (k, l)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
        let product = world.block.off_centre[3 + row][0];
        (inertia[(k, l)], inertia[(l, k)]) = (product, product);
    }
    let square = Matrix3::from_diagonal_element(centre.norm_squared());
    inertia - (square - centre * centre.transpose()) * mass_kg
}

/// Torque-free motion of a body whose centre of mass lies above and beside its middle: both momenta are kept to rounding, and its
/// rotation is that of Euler's equations, Ṙ = [R I⁻¹ Rᵀ L] R, solved here, with an error of first order in the step.
#[test]
fn validates_space_tumbling_off_centre() {
    const TIME_S: f64 = 0.4;
    let ((mass_kg, up_m), (_, aside_m)) = (centre_m(0.0015), centre_m(0.002));
    let centre = Vector::new(0.0, up_m, aside_m);
    let body = body(0.0015, 0.002);
    let errors = [1e-3, 5e-4, 2.5e-4, 1.25e-4].map(|step| {
        let step = number(step);
        let edits = [
            ("body", body.as_str()),
            ("dimensions", "3"),
            ("solver.step_s", &step),
            ("start.angle_deg", "30"),
        ];
        let mut world = World::new(ROD, &edits);
        let (flight, rate) = (Vector::new(0.1, 0.2, -0.15), Vector::new(6.0, 3.0, 20.0));
        let first = axes(&world);
        set_motion(&mut world, flight - rate.cross(&(first * centre)), rate);
        let start = middle(&world) + first * centre;
        let inertia = central_inertia(&world, centre, mass_kg);
        let momentum = first * inertia * first.transpose() * rate;
        world.run(TIME_S);
        let last = axes(&world);
        let (velocity, rate) = motion(&world);
        let moved = middle(&world) + last * centre - start - flight * TIME_S;
        let drift = velocity + rate.cross(&(last * centre)) - flight;
        let spin = last * inertia * last.transpose() * rate - momentum;
        assert!(moved.norm() < 1e-12 && drift.norm() < 1e-12, "{moved} {drift}");
        assert!(spin.norm() < 1e-11 * momentum.norm(), "{spin}");
        let inverse = inertia.try_inverse().expect("a body with mass");
        let turn =
            |r: &Matrix3<f64>| (r * (inverse * (r.transpose() * momentum))).cross_matrix() * r;
        let exact = integrated(first, turn, TIME_S);
        let between = last.transpose() * exact;
        Rotation3::from_matrix_unchecked(between).angle()
    });
    println!("tumbling off centre: errors {errors:.2?} rad");
    assert!(errors[3] < 0.02);
    assert!((farthest_from(1.0, &orders(&errors)) - 1.0).abs() < 0.2);
}

/// Runge–Kutta of fourth order.
fn integrated(
    mut r: Matrix3<f64>,
    rate: impl Fn(&Matrix3<f64>) -> Matrix3<f64>,
    time_s: f64,
) -> Matrix3<f64> {
    let parts = 20_000;
    let h = time_s / f64::from(parts);
    for _ in 0..parts {
        let a = rate(&r);
        let b = rate(&(r + a * (0.5 * h)));
        let c = rate(&(r + b * (0.5 * h)));
        let d = rate(&(r + c * h));
        r += (a + (b + c) * 2.0 + d) * (h / 6.0);
    }
    r
}

/// A magnet in a uniform field swings about its centre of mass, which stays, with ω² = m B/I_c.
#[test]
fn validates_compass_off_centre() {
    const FIELD_T: f64 = 0.01;
    let (mass_kg, height_m) = centre_m(0.0015);
    for (dimensions, rotation) in [("2", 2), ("3", 5)] {
        let body = body(0.0015, 0.0);
        let edits = [
            ("body", body.as_str()),
            ("dimensions", dimensions),
            ("field", "{ x_t = 0, y_t = 0.01 }"),
            ("start.angle_deg", "1"),
            ("solver.step_s", "1e-5"),
        ];
        let mut world = World::new(ROD, &edits);
        let dof = world.model.coordinates.bodies[0];
        let inertia = world.block.mass[dof + rotation][0] - mass_kg * height_m * height_m;
        let moment = 1.2 * MAGNET_M.iter().product::<f64>() / MU_0;
        let period_s = std::f64::consts::TAU * (inertia / (moment * FIELD_T)).sqrt();
        let centre = |world: &World| middle(world) + axes(world) * Vector::new(0.0, height_m, 0.0);
        let start = centre(&world);
        world.run(period_s);
        let tilt = axes(&world)[(1, 0)];
        assert!((tilt - 1f64.to_radians().sin()).abs() < 2e-3 * tilt, "{tilt}");
        assert!((centre(&world) - start).norm() < 1e-12);
        world.run(0.25 * period_s);
        assert!(
            axes(&world)[(1, 0)].abs() < 1e-2 * tilt,
            "a quarter later it points along the field"
        );
    }
}

/// A foot 10 mm long topples where its centre of mass passes its edge: tan α = half its length over its height.
#[test]
fn validates_toppling_off_centre() {
    let (_, beside_m) = centre_m(0.002);
    let body = body(0.002, 0.0);
    for dimensions in ["2", "3"] {
        let limit_deg = (0.005 / (0.003 + beside_m)).atan().to_degrees();
        let plain_deg = (0.005f64 / 0.003).atan().to_degrees();
        assert!(plain_deg - limit_deg > 5.0, "{plain_deg} {limit_deg}");
        let turned = |incline_deg: f64| {
            let ground = format!(
                "{{ static_friction = 10, dynamic_friction = 10, incline_deg = {incline_deg} }}"
            );
            let edits = [
                ("body", body.as_str()),
                ("dimensions", dimensions),
                ("gravity_m_s2", "9.81"),
                ("ground", ground.as_str()),
            ];
            let mut world = World::new(ROD, &edits);
            world.run(0.4);
            axes(&world)[(1, 1)].clamp(-1.0, 1.0).acos().to_degrees()
        };
        let (below, beyond) = (turned(limit_deg - 0.5), turned(limit_deg + 0.5));
        println!(
            "toppling at {limit_deg:.2}°: {below:.2}° half a degree below, {beyond:.2}° beyond"
        );
        assert!(below < 1.0 && beyond > 20.0, "{below} {beyond}");
    }
}
