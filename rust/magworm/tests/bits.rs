//! Equal bits, however environments are laid out: lanes, threads, batch sizes, places in a batch.

mod bits_world;

use bits_world::{Record, World, run};
use magworm::model::Model;
use magworm::scene::Scene;
use magworm::state::LaneChoice::{self, Scalar, Wide};
use magworm::state::Status;
use std::sync::Arc;

fn compile(preset: &str, edits: &[(&str, &str)]) -> Arc<Model> {
    let edits: Vec<_> = edits
        .iter()
        .map(|(path, value)| (path.to_string(), Some(value.parse().expect("TOML"))))
        .collect();
    let scene = Scene::preset(preset).and_then(|scene| scene.with_values(&edits));
    Arc::new(Model::compile(&scene.expect("a valid scene")).expect("a model"))
}

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

/// Thirteen robots fill one block and part of a second. `broken`: how many at least must break
/// midway, to show that they do not touch the bits of their neighbours.
#[track_caller]
fn lanes_agree(model: &Arc<Model>, steps: u64, broken: usize) {
    let robots: Vec<u64> = (0..13).collect();
    let mut wide = World::new(model, &robots, Wide, 1);
    let in_lanes = run(&mut wide, steps);
    let runs = |&place: &usize| wide.batch.status(place) == Status::Running;
    let running = (0..13).filter(runs).count();
    assert!(running >= 5 && 13 - running >= broken, "{running} of 13 run");
    let one_by_one = records(model, &robots, Scalar, 1, steps);
    let places: Vec<usize> = (0..13).collect();
    assert_equal(&one_by_one, &in_lanes, &places, "scalar and wide");
}

#[test]
fn records_tell_robots_and_control_steps_apart() {
    let records = records(&compile("paper-3", &[]), &[0, 1, 2], Wide, 1, 20);
    let all: Vec<&Record> = records.iter().flatten().collect();
    assert!((1..all.len()).all(|k| !all[..k].contains(&all[k])));
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_three_magnets() {
    lanes_agree(&compile("paper-3", &[]), 300, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_four_magnets() {
    lanes_agree(&compile("paper-4", &[]), 300, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_five_magnets() {
    lanes_agree(&compile("paper-5", &[]), 300, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_on_a_belt() {
    lanes_agree(&compile("belt-125", &[]), 300, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_a_cantilever() {
    lanes_agree(&compile("cantilever", &[]), 300, 1);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_on_an_incline() {
    lanes_agree(&compile("incline-block", &[]), 300, 1);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_with_lagrange_multipliers() {
    let explicit = [
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "1e-5"),
        ("control.step_s", "5e-4"),
        ("material.damping_time_s", "1e-4"),
    ];
    lanes_agree(&compile("paper-3", &explicit), 200, 1);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_in_a_uniform_field() {
    let field = [("field", "{ x_t = 0.01, y_t = -0.02 }")];
    lanes_agree(&compile("paper-4", &field), 300, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_for_dipoles_with_varied_parameters() {
    let varied = [
        ("solver.magnet_model", "'dipole'"),
        ("ground.adhesion_n", "1e-4"),
        ("drive.arrangement", "{ kind = 'pair', spacing_m = 0.06, second_polarity = -1 }"),
        ("reset.vary", "[{ parameter = 'stiffness', low = 0.5, high = 2.0 }]"),
    ];
    lanes_agree(&compile("paper-3", &varied), 300, 3);
}

#[test]
fn scalar_and_wide_lanes_give_equal_bits_on_waypoints() {
    let motion = "{ kind = 'waypoints', time_s = [0.0, 0.3, 1.1], x_m = [0.02, 0.02, 0.1], \
                  y_m = [-0.052, -0.022, -0.03] }";
    lanes_agree(&compile("paper-3", &[("drive.motion", motion)]), 200, 3);
}

#[test]
fn any_number_of_threads_gives_equal_bits() {
    let model = compile("paper-3", &[]);
    let robots: Vec<u64> = (0..61).collect();
    let places: Vec<usize> = (0..61).collect();
    for lanes in [Wide, Scalar] {
        let alone = records(&model, &robots, lanes, 1, 40);
        for threads in [2, 3, 7] {
            let shared = records(&model, &robots, lanes, threads, 40);
            assert_equal(&alone, &shared, &places, &format!("{lanes:?}, {threads} threads"));
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
    for preset in ["paper-3", "belt-125"] {
        let model = compile(preset, &[]);
        let alone = each_alone(&model, 64, 40);
        for count in [1, 5, 8, 13, 64] {
            let robots: Vec<u64> = (0..count).collect();
            let places: Vec<usize> = (0..count as usize).collect();
            let together = records(&model, &robots, Wide, 2, 40);
            assert_equal(&alone, &together, &places, &format!("{preset}, batch of {count}"));
        }
    }
}

#[test]
fn the_place_in_a_batch_does_not_matter() {
    let model = compile("paper-4", &[]);
    let robots: Vec<u64> = (0..21).collect();
    let in_order = records(&model, &robots, Wide, 1, 60);
    // 8 is coprime to 21: every robot moves to another lane of another block.
    let places: Vec<usize> = (0..21).map(|place| (8 * place + 5) % 21).collect();
    let shuffled: Vec<u64> = places.iter().map(|&place| place as u64).collect();
    for lanes in [Wide, Scalar] {
        let moved = records(&model, &shuffled, lanes, 2, 60);
        assert_equal(&in_order, &moved, &places, &format!("shuffled, {lanes:?}"));
    }
}
