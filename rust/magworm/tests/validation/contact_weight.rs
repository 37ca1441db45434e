//! Robots at rest.

use crate::report::Case;
use crate::world::World;

/// Normal forces of a robot at rest sum to its weight: 1e-6 of it after a second (what still moves).
#[test]
fn validates_weight_at_rest() {
    let mut case = Case::new("weight_at_rest", "Robots at rest weigh what they weigh")
        .equation("Σ N = m g cos α")
        .source("Statics")
        .scene("paper-3", &[("drive", ""), ("ground.incline_deg", "15.0")])
        .note("After 3 s; for paper-3, -4 and -5 on level ground and on 15°.");
    let mut errors = Vec::new();
    for preset in ["paper-3", "paper-4", "paper-5"] {
        for incline in ["0.0", "15.0"] {
            let mut world = World::new(preset, &[("drive", ""), ("ground.incline_deg", incline)]);
            world.run(3.0);
            let cosine = incline.parse::<f64>().expect("a number").to_radians().cos();
            let weight = world.mass_and_centre().0 * 9.81 * cosine;
            let error = world.normal_force() / weight - 1.0;
            println!("{preset} at rest, {incline}°: weight {weight:.5} N, error {error:.1e}");
            errors.push(error);
        }
    }
    case.spread("sum of the normal forces", "relative", &errors, 1e-6);
    case.finish();
}

/// On a 20° incline (tan 20° = 0.36 < μ_s) a robot over a drive 0.3 m away creeps by less than 1e-9 m/s.
#[test]
fn validates_creep_over_a_far_drive() {
    let edits = [
        ("ground.incline_deg", "20.0"),
        ("drive.motion", "{kind='constant',x_m=0.3,y_m=-0.062,speed_m_s=0.0}"),
    ];
    let mut case = Case::new("creep_over_a_far_drive", "Creep of robots that stick")
        .equation("v = 0 for tan α < μ_s")
        .source("Coulomb")
        .scene("paper-3", &edits)
        .note(
            "tan 20° = 0.36. The drive is 0.3 m away, so that its small force acts too. The way \
            between 4 and 5 s counts.",
        );
    for preset in ["paper-3", "paper-5"] {
        let mut world = World::new(preset, &edits);
        world.run(4.0);
        let before = world.block.centre_x(&world.model, 0, 0);
        world.run(1.0);
        let creep = world.block.centre_x(&world.model, 0, 0) - before;
        case.inside(format!("creep, {preset}"), "m/s", creep, -1e-9..=1e-9);
    }
    case.finish();
}
