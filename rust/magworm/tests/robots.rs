//! Who asks for a robot gets that of its own magnets.

mod base;

use base::base;
use magworm::internals::Robot;
use magworm::observe;
use magworm::{Batch, LaneChoice, Model, StepOutput};
use std::sync::Arc;

/// Three magnets, of which the first one belongs to no robot; the stage starts beneath the robot.
fn model() -> Model {
    let mut scene = base("robot");
    scene.reset.random_drive = false;
    let mut model = Model::compile(&scene).expect("a valid scene");
    let whole = model.robots[Robot::AGENT].clone();
    assert_eq!(whole.bodies, 0..3);
    model.robots = vec![Robot { bodies: 1..3, ..whole }];
    model
}

/// x of the middle between the last two magnets, of the robot, and of the stage [m].
fn places(batch: &Batch) -> [f64; 3] {
    batch.view(0, |view| {
        let [second, third] = [1, 2].map(|magnet| view.magnet_pose(magnet)[0]);
        let stage = view.drive_place(0).expect("a drive");
        [(second + third) / 2.0, view.robot_pose()[0], stage[0]]
    })
}

#[test]
fn a_robot_is_its_own_magnets_alone() {
    let model = Arc::new(model());
    let mut batch = Batch::new(Arc::clone(&model), 1, LaneChoice::Scalar, Some(1));
    batch.reset(0, 1, 0, None);
    let [start, robot, stage] = places(&batch);
    assert_eq!((robot, stage), (start, start));

    // Two magnets of six numbers, the stage's four, the three of the last action.
    assert_eq!(observe::size(&model), 2 * 6 + 4 + 3);
    let (mut observation, mut progress_m) = (vec![f32::NAN; 19], [f64::NAN]);
    // To the far end of the stage's reach, as high and as fast as it goes.
    for _ in 0..20 {
        let [before, ..] = places(&batch);
        let (observation, progress_m) = (&mut observation, &mut progress_m);
        batch.step(&[1.0; 3], StepOutput { observation, progress_m, status: &mut [0] });
        let [after, robot, _] = places(&batch);
        assert_eq!((robot, progress_m[0]), (after, before - after));
    }
    assert_ne!(places(&batch)[0], start, "it does not move");
    // Seen from its centre, its two magnets lie opposite each other.
    assert_eq!(observation[0], -observation[1]);
}
