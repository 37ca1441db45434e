//! Random drives: every arrangement, every motion.

use magworm::scene::*;

use super::dice::Dice;

pub fn drive(dice: &mut Dice) -> Drive {
    let (length_m, height_m) = (dice.decades(1e-4, 0.5), dice.decades(1e-4, 0.5));
    let reference = dice.one_of(&[Reference::Centre, Reference::Top]);
    let above_m = if reference == Reference::Centre { 0.5 * height_m } else { 0.0 };
    Drive {
        length_m,
        width_m: dice.decades(1e-4, 0.5),
        height_m,
        remanence_t: dice.between(0.0, 10.0),
        reference,
        arrangement: arrangement(dice, length_m),
        motion: motion(dice, above_m),
    }
}

fn arrangement(dice: &mut Dice, length_m: f64) -> Arrangement {
    match dice.one_of(&[0, 1, 2]) {
        0 => Arrangement::Single,
        1 => Arrangement::Pair {
            spacing_m: dice.decades(length_m, 1.0),
            second_polarity: dice.polarity(),
        },
        _ => Arrangement::Belt {
            pitch_m: dice.decades(length_m.max(1e-3), 10.0),
            count: dice.whole(1, 16),
        },
    }
}

fn motion(dice: &mut Dice, above_m: f64) -> Motion {
    match dice.one_of(&[0, 1, 2]) {
        0 => Motion::Controlled(stage(dice, above_m)),
        1 => Motion::Constant {
            x_m: dice.between(-10.0, 10.0),
            y_m: dice.between(-1.0, 1.0),
            speed_m_s: dice.between(-10.0, 10.0),
        },
        _ => waypoints(dice),
    }
}

fn stage(dice: &mut Dice, above_m: f64) -> StageLimits {
    let highest_m = -dice.decades(above_m + 1e-9, 0.9);
    StageLimits {
        reach_m: dice.decades(1e-4, 10.0),
        lowest_m: dice.between(-1.0, highest_m - 1e-6),
        highest_m,
        speed_m_s: dice.decades(1e-4, 10.0),
        acceleration_m_s2: dice.decades(1e-3, 1e6),
    }
}

fn waypoints(dice: &mut Dice) -> Motion {
    let (mut time_s, mut x_m, mut y_m) = (vec![0.0], vec![], vec![]);
    x_m.push(dice.between(-10.0, 10.0));
    y_m.push(dice.between(-1.0, 1.0));
    for place in 0..dice.whole(0, 15) {
        let pause_s = dice.decades(1.1e-6, 10.0);
        let farthest_m = 9.99 * pause_s;
        time_s.push(time_s[place] + pause_s);
        x_m.push((x_m[place] + dice.between(-farthest_m, farthest_m)).clamp(-10.0, 10.0));
        y_m.push((y_m[place] + dice.between(-farthest_m, farthest_m)).clamp(-1.0, 1.0));
    }
    Motion::Waypoints { time_s, x_m, y_m }
}
