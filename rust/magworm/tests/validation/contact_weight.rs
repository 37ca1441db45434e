//! Robots at rest.

use crate::world::World;

/// Normal forces of a robot at rest sum to its weight: 1e-6 of it after a second (what still moves).
#[test]
fn validates_weight_at_rest() {
    for preset in ["paper-3", "paper-4", "paper-5"] {
        for incline in ["0.0", "15.0"] {
            let mut world = World::new(preset, &[("drive", ""), ("ground.incline_deg", incline)]);
            world.run(3.0);
            let cosine = incline.parse::<f64>().expect("a number").to_radians().cos();
            let weight = world.mass_and_centre().0 * 9.81 * cosine;
            let error = world.normal_force() / weight - 1.0;
            println!("{preset} at rest, {incline}°: weight {weight:.5} N, error {error:.1e}");
            assert!(error.abs() < 1e-6);
        }
    }
}

/// On a 20° incline (tan 20° = 0.36 < μ_s) a robot over a drive 0.3 m away creeps by less than 1e-9 m/s.
#[test]
fn validates_creep_over_a_far_drive() {
    let edits = [
        ("ground.incline_deg", "20.0"),
        ("drive.motion", "{kind='constant',x_m=0.3,y_m=-0.062,speed_m_s=0.0}"),
    ];
    for preset in ["paper-3", "paper-5"] {
        let mut world = World::new(preset, &edits);
        world.run(4.0);
        let before = world.block.centre_x(&world.model, 0);
        world.run(1.0);
        let creep = world.block.centre_x(&world.model, 0) - before;
        println!(
            "{preset} on 20° over a far drive: creep {creep:.1e} m/s, fastest {:.1e} m/s",
            world.fastest(0)
        );
        assert!(creep.abs() < 1e-9);
    }
}
