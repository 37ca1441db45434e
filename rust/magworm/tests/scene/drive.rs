//! Rules of what moves the field, and of what leaves the plane.

use crate::scene_example::{edited, refuses};
use magworm::scene::Scene;

#[test]
fn refuses_drives_that_cannot_move() {
    for (path, value, sentence) in [
        (
            "drive.motion.lowest_m",
            "-0.02",
            "drive.motion.lowest_m is -0.02 m; allowed: less than drive.motion.highest_m = -0.022 m",
        ),
        (
            "drive.motion.highest_m",
            "-0.002",
            "drive.motion.highest_m is -0.002 m; allowed: less than -0.002 m: top faces stay beneath y = 0",
        ),
        (
            "drive.arrangement",
            "{ kind = \"pair\", spacing_m = 0.03, second_polarity = 1 }",
            "drive.arrangement.spacing_m is 0.03 m; allowed: at least drive.length_m = 0.04 m",
        ),
        (
            "drive.arrangement",
            "{ kind = \"belt\", pitch_m = 0.03, count = 2 }",
            "drive.arrangement.pitch_m is 0.03 m; allowed: at least drive.length_m = 0.04 m",
        ),
        (
            "drive.arrangement",
            "{ kind = \"pair\", spacing_m = 0.05, second_polarity = 2 }",
            "drive.arrangement.second_polarity is 2; allowed: 1 or -1",
        ),
    ] {
        refuses("example", path, value, sentence);
    }
    let top = [("drive.reference", Some("\"top\"")), ("drive.motion.highest_m", Some("-0.001"))];
    assert!(edited("example", &top).is_ok());
}

#[test]
fn refuses_waypoints_out_of_order() {
    let waypoints = |time: &str, x: &str, y: &str| {
        let motion = format!("{{ kind = \"waypoints\", time_s = {time}, x_m = {x}, y_m = {y} }}");
        edited("example", &[("drive.motion", Some(&motion))])
    };
    assert!(waypoints("[0, 0.5, 0.8]", "[0, 0, 0]", "[-0.052, -0.022, -0.022]").is_ok());
    assert!(waypoints("[0]", "[0]", "[0.01]").is_ok());
    for (time, x, y, sentence) in [
        ("[]", "[]", "[]", "time_s[0] is an empty list; allowed: 0 s"),
        ("[1]", "[0]", "[0]", "time_s[0] is 1 s; allowed: 0 s"),
        (
            "[0, 1]",
            "[0]",
            "[0, 0]",
            "x_m is a list of 1; allowed: a list of 2, as drive.motion.time_s",
        ),
        (
            "[0, 1]",
            "[0, 0]",
            "[0]",
            "y_m is a list of 1; allowed: a list of 2, as drive.motion.time_s",
        ),
        (
            "[0, 1, 1]",
            "[0, 0, 0]",
            "[0, 0, 0]",
            "time_s[2] is 1 s; allowed: 1.000001 s or more: times rise",
        ),
        ("[0, 0.1]", "[0, 2]", "[0, 0]", "x_m[1] is 2 m; allowed: -1 to 1 m: at most 10 m/s"),
        ("[0, nan]", "[0, 0]", "[0, 0]", "time_s[1] is NaN s; allowed: 0 to 1e5 s"),
    ] {
        assert_eq!(waypoints(time, x, y).unwrap_err(), format!("drive.motion.{sentence}"));
    }
}

#[test]
fn refuses_what_leaves_the_plane_in_two_dimensions() {
    let constant = "{ kind = \"constant\", x_m = 0, y_m = -0.03, speed_m_s = 0.1, ";
    let waypoints = "{ kind = \"waypoints\", time_s = [0, 1], x_m = [0, 0], y_m = [0, 0], ";
    let motion = |start: &str, more: &str| format!("{start}{more} }}");
    for (path, value, sentence) in [
        ("start.z_m", "-0.1".into(), "start.z_m is -0.1 m"),
        ("start.yaw_deg", "90".into(), "start.yaw_deg is 90°"),
        ("field", "{ x_t = 0, y_t = 0, z_t = 0.01 }".into(), "field.z_t is 0.01 T"),
        ("drive.motion.lateral_reach_m", "0.004".into(), "drive.motion.lateral_reach_m is 0.004 m"),
        ("drive.motion.yaw_reach_deg", "5".into(), "drive.motion.yaw_reach_deg is 5°"),
        ("drive.motion", motion(constant, "z_m = 0.004"), "drive.motion.z_m is 0.004 m"),
        ("drive.motion", motion(constant, "yaw_deg = -9"), "drive.motion.yaw_deg is -9°"),
        ("drive.motion", motion(waypoints, "z_m = [0, 0.1]"), "drive.motion.z_m[1] is 0.1 m"),
        ("drive.motion", motion(waypoints, "yaw_deg = [3, 0]"), "drive.motion.yaw_deg[0] is 3°"),
    ] {
        refuses("example", path, &value, &format!("{sentence}; allowed: 0 where dimensions = 2"));
        let space = [("dimensions", Some("3")), (path, Some(&value))];
        assert_eq!(edited("example", &space).map(|scene| scene.dimensions), Ok(3));
    }
    let still = motion(waypoints, "z_m = [0, -0.0], yaw_deg = [0, 0]");
    assert!(edited("example", &[("drive.motion", Some(&still))]).is_ok());
}

#[test]
fn refuses_waypoints_in_space_as_in_the_plane() {
    let waypoints = |z: &str, yaw: &str| {
        let motion = format!(
            "{{ kind = \"waypoints\", time_s = [0, 0.1], x_m = [0, 0], y_m = [0, 0], \
             z_m = {z}, yaw_deg = {yaw} }}"
        );
        edited("example", &[("dimensions", Some("3")), ("drive.motion", Some(&motion))])
    };
    assert!(waypoints("[]", "[0, 1000]").is_ok());
    assert!(waypoints("[0.5, -0.5]", "[]").is_ok());
    let lists = "allowed: a list of 2, as drive.motion.time_s, or an empty one";
    for (z, yaw, sentence) in [
        ("[0]", "[]", format!("z_m is a list of 1; {lists}")),
        ("[]", "[0, 0, 0]", format!("yaw_deg is a list of 3; {lists}")),
        ("[0, 2]", "[]", "z_m[1] is 2 m; allowed: -1 to 1 m: at most 10 m/s".into()),
        (
            "[]",
            "[10, -1000]",
            "yaw_deg[1] is -1000°; allowed: -990 to 1010°: at most 10000 °/s".into(),
        ),
        ("[]", "[0, 36001]", "yaw_deg[1] is 36001°; allowed: -36000 to 36000°".into()),
    ] {
        assert_eq!(waypoints(z, yaw).unwrap_err(), format!("drive.motion.{sentence}"));
    }
}

#[test]
fn a_drive_without_magnets_is_inert_and_allowed() {
    let drive = Scene::preset("paper-3").unwrap().drive;
    let mut scene = Scene::preset("cantilever").unwrap();
    scene.drive = drive;
    assert_eq!(scene.validate(), Ok(()));
}
