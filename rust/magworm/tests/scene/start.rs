//! Rules of the pose and shape that a body starts with.

use crate::scene_example::{edited, refuses};

#[test]
fn refuses_starts_that_a_body_cannot_be_bent_to() {
    let (rod, worm) = ("cantilever", "example");
    let many = format!("[{}]", ["1"; 27].join(", "));
    let magnet = format!("[0, 5{}]", ", 0".repeat(11));
    let elbow = format!("[{}151{}]", "0, ".repeat(9), ", 0".repeat(16));
    for (scene, path, value, rest) in [
        (rod, "bends_deg", "30", " is 30; allowed: a list of at most 1000, each -36000 to 36000°"),
        (rod, "bends_deg", "[nan]", "[0] is NaN°; allowed: -36000 to 36000°"),
        (rod, "bends_deg", "[0, 4e4]", "[1] is 40000°; allowed: -36000 to 36000°"),
        (
            rod,
            "bends_deg",
            &many,
            " is a list of 27; allowed: a list of at most 26, as many as the body has nodes that bend",
        ),
        (
            rod,
            "bends_deg",
            "[2e4, -2e4]",
            " is 40000° in all, signs aside; allowed: at most 36000°",
        ),
        (
            worm,
            "bends_deg",
            &magnet,
            "[1] is 5°; allowed: 0 where nothing bends in a part of the body",
        ),
        (worm, "twists_deg", "[0, 9]", "[1] is 9°; allowed: 0 where dimensions = 2"),
        (worm, "bends_aside_deg", "[-3]", "[0] is -3°; allowed: 0 where dimensions = 2"),
        (
            rod,
            "bends_deg",
            "[2600, -2600]",
            "[0] is 2600°; allowed: an angle of at most 150° at a node, here 196.2264151° at node 1 of 28, counted from 0 at the head",
        ),
    ] {
        refuses(scene, &format!("start.{path}"), value, &format!("start.{path}{rest}"));
    }
    assert!(edited(rod, &[("start.bends_deg", Some(&elbow))]).is_ok());
    let sharper = elbow.replace("151", "310");
    let here = "allowed: an angle of at most 150° at a node, here";
    let error = edited(rod, &[("start.bends_deg", Some(&sharper))]).unwrap_err();
    assert!(error.starts_with(&format!("start.bends_deg[9] is 310°; {here}")), "{error}");

    // Twists at a node count for themselves, and bends the more the more it twists.
    let space = ("dimensions", Some("3"));
    let spun = [space, ("start.twists_deg", Some("[4500]"))];
    let twist = "allowed: a twist of at most 150° at a node, here 173.0769231° at node 1 of 28";
    let error = edited(rod, &spun).unwrap_err();
    assert!(error.starts_with(&format!("start.twists_deg[0] is 4500°; {twist}")), "{error}");
    let both = |aside| {
        let lists = [("start.bends_deg", Some("[2000]")), ("start.bends_aside_deg", Some(aside))];
        edited(rod, &[&[space, ("start.twists_deg", Some("[2500]"))], &lists[..]].concat())
    };
    assert_eq!(both("[1500]").map(|scene| scene.start.bends_deg), Ok(vec![2000.0]));
    let error = both("[3000]").unwrap_err();
    assert!(error.starts_with(&format!("start.bends_aside_deg[0] is 3000°; {here}")), "{error}");
}
