//! Body magnets of any direction and place in their section.

use crate::space_world::Vector;
use crate::world::{ROD, World, number};
use magworm::internals::lanes::{Plane, Scalar, Space};
use magworm::internals::{Block, equations, kinematics};

/// The drive magnet of the presets, upright, its centre at x = 0 and y = 0.
const DRIVE: &str = "{ length_m = 0.0149, width_m = 0.02618, height_m = 0.004033, remanence_t = 1.22, \
                     motion = { kind = 'constant', x_m = 0, y_m = 0, speed_m_s = 0 } }";

/// A body that is one magnet in a little rubber: its length, height and width, direction and place.
struct Body {
    size_m: [f64; 3],
    angle_deg: f64,
    aside_deg: f64,
    beside_m: [f64; 2],
}

/// The magnet of the presets.
const UPRIGHT: Body = Body {
    size_m: [0.006303, 0.001628, 0.007455],
    angle_deg: 0.0,
    aside_deg: 0.0,
    beside_m: [0.0; 2],
};

impl Body {
    fn toml(&self) -> String {
        let ([length, height, width], [up, aside]) = (self.size_m, self.beside_m);
        format!(
            "{{ kind = 'segments', segment = [{{ length_m = {length}, thickness_m = 0.02, width_m = 0.02, \
             elements = 1, magnet = {{ length_m = {length}, height_m = {height}, width_m = {width}, \
             remanence_t = 1.22, density_kg_m3 = 7500, angle_deg = {}, aside_deg = {}, up_m = {up}, \
             aside_m = {aside} }} }}] }}",
            self.angle_deg, self.aside_deg
        )
    }

    /// Force and torque about the middle of the body, which stands at `place_m`, turned by `angle_deg`.
    fn wrench(
        &self,
        dimensions: usize,
        place_m: Vector,
        angle_deg: f64,
        edits: &[(&str, &str)],
    ) -> [Vector; 2] {
        let (body, turned, space) = (self.toml(), number(angle_deg), dimensions.to_string());
        let base = [
            ("body", body.as_str()),
            ("dimensions", space.as_str()),
            ("drive", DRIVE),
            ("start.angle_deg", turned.as_str()),
            ("solver.quadrature_order", "8"),
        ];
        let mut world = World::new(ROD, &[&base[..], edits].concat());
        let (model, block) = (&world.model, &mut world.block);
        let dof = model.coordinates.bodies[0];
        (0..dimensions).for_each(|axis| block.q[dof + axis][0] = place_m[axis]);
        block.rhs.iter_mut().for_each(|row| row[0] = 0.0);
        let acting = |k: usize, block: &Block<[f64; 1]>| block.rhs[dof + k][0] / model.step_s;
        if dimensions == 2 {
            kinematics::<Plane, _>(Scalar, model, block);
            equations::magnets::<Plane, _>(Scalar, model, block);
            let [x, y, turn] = [0, 1, 2].map(|k| acting(k, block));
            [Vector::new(x, y, 0.0), Vector::z() * turn]
        } else {
            kinematics::<Space, _>(Scalar, model, block);
            equations::magnets::<Space, _>(Scalar, model, block);
            [0, 3].map(|first| Vector::from_fn(|k, _| acting(first + k, block)))
        }
    }
}

fn assert_close(here: [Vector; 2], there: [Vector; 2], tolerance: f64, what: &str) {
    let [force, torque] =
        [0, 1].map(|k| (here[k] - there[k]).norm() / there[k].norm().max(1e-3 * there[0].norm()));
    assert!(
        force <= tolerance && torque <= tolerance,
        "{what}: {force:.1e} {torque:.1e} {here:?} {there:?}"
    );
}

/// The magnet of the presets 25.5 mm beside the drive's centre and magnetised towards it: the mirror image of a drive that lies
/// turned by 90° beneath an upright magnet. Force and torque were integrated over charged faces with an independent program.
#[test]
fn validates_wrench_of_a_quarter_turn() {
    let place = Vector::new(0.0255, 0.0, 0.0);
    let expected = [Vector::new(0.0, 79.2059e-3, 0.0), Vector::z() * -0.639256e-3];
    let [length, height, width] = UPRIGHT.size_m;
    let along = Body { size_m: [height, length, width], angle_deg: -90.0, ..UPRIGHT };
    for dimensions in [2, 3] {
        let turned = UPRIGHT.wrench(dimensions, place, -90.0, &[]);
        let swapped = along.wrench(dimensions, place, 0.0, &[]);
        assert_close(turned, expected, 1e-5, "turned");
        assert_close(swapped, turned, 1e-12, "with its edges swapped");
    }
}

/// A direction is the sum of its parts, and what two descriptions say of one magnet is equal, in plane and space, as cuboids and as
/// dipoles, in the drive's field and in a uniform one.
#[test]
fn a_direction_is_the_sum_of_its_parts() {
    let place = Vector::new(0.011, 0.0195, 0.0);
    let field = ("field", "{ x_t = 0.02, y_t = -0.01 }");
    for dimensions in [2, 3] {
        for model in ["'cuboid'", "'dipole'"] {
            let edits = [("solver.magnet_model", model), field];
            let wrench = |angle_deg: f64| {
                let body = Body { angle_deg, ..UPRIGHT };
                body.wrench(dimensions, place, 17.0, &edits)
            };
            let [up, ahead] = [wrench(0.0), wrench(90.0)];
            let (sin, cos) = 33f64.to_radians().sin_cos();
            let sum = [0, 1].map(|k| up[k] * cos + ahead[k] * sin);
            assert_close(wrench(33.0), sum, 1e-12, model);
            assert_close(wrench(180.0), up.map(|part| -part), 1e-12, model);
        }
    }
}

/// In space a magnet may lean to its side: as one that is rolled.
#[test]
fn a_magnet_that_leans_aside_is_one_that_is_rolled() {
    let place = Vector::new(0.004, 0.021, 0.006);
    let [length, height, width] = UPRIGHT.size_m;
    let aside = Body { aside_deg: 90.0, size_m: [length, width, height], ..UPRIGHT };
    let leaning = aside.wrench(3, place, 0.0, &[]);
    // About the drive's axis y everything may be turned: with the yaw of the drive, the magnet's tangent goes to −z.
    let yaw = DRIVE.replace("speed_m_s = 0", "speed_m_s = 0, yaw_deg = 90");
    let along = Body { angle_deg: -90.0, size_m: [height, width, length], ..UPRIGHT };
    let swapped = along.wrench(3, Vector::new(0.006, 0.021, -0.004), 0.0, &[("drive", &yaw)]);
    let turned = swapped.map(|part| Vector::new(-part.z, part.y, part.x));
    assert_close(leaning, turned, 1e-12, "turned about the vertical");
}

/// A magnet beside the middle of its body acts as one in the middle there, with the moment of its force.
#[test]
fn a_magnet_beside_the_middle_brings_the_moment_of_its_force() {
    let place = Vector::new(0.007, 0.024, 0.0);
    for (dimensions, aside_m) in [(2, 0.0), (3, 0.003)] {
        let body = Body { angle_deg: 40.0, beside_m: [0.002, aside_m], ..UPRIGHT };
        let middle = Body { angle_deg: 40.0, ..UPRIGHT };
        let (sin, cos) = 25f64.to_radians().sin_cos();
        let arm = Vector::new(-sin * 0.002, cos * 0.002, aside_m);
        let [force, torque] = middle.wrench(dimensions, place + arm, 25.0, &[]);
        let beside = body.wrench(dimensions, place, 25.0, &[]);
        let moment = arm.cross(&force);
        let moment = if dimensions == 2 { Vector::z() * moment.z } else { moment };
        assert_close(beside, [force, torque + moment], 1e-12, "beside");
    }
}
