//! The robots of the presets in space: what the plane shows, and that they stay upright.

use crate::crawl::PASS;
use crate::report::Case;
use crate::world::World;

/// Greatest height of a magnet over rest, travel of the last magnet towards the head [m], greatest roll of
/// a magnet and heading at the end [rad].
struct Crawl {
    peak_m: f64,
    stride_m: f64,
    roll_rad: f64,
    heading_rad: f64,
}

/// A drive that passes under a preset's robot, or rises under its middle, in 2 or 3 dimensions.
fn crawl(preset: &str, motion: &str, duration_s: f64, dimensions: &str) -> Crawl {
    let edits = [
        ("dimensions", dimensions),
        ("drive.arrangement", "{kind='single'}"),
        ("drive.motion", motion),
    ];
    let mut world = World::new(preset, &edits);
    let magnets = world.model.magnets();
    let place = |world: &World, magnet| world.block.planar_pose(&world.model, magnet, 0);
    let last = magnets - 1;
    let (rest, start) = (place(&world, 0)[1], place(&world, last)[0]);
    let mut seen = Crawl { peak_m: 0.0, stride_m: 0.0, roll_rad: 0.0, heading_rad: 0.0 };
    for _ in 0..(duration_s / world.model.step_s).round() as u32 {
        world.steps(1);
        for magnet in 0..magnets {
            seen.peak_m = seen.peak_m.max(place(&world, magnet)[1] - rest);
            let roll = world.block.magnet_pose(&world.model, magnet, 0).roll_rad();
            seen.roll_rad = seen.roll_rad.max(roll.abs());
        }
    }
    seen.stride_m = start - place(&world, last)[0];
    seen.heading_rad = world.block.robot_pose(&world.model, 0, 0)[2];
    seen
}

/// Every preset crawls and rises in space as it does in the plane, within 1 %, and stays upright. Nothing in the
/// scene tips it, so what asymmetry there is has grown from rounding: a robot that cannot stand upright over
/// the drive would have fallen.
#[test]
fn validates_presets_in_space() {
    let mut case = Case::new("presets_in_space", "The presets in space")
        .equation("dimensions = 3 against dimensions = 2, drive at no lateral offset")
        .source("the planar kernel; band: 1 %")
        .scene("paper-3", &[("dimensions", "3"), ("drive.motion", PASS)])
        .note(
            "Greatest height of a magnet and stride of the last one in a pass at 100 mm/s, and the greatest \
            height while the drive rises from −52 to −22 mm under the middle, for each preset. Repelled \
            magnets want to roll over; the greatest roll of any magnet is what has grown from rounding.",
        );
    let (mut roll, mut heading) = (0.0f64, 0.0f64);
    for (preset, centre_m) in [("paper-3", 0.027), ("paper-4", 0.037), ("paper-5", 0.047)] {
        let lift = format!(
            "{{kind='waypoints',time_s=[0.0,0.5],x_m=[{centre_m},{centre_m}],y_m=[-0.052,-0.022]}}"
        );
        let (rise, flat_rise) = (crawl(preset, &lift, 0.8, "3"), crawl(preset, &lift, 0.8, "2"));
        let (pass, flat_pass) = (crawl(preset, PASS, 1.5, "3"), crawl(preset, PASS, 1.5, "2"));
        let off = |a: f64, b: f64| (a / b - 1.0).abs();
        case.at_most(
            format!("{preset}: lift"),
            "relative",
            off(rise.peak_m, flat_rise.peak_m),
            0.01,
        );
        case.at_most(
            format!("{preset}: peak"),
            "relative",
            off(pass.peak_m, flat_pass.peak_m),
            0.01,
        );
        let stride = off(pass.stride_m, flat_pass.stride_m);
        case.at_most(format!("{preset}: stride"), "relative", stride, 0.01);
        roll = roll.max(rise.roll_rad).max(pass.roll_rad);
        heading = heading.max(rise.heading_rad.abs()).max(pass.heading_rad.abs());
    }
    case.at_most("greatest roll", "rad", roll, 0.05);
    case.at_most("greatest heading afterwards", "rad", heading, 0.01);
    case.finish();
}
