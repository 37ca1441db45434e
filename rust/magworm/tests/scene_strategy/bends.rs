//! Random bent starts: a part of the body or all of it, by little or by many turns, as far as the body can be bent.

use magworm::scene::{Scene, Start};

use super::dice::Dice;

/// Numbers that [`bend`] reads at most.
pub const NUMBERS: usize = 64;
const MAX_PARTS: usize = 8;

/// Bends the start of a scene; every other one stays straight.
pub fn bend(mut scene: Scene, dice: &mut Dice) -> Scene {
    if dice.coin() {
        return scene;
    }
    scene.start.bends_deg = angles(dice);
    if scene.dimensions > 2 {
        scene.start.bends_aside_deg = angles(dice);
        scene.start.twists_deg = angles(dice);
    }
    as_far_as_it_goes(scene)
}

fn angles(dice: &mut Dice) -> Vec<f64> {
    let (parts, greatest_deg) = (dice.whole(0, MAX_PARTS), dice.decades(1.0, 36_000.0));
    let angle = |dice: &mut Dice| {
        let share = dice.between(-1.0, 1.0);
        if dice.coin() { share * greatest_deg } else { share.signum() * greatest_deg }
    };
    (0..parts).map(|_| angle(dice)).collect()
}

/// Halves what is refused, and leaves out what remains so.
fn as_far_as_it_goes(mut scene: Scene) -> Scene {
    while let Err(error) = scene.validate() {
        let field = error.problem.field().expect("a field").to_owned();
        let (name, part) = match field.split_once('[') {
            Some((name, part)) => (name, part.trim_end_matches(']').parse::<usize>().ok()),
            None => (field.as_str(), None),
        };
        let list = list(&mut scene.start, name).unwrap_or_else(|| panic!("{error}"));
        match part {
            Some(part) if list[part].abs() > 1.0 => list[part] *= 0.5,
            Some(part) => list[part] = 0.0,
            None => list.truncate(list.len() / 2),
        }
    }
    scene
}

fn list<'a>(start: &'a mut Start, name: &str) -> Option<&'a mut Vec<f64>> {
    match name {
        "start.bends_deg" => Some(&mut start.bends_deg),
        "start.bends_aside_deg" => Some(&mut start.bends_aside_deg),
        "start.twists_deg" => Some(&mut start.twists_deg),
        _ => None,
    }
}
