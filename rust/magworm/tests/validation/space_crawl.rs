//! The robot of the presets in space: what the plane shows, and that it stays upright.

use crate::world::World;

#[test]
fn trial() {
    for dims in ["2", "3"] {
        for (name, motion, time) in [
            ("lift", "{kind='waypoints',time_s=[0.0,0.5],x_m=[0.027,0.027],y_m=[-0.052,-0.022]}", 0.8),
            ("pass", "{kind='constant',x_m=-0.05,y_m=-0.022,speed_m_s=0.1}", 1.5),
            ] {
            let mut world = World::new("paper-3", &[("dimensions", dims), ("drive.motion", motion)]);
            let rest = world.block.planar_pose(&world.model, 1, 0)[1];
            let start = world.block.planar_pose(&world.model, 2, 0)[0];
            let (mut peak, mut roll) = (0.0f64, 0.0f64);
            let steps = (time / world.model.step_s).round() as u32;
            for _ in 0..steps {
                world.steps(1);
                peak = peak.max(world.block.planar_pose(&world.model, 1, 0)[1] - rest);
                roll = roll.max(world.block.magnet_pose(&world.model, 1, 0).roll_rad().abs());
            }
            let c = world.block.counters;
            println!("{dims} {name}: height {:.4} peak {:.4} stride {:.4} roll {roll:.3e} pose {:?} solves/step {:.2} fac/step {:.2} band {}x{}",
                1e3*(world.block.planar_pose(&world.model, 1, 0)[1] - rest), 1e3*peak, 1e3*(start - world.block.planar_pose(&world.model, 2, 0)[0]),
                world.block.robot_pose(&world.model, 0), c.solves as f64 / c.steps as f64, c.factorisations as f64/c.steps as f64, world.model.coordinates.count, world.model.band.half_bandwidth());
        }
    }
}
