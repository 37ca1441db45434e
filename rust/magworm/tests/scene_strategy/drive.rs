//! Random drives: every arrangement, every motion.

use magworm::scene::*;

use super::dice::Dice;

pub fn drive(dice: &mut Dice, dimensions: usize) -> Drive {
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
        suspension: suspension(dice),
        motion: motion(dice, above_m, dimensions),
    }
}

/// Magnets of every other drive give way.
pub fn suspension(dice: &mut Dice) -> Option<Suspension> {
    dice.coin().then(|| Suspension {
        mass_kg: dice.decades(1e-3, 100.0),
        stiffness_n_m: dice.decades(1.0, 1e7),
        damping_n_s_m: if dice.coin() { 0.0 } else { dice.decades(1e-3, 1e4) },
    })
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

fn motion(dice: &mut Dice, above_m: f64, dimensions: usize) -> Motion {
    match dice.one_of(&[0, 1, 2]) {
        0 => Motion::Controlled(stage(dice, above_m, dimensions)),
        1 => Motion::Constant {
            x_m: dice.between(-10.0, 10.0),
            y_m: dice.between(-1.0, 1.0),
            speed_m_s: dice.between(-10.0, 10.0),
            z_m: dice.in_space(dimensions, -10.0, 10.0),
            yaw_deg: dice.in_space(dimensions, -360.0, 360.0),
        },
        _ => waypoints(dice, dimensions),
    }
}

fn stage(dice: &mut Dice, above_m: f64, dimensions: usize) -> StageLimits {
    let highest_m = -dice.decades(above_m + 1e-9, 0.9);
    StageLimits {
        reach_m: dice.decades(1e-4, 10.0),
        lowest_m: dice.between(-1.0, highest_m - 1e-6),
        highest_m,
        speed_m_s: dice.decades(1e-4, 10.0),
        acceleration_m_s2: dice.decades(1e-3, 1e6),
        lateral_reach_m: dice.in_space(dimensions, 0.0, 10.0),
        yaw_reach_deg: dice.in_space(dimensions, 0.0, 180.0),
        yaw_speed_deg_s: dice.decades(1e-3, 1e5),
        yaw_acceleration_deg_s2: dice.decades(1e-3, 1e8),
    }
}

fn waypoints(dice: &mut Dice, dimensions: usize) -> Motion {
    let mut time_s = vec![0.0];
    for place in 0..dice.whole(0, 15) {
        time_s.push(time_s[place] + dice.decades(1.1e-6, 10.0));
    }
    Motion::Waypoints {
        x_m: walk(dice, &time_s, 10.0, 9.99),
        y_m: walk(dice, &time_s, 1.0, 9.99),
        z_m: walk_in_space(dice, dimensions, &time_s, 10.0, 9.99),
        yaw_deg: walk_in_space(dice, dimensions, &time_s, 36_000.0, 9.99e3),
        time_s,
    }
}

/// Places from −`farthest` to `farthest`, no faster apart than `fastest`.
fn walk(dice: &mut Dice, time_s: &[f64], farthest: f64, fastest: f64) -> Vec<f64> {
    let mut at = vec![dice.between(-farthest, farthest)];
    for (place, pair) in time_s.windows(2).enumerate() {
        let reach = fastest * (pair[1] - pair[0]);
        at.push((at[place] + dice.between(-reach, reach)).clamp(-farthest, farthest));
    }
    at
}

/// A walk in space; in the plane, and now and then in space, one of the two ways to write 0.
fn walk_in_space(
    dice: &mut Dice,
    dimensions: usize,
    time_s: &[f64],
    farthest: f64,
    fastest: f64,
) -> Vec<f64> {
    match dice.one_of(&[0, 1, 2, 3]) {
        0 => vec![],
        1 => vec![0.0; time_s.len()],
        _ if dimensions > 2 => walk(dice, time_s, farthest, fastest),
        _ => vec![],
    }
}
