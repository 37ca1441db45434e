//! Trajectories whose bits are committed: a change of the simulator that is not meant to change results leaves every hash
//! as it is.
//!
//! A pin is a complete scene in `scenes/` and a hash in `hashes.toml` over everything that a batch shows of its robots in
//! [`CONTROL_STEPS`] control steps. Where bits change on purpose, `MAGWORM_WRITE_PINS=1 cargo test --test pins` writes the
//! hashes anew, and the changelog says why.

mod pin;

use magworm::LaneChoice::{self, Scalar, Wide};
use magworm::Status;
use pin::{ALL, CONTROL_STEPS, Robots, check, folder, model};

/// Robots that fare well unless their scene breaks them.
const WELL: &[u64] = ALL.split_at(4).0;

/// A test for each pin, named like its scene.
macro_rules! pins {
    ($names:ident, $check:ident: $($name:ident)*) => {
        const $names: &[&str] = &[$(stringify!($name)),*];
        $(
            #[test]
            fn $name() {
                $check(stringify!($name));
            }
        )*
    };
}

// Each scene of the tests and each preset once, with robots that break.
pins! { SCENES, keeps_its_bits:
    belt
    belt_in_single_precision
    belt_in_space
    cantilever
    cantilever_in_single_precision_in_space
    cantilever_in_space
    dipoles_in_single_precision_in_space
    dipoles_with_varied_parameters
    dipoles_with_varied_parameters_in_space
    experiment_belt
    experiment_five
    experiment_four
    experiment_three
    experiment_turn
    five_magnets
    four_magnets
    four_magnets_in_space_without_yaw
    held_wrenches
    held_wrenches_in_space
    incline
    incline_in_space
    multipliers
    multipliers_in_space
    rebound
    rebound_in_space
    relaxing_rubber
    relaxing_rubber_in_space
    rolled_up
    single_precision
    single_precision_in_space
    steps_of_half_a_millisecond
    suspended_drive
    suspended_drive_in_space
    three_magnets
    three_magnets_in_space
    turn
    twisted_in_space
    uniform_field
    uniform_field_in_space
    waypoints
    waypoints_in_space
}

// Eight of them with every integrator and precision that they allow, in lanes and one by one.
pins! { COMBINATIONS, keeps_its_bits_in_lanes_and_alone:
    belt_euler_double
    belt_euler_single
    belt_explicit_double
    belt_in_space_euler_double
    belt_in_space_euler_single
    belt_in_space_explicit_double
    belt_in_space_newmark_single
    belt_newmark_single
    cantilever_euler_double
    cantilever_euler_single
    cantilever_explicit_double
    cantilever_newmark_single
    dipoles_with_varied_parameters_euler_double
    dipoles_with_varied_parameters_euler_single
    dipoles_with_varied_parameters_explicit_double
    dipoles_with_varied_parameters_newmark_single
    incline_in_space_euler_double
    incline_in_space_euler_single
    incline_in_space_explicit_double
    incline_in_space_newmark_single
    three_magnets_euler_double
    three_magnets_euler_single
    three_magnets_explicit_double
    three_magnets_in_space_euler_double
    three_magnets_in_space_euler_single
    three_magnets_in_space_explicit_double
    three_magnets_in_space_newmark_single
    three_magnets_newmark_single
    uniform_field_in_space_euler_double
    uniform_field_in_space_euler_single
    uniform_field_in_space_explicit_double
    uniform_field_in_space_newmark_single
}

fn keeps_its_bits(pin: &str) {
    let mut robots = Robots::new(&model(pin), ALL, Wide);
    let hash = robots.run(CONTROL_STEPS);
    let broken = (0..ALL.len()).filter(|&place| robots.batch.status(place) != Status::Running);
    assert!((1..4).contains(&broken.count()), "{pin}: some robots break, some run");
    check(pin, hash);
}

fn keeps_its_bits_in_lanes_and_alone(pin: &str) {
    let model = model(pin);
    let run = |lanes: LaneChoice| Robots::new(&model, WELL, lanes).run(CONTROL_STEPS);
    let hash = run(Wide);
    assert_eq!(hash, run(Scalar), "{pin}: in lanes and one by one");
    check(pin, hash);
}

#[test]
fn every_scene_is_pinned_and_every_pin_has_a_scene() {
    let files = std::fs::read_dir(folder().join("scenes")).expect("a folder");
    let mut scenes: Vec<String> = files
        .map(|file| file.expect("a file").path().file_stem().unwrap().to_string_lossy().into())
        .collect();
    scenes.sort();
    let mut pins = [SCENES, COMBINATIONS].concat();
    pins.sort_unstable();
    assert_eq!(scenes, pins);
    assert!(pins.len() >= 60);
}
