//! What scenes may say of contact.

use crate::scene_example::{edited, refuses};

#[test]
fn refuses_edges_that_are_rounder_than_feet() {
    let most = "allowed: at most 0.0035 m, half of the shortest edge of a foot";
    let path = "contact.edge_radius_m";
    refuses("example", path, "0.0036", &format!("{path} is 0.0036 m; {most}"));
    assert!(edited("example", &[(path, Some("0.0035"))]).is_ok());
    let of_none = "allowed: at most 0 m, half of the shortest edge of a foot";
    refuses("cantilever", path, "0.001", &format!("{path} is 0.001 m; {of_none}"));
}

#[test]
fn refuses_feet_that_touch_each_other_where_they_cannot() {
    let path = "contact.between_feet";
    let refusal = |edits: &[(&str, Option<&str>)], words: &str| {
        let edits = [edits, &[(path, Some("true"))]].concat();
        let sentence = format!("{path} is true; allowed: false {words}");
        assert_eq!(edited("example", &edits).unwrap_err(), sentence);
    };
    refusal(&[("ground", None)], "without [ground], whose contact springs feet have");
    refusal(&[("body.magnets", Some("1"))], "where the body has less than two feet");
    refusal(
        &[("solver.integrator", Some("'explicit'"))],
        "where solver.integrator is \"explicit\"",
    );
}

#[test]
fn refuses_rebound_beyond_elastic_and_without_ground() {
    let path = "contact.restitution";
    refuses("example", path, "1.1", &format!("{path} is 1.1; allowed: 0 to 1"));
    refuses("example", path, "-0.1", &format!("{path} is -0.1; allowed: 0 to 1"));
    let from = "contact.restitution_from_m_s";
    refuses("example", from, "-0.1", &format!("{from} is -0.1 m/s; allowed: 0 to 100 m/s"));
    let edits = [("ground", None), (path, Some("0.5"))];
    let sentence =
        format!("{path} is 0.5; allowed: 0 without [ground], whose contact springs touch");
    assert_eq!(edited("example", &edits).unwrap_err(), sentence);
}

#[test]
fn refuses_nodes_with_what_only_feet_have() {
    let allowed =
        "allowed: feet in space, with contact.edge_radius_m and with contact.between_feet";
    for (path, value) in
        [("dimensions", "3"), ("contact.edge_radius_m", "0.001"), ("contact.between_feet", "true")]
    {
        let edits = [(path, Some(value)), ("contact.points", Some("'nodes'"))];
        let sentence = format!("contact.points is nodes; {allowed}");
        assert_eq!(edited("example", &edits).unwrap_err(), sentence);
    }
}
