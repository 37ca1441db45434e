//! The robot of the presets in space: what the plane shows, and that it stays upright.

use crate::world::World;

#[test]
fn trial() {
    for (extra, dims) in
        [(vec![], "2"), (vec![], "3"), (vec![("solver.quadrature_order", "4")], "3")]
    {
        let mut edits = vec![
            ("dimensions", dims),
            ("drive.motion", "{kind='constant',x_m=-0.05,y_m=-0.022,speed_m_s=0.1}"),
        ];
        edits.extend(extra.iter());
        let mut world = World::new("paper-3", &edits);
        let steps = (1.5 / world.model.step_s).round() as u32;
        let mut hist = [0; 70];
        let mut line = String::new();
        for k in 0..steps {
            let before = world.block.counters;
            world.steps(1);
            let c = world.block.counters;
            let n = (c.solves - before.solves) as usize;
            hist[n] += 1;
            let roll = world.block.magnet_pose(&world.model, 1, 0).roll_rad().abs();
            if n > 12 {
                let modes: Vec<_> = world.block.mode.iter().map(|m| m[0]).collect();
                line += &format!(
                    "  step {k} passes {n} fac {} roll {roll:.1e} modes {modes:?}\n",
                    c.factorisations - before.factorisations
                );
            }
        }
        println!("dims {dims} {extra:?} hist {hist:?}\n{line}");
    }
}
