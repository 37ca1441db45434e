//! Equal bits, however environments are laid out: lanes, threads, batch sizes, places in a batch.

mod bits_world;
mod scenes;

use bits_world::{Record, World, run};
use magworm::LaneChoice::{Scalar, Wide};
use magworm::internals::ContactMode;
use magworm::{LaneChoice, Model, Status};
use scenes::{SCENES, model};
use std::sync::Arc;

/// The records of some robots, `[control step][place]`.
fn records(
    model: &Arc<Model>,
    robots: &[u64],
    lanes: LaneChoice,
    threads: usize,
    steps: u64,
) -> Vec<Vec<Record>> {
    run(&mut World::new(model, robots, lanes, threads), steps)
}

/// Asserts that the robots found at `places` of one run equal those of another, place by place.
#[track_caller]
fn assert_equal(here: &[Vec<Record>], there: &[Vec<Record>], places: &[usize], what: &str) {
    for (step, (here, there)) in here.iter().zip(there).enumerate() {
        assert_eq!(there.len(), places.len());
        for (other, &place) in there.iter().zip(places) {
            let place_name = format!("{what}, control step {step}, robot {place}");
            here[place].assert_equals(other, &place_name);
        }
    }
}

/// Thirteen robots fill one block and part of a second, or of one in single precision. `broken`: how many at least must break
/// midway, to show that they do not touch the bits of their neighbours.
#[track_caller]
fn lanes_agree(scene: &str, steps: u64, broken: usize) {
    let model = model(scene);
    let robots: Vec<u64> = (0..13).collect();
    let mut wide = World::new(&model, &robots, Wide, 1);
    let in_lanes = run(&mut wide, steps);
    let runs = |&place: &usize| wide.batch.status(place) == Status::Running;
    let running = (0..13).filter(runs).count();
    assert!(running >= 5 && 13 - running >= broken, "{scene}: {running} of 13 run");
    let one_by_one = records(&model, &robots, Scalar, 1, steps);
    let places: Vec<usize> = (0..13).collect();
    assert_equal(&one_by_one, &in_lanes, &places, &format!("{scene}, scalar and wide"));
}

/// Observations aside, which a mean pitch scales.
#[test]
fn worms_and_rods_are_short_for_segments_with_equal_bits() {
    for (name, ..) in SCENES {
        let short = model(name);
        let long = Arc::new(Model::compile(&short.scene.in_segments()).expect("a model"));
        let mut worlds = [short, long].map(|model| World::new(&model, &[0, 1, 2], Wide, 1));
        for step in 0..30 {
            let [short, long] = worlds.each_mut().map(|world| {
                world.step();
                seen(world)
            });
            short.assert_equals(&long, &format!("{name}, control step {step}"));
        }
    }
}

/// What a view shows of three robots.
fn seen(world: &World) -> Record {
    let mut record = Record::default();
    let model = world.batch.model();
    for place in 0..3 {
        world.batch.view(place, |view| record.look(&view, model, model.contacts.len()));
    }
    record
}

#[test]
fn records_tell_robots_and_control_steps_apart() {
    for scene in ["three magnets", "three magnets in space"] {
        let records = records(&model(scene), &[0, 1, 2], Wide, 1, 20);
        let all: Vec<&Record> = records.iter().flatten().collect();
        assert!((1..all.len()).all(|k| !all[..k].contains(&all[k])));
    }
}

/// What the feet of robots in space do: [open, sticking], and sliding towards each of eight directions.
#[test]
fn robots_in_space_step_stick_and_slide_in_every_direction() {
    let model = model("three magnets in space");
    let robots: Vec<u64> = (0..13).collect();
    let mut world = World::new(&model, &robots, Wide, 1);
    let (mut open, mut stuck, mut slid) = (0, 0, [0; 8]);
    for _ in 0..150 {
        world.step();
        for place in 0..robots.len() {
            for contact in 0..model.contacts.len() {
                let [mode, _, x, z] = world.batch.view(place, |view| view.contact(contact))[..]
                else {
                    panic!("the tangential spring of a contact in space holds two impulses")
                };
                if mode == ContactMode::Open.code() {
                    open += 1;
                } else if mode == ContactMode::Stick.code() {
                    stuck += 1;
                } else {
                    let turns = z.atan2(x) / std::f64::consts::TAU + 1.0;
                    slid[(8.0 * turns) as usize % 8] += 1;
                }
            }
        }
    }
    println!("open {open}, sticking {stuck}, sliding {slid:?}");
    assert!(open > 100 && stuck > 100 && slid.iter().all(|&count| count > 20));
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_three_magnets() {
    lanes_agree("three magnets", 300, 3);
    lanes_agree("three magnets in space", 200, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_unequal_magnets() {
    lanes_agree("mixed magnets", 200, 3);
    lanes_agree("mixed magnets in space", 150, 3);
    lanes_agree("mixed dipoles in single precision in space", 150, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_magnets_on_each_other() {
    lanes_agree("five magnets on each other", 200, 3);
    lanes_agree("three magnets on each other in single precision in space", 150, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_four_magnets() {
    lanes_agree("four magnets", 300, 3);
    lanes_agree("four magnets in space without yaw", 150, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_five_magnets() {
    lanes_agree("five magnets", 300, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_on_a_belt() {
    lanes_agree("belt", 300, 3);
    lanes_agree("belt in space", 200, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_a_cantilever() {
    lanes_agree("cantilever", 300, 1);
    lanes_agree("cantilever in space", 200, 1);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_on_an_incline() {
    lanes_agree("incline", 300, 1);
    lanes_agree("incline in space", 200, 1);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_with_lagrange_multipliers() {
    lanes_agree("multipliers", 200, 1);
    lanes_agree("multipliers in space", 120, 1);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_rubber_that_relaxes() {
    lanes_agree("relaxing rubber", 300, 3);
    lanes_agree("relaxing rubber in space", 150, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_a_drive_that_gives_way() {
    lanes_agree("suspended drive", 300, 3);
    lanes_agree("suspended drive in space", 150, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_in_a_uniform_field() {
    lanes_agree("uniform field", 300, 3);
    lanes_agree("uniform field in space", 150, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_dipoles_with_varied_parameters() {
    lanes_agree("dipoles with varied parameters", 300, 3);
    lanes_agree("dipoles with varied parameters in space", 200, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_on_waypoints() {
    lanes_agree("waypoints", 200, 3);
    lanes_agree("waypoints in space", 150, 3);
}

/// Robots start afresh between two control steps, and every third of these is followed by three solver steps; so robots
/// side by side are due in different steps.
#[test]
fn scalar_and_wide_lanes_give_equal_bits_where_wrenches_are_held() {
    lanes_agree("held wrenches", 300, 3);
    lanes_agree("held wrenches in space", 150, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_in_single_precision() {
    lanes_agree("single precision", 300, 3);
    lanes_agree("belt in single precision", 200, 3);
    lanes_agree("single precision in space", 200, 3);
    lanes_agree("dipoles in single precision in space", 150, 3);
    lanes_agree("cantilever in single precision in space", 200, 1);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_bent_starts() {
    lanes_agree("rolled up", 200, 3);
    lanes_agree("twisted in space", 150, 3);
}

#[test]
fn any_number_of_threads_gives_equal_bits() {
    let robots: Vec<u64> = (0..61).collect();
    let places: Vec<usize> = (0..61).collect();
    for (scene, steps) in
        [("three magnets", 40), ("three magnets in space", 25), ("single precision", 40)]
    {
        let model = model(scene);
        for lanes in [Wide, Scalar] {
            let alone = records(&model, &robots, lanes, 1, steps);
            for threads in [2, 3, 7] {
                let shared = records(&model, &robots, lanes, threads, steps);
                let what = format!("{scene}, {lanes:?}, {threads} threads");
                assert_equal(&alone, &shared, &places, &what);
            }
        }
    }
}

/// Each robot in a batch of its own, joined as if they had run together.
fn each_alone(model: &Arc<Model>, robots: u64, steps: u64) -> Vec<Vec<Record>> {
    let mut joined = vec![vec![]; steps as usize];
    for robot in 0..robots {
        for (row, mut record) in joined.iter_mut().zip(records(model, &[robot], Wide, 1, steps)) {
            row.append(&mut record);
        }
    }
    joined
}

#[test]
fn an_environment_in_a_batch_of_any_size_equals_the_same_alone() {
    for (scene, steps) in [
        ("three magnets", 40),
        ("belt", 40),
        ("three magnets in space", 25),
        ("belt in space", 25),
        ("single precision in space", 25),
    ] {
        let model = model(scene);
        let alone = each_alone(&model, 64, steps);
        for count in [1, 5, 8, 13, 64] {
            let robots: Vec<u64> = (0..count).collect();
            let places: Vec<usize> = (0..count as usize).collect();
            let together = records(&model, &robots, Wide, 2, steps);
            assert_equal(&alone, &together, &places, &format!("{scene}, batch of {count}"));
        }
    }
}

#[test]
fn the_place_in_a_batch_does_not_matter() {
    let robots: Vec<u64> = (0..21).collect();
    // 8 is coprime to 21: every robot moves to another lane of another block.
    let places: Vec<usize> = (0..21).map(|place| (8 * place + 5) % 21).collect();
    let shuffled: Vec<u64> = places.iter().map(|&place| place as u64).collect();
    for scene in ["four magnets", "dipoles with varied parameters in space", "single precision"] {
        let model = model(scene);
        let in_order = records(&model, &robots, Wide, 1, 60);
        for lanes in [Wide, Scalar] {
            let moved = records(&model, &shuffled, lanes, 2, 60);
            assert_equal(&in_order, &moved, &places, &format!("{scene}, shuffled, {lanes:?}"));
        }
    }
}
