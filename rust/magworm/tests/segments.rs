//! Bodies of segments: how they are meshed, changed one by one, and refused.

use magworm::scene::{Body, Scene};
use magworm::{Batch, LaneChoice, Model, Status};
use std::sync::Arc;

/// Three magnets of three sizes in feet of three sections, one on a bridge that is wider at its middle.
const MIXED: &str = r#"
[body]
kind = "segments"

[[body.segment]]
length_m = 0.014
thickness_m = 0.007
width_m = 0.011
foot = true
elements = 1
magnet = { length_m = 0.006, width_m = 0.007, height_m = 0.002, remanence_t = 1.2, density_kg_m3 = 7500 }

[[body.segment]]
length_m = 0.006
thickness_m = 0.004
width_m = 0.011
elements = 3

[[body.segment]]
length_m = 0.010
thickness_m = 0.006
width_m = 0.014
foot = true
elements = 2
magnet = { length_m = 0.005, width_m = 0.01, height_m = 0.003, remanence_t = 1.3, density_kg_m3 = 7000, angle_deg = 180, along_m = 0.001 }

[[body.segment]]
length_m = 0.008
thickness_m = 0.003
width_m = 0.009
elements = 2

[[body.segment]]
length_m = 0.012
thickness_m = 0.008
width_m = 0.012
foot = true
elements = 1
magnet = { length_m = 0.012, width_m = 0.006, height_m = 0.0015, remanence_t = 1.1, density_kg_m3 = 7500 }

[material]
youngs_modulus_pa = 5e4
density_kg_m3 = 1070

[ground]
static_friction = 1.0
dynamic_friction = 0.6
"#;

fn mixed(path: &str, value: Option<&str>) -> Result<Scene, String> {
    let value = value.map(|text| text.parse().expect("TOML"));
    let scene = Scene::from_toml(MIXED).expect("a scene");
    scene.with_values(&[(path.into(), value)]).map_err(|error| error.to_string())
}

#[test]
fn segments_are_meshed_one_after_another() {
    let model = Model::compile(&Scene::from_toml(MIXED).expect("a scene")).expect("a model");
    let mesh = &model.mesh;
    let expected =
        [0.0, 4.0, 10.0, 14.0, 16.0, 18.0, 20.0, 21.75, 23.5, 28.5, 29.25, 30.0, 34.0, 38.0, 50.0];
    assert_eq!(mesh.arc_m.len(), expected.len());
    for (arc_m, millimetres) in mesh.arc_m.iter().zip(expected) {
        assert!((arc_m - 1e-3 * millimetres).abs() < 1e-15, "{arc_m} m");
    }
    let bodies: Vec<usize> = model.bodies.iter().map(|body| body.element).collect();
    assert_eq!(bodies, [1, 8, 13]);
    let widths: Vec<f64> = mesh.elements.iter().map(|element| element.width_m).collect();
    assert_eq!(widths[..4], [0.011; 4]);
    assert_eq!((widths[6], widths[11], widths[13]), (0.014, 0.009, 0.012));
    assert_eq!(model.contacts.len(), 6);
    assert_eq!(model.magnets[1].remanence_t.signum(), -1.0);
    assert_eq!(model.thickness_m, 0.008);
}

/// The corners of a foot stand where they did, wherever its magnet is.
#[test]
fn a_magnet_moves_within_its_foot_and_the_foot_stays() {
    let corners = |along: &str| {
        let scene = mixed("body.segment[2].magnet.along_m", Some(along)).expect("a scene");
        let mesh = Model::compile(&scene).expect("a model").mesh;
        let body = mesh.bodies[1];
        let middle_m = 0.5 * (mesh.arc_m[body.element] + mesh.arc_m[body.element + 1]);
        let places = mesh.contact_points.iter().filter_map(|point| match point.frame {
            magworm::internals::Frame::Body(1) => Some(middle_m + point.place_m[0]),
            _ => None,
        });
        places.collect::<Vec<_>>()
    };
    for along in ["0", "0.001", "-0.002", "0.0025"] {
        let places = corners(along);
        assert!((places[0] - 0.020).abs() < 1e-12 && (places[1] - 0.030).abs() < 1e-12);
    }
}

#[test]
fn one_field_of_one_segment_is_replaced() {
    let scene = mixed("body.segment[2].thickness_m", Some("0.0065")).expect("a scene");
    let Body::Segments(body) = &scene.body else { panic!("segments") };
    assert_eq!(body.segment[2].thickness_m, 0.0065);
    let scene = mixed("body.segment[0].magnet.height_m", Some("0.0025")).expect("a scene");
    let Body::Segments(body) = &scene.body else { panic!("segments") };
    assert_eq!(body.segment[0].magnet.as_ref().map(|magnet| magnet.height_m), Some(0.0025));
    let whole = "{ length_m = 0.005, thickness_m = 0.004, width_m = 0.01, elements = 2 }";
    let scene = mixed("body.segment[1]", Some(whole)).expect("a scene");
    let Body::Segments(body) = &scene.body else { panic!("segments") };
    assert_eq!(body.segment[1].length_m, 0.005);
}

#[test]
fn paths_into_lists_are_refused_in_a_sentence() {
    for (path, value, sentence) in [
        (
            "body.segment[5].thickness_m",
            Some("0.004"),
            "body.segment is a list of 5; allowed: 6 entries or more where [5] is replaced",
        ),
        (
            "body.segment[1].colour",
            Some("1"),
            "body.segment[1].colour is not a field of a scene; body.segment[1] has: length_m, thickness_m, width_m, foot, elements, magnet",
        ),
        (
            "body.segment[1].magnet.height_m",
            Some("0.001"),
            "body.segment[1].magnet.length_m is missing; allowed: 1e-4 to 0.5 m",
        ),
        (
            "body.segment[1]",
            None,
            "body.segment[1] cannot be removed; it is needed by body.segment",
        ),
        (
            "body.segment[1].length_m",
            None,
            "body.segment[1].length_m cannot be removed; it is needed by body.segment[1]",
        ),
        (
            "body[1].kind",
            Some("'rod'"),
            "body[1] is not a field of a scene; the scene has: name, gravity_m_s2, dimensions, body, material, magnet, ground, contact, drive, field, magnetic_terms, start, solver, control, reset",
        ),
    ] {
        assert_eq!(mixed(path, value).expect_err(path), sentence);
    }
    // Lists of numbers have places too.
    let bent = mixed("start.bends_deg", Some("[10, 20]")).expect("a scene");
    let more = bent.with_values(&[("start.bends_deg[1]".into(), Some(30.into()))]);
    assert_eq!(more.expect("a scene").start.bends_deg, [10.0, 30.0]);
}

#[test]
fn segments_that_cannot_be_built_are_refused_in_a_sentence() {
    for (path, value, sentence) in [
        ("body.segment", "[]", "body.segment is a list of 0; allowed: 1 segment or more"),
        (
            "body.segment[1].foot",
            "true",
            "body.segment[1].foot is true; allowed: false without a magnet, which a foot's corners turn with",
        ),
        (
            "body.segment[0].magnet.height_m",
            "0.008",
            "body.segment[0].magnet.height_m is 0.008 m; allowed: at most body.segment[0].thickness_m = 0.007 m",
        ),
        (
            "body.segment[0].magnet.along_m",
            "0.005",
            "body.segment[0].magnet.along_m is 0.005 m; allowed: -0.004 to 0.004 m, within its segment",
        ),
        (
            "body.segment[2].magnet.up_m",
            "-0.002",
            "body.segment[2].magnet.up_m is -0.002 m; allowed: -0.0015 to 0.0015 m, within its segment",
        ),
        (
            "body.segment[0].magnet.aside_deg",
            "5",
            "body.segment[0].magnet.aside_deg is 5°; allowed: 0 where dimensions = 2",
        ),
        (
            "body.segment[0].magnet.aside_m",
            "0.001",
            "body.segment[0].magnet.aside_m is 0.001 m; allowed: 0 where dimensions = 2",
        ),
        (
            "body.segment[1].elements",
            "700",
            "body.segment[1].elements is 700; allowed: at most 600, each 1e-5 m or longer, in a length of 0.006 m",
        ),
        (
            "body.clamp",
            "'head'",
            "body.segment[0].magnet is a table; allowed: none where body.clamp is \"head\"",
        ),
        (
            "magnet",
            "{ length_m = 0.005, width_m = 0.005, height_m = 0.002, remanence_t = 1, density_kg_m3 = 7500 }",
            "magnet is a table; allowed: none where body.kind is \"segments\", which hold their own magnets",
        ),
    ] {
        assert_eq!(mixed(path, Some(value)).expect_err(path), sentence);
    }
    let full = mixed("body.segment[4].width_m", Some("0.006")).and_then(|scene| {
        let height = [("body.segment[4].magnet.height_m".to_string(), Some(0.008.into()))];
        scene.with_values(&height).map_err(|error| error.to_string())
    });
    assert_eq!(
        full.expect_err("no rubber at the tail"),
        "body.segment[4].magnet.height_m is 0.008 m; allowed: less than the segment's thickness where the body ends with a magnet as wide"
    );
}

/// Its stable step is unknown where motions along and across the body meet.
#[test]
fn the_explicit_scheme_refuses_magnets_beside_the_middle() {
    let explicit = [
        ("body.segment[2].magnet.up_m".into(), Some(0.001.into())),
        ("solver.integrator".into(), Some("explicit".into())),
        ("solver.step_s".into(), Some(1e-5.into())),
    ];
    let scene = Scene::from_toml(MIXED).expect("a scene").with_values(&explicit);
    assert_eq!(
        scene.expect_err("explicit").to_string(),
        "solver.integrator is \"explicit\"; allowed: newmark and euler where body.segment[2].magnet has up_m or aside_m"
    );
}

/// Rubber holds magnets apart: one element is enough.
#[test]
fn magnets_next_to_each_other_need_rubber_between_them() {
    let flush = |place: usize, length: &str| {
        (format!("body.segment[{place}].magnet.length_m"), Some(length.parse().expect("TOML")))
    };
    let close = Scene::from_toml(MIXED).expect("a scene").with_values(&[
        ("body.segment[2].magnet.along_m".into(), None),
        flush(0, "0.014"),
        flush(2, "0.01"),
        ("body.segment[1].elements".into(), Some(1.into())),
        ("body.segment[3].elements".into(), Some(1.into())),
        // Which would fold it up.
        ("magnetic_terms.mutual".into(), Some(false.into())),
    ]);
    let close = close.expect("one element between them");
    for dimensions in [2, 3] {
        for elements in [1, 2, 3] {
            let scene = close.with_values(&[
                ("dimensions".into(), Some(dimensions.into())),
                ("body.segment[1].elements".into(), Some(elements.into())),
            ]);
            let model = Arc::new(Model::compile(&scene.expect("a scene")).expect("a model"));
            let mut batch = Batch::new(model, 1, LaneChoice::Scalar, Some(1));
            batch.reset(0, 1, 0, None);
            batch.advance(200);
            assert_eq!(batch.status(0), Status::Running, "{elements} elements");
        }
    }
    let Body::Segments(mut body) = close.body.clone() else { panic!("segments") };
    body.segment.remove(1);
    let touching = Scene { body: Body::Segments(body), ..close };
    assert_eq!(
        touching.validate().expect_err("two magnets share a node").to_string(),
        "body.segment[1].magnet.length_m is 0.01 m; allowed: less than its segment's length, or rubber between it and the magnet of body.segment[0]"
    );
}

#[test]
fn a_message_names_the_line_of_the_segment() {
    let text = MIXED.replace("thickness_m = 0.003", "thickness_m = 3");
    let error = Scene::from_toml(&text).expect_err("too thick");
    let line = 1 + text.lines().position(|line| line == "thickness_m = 3").expect("the line");
    assert_eq!(error.line, Some(line));
    assert_eq!(
        error.to_string(),
        format!("line {line}: body.segment[3].thickness_m is 3 m; allowed: 1e-4 to 0.03 m")
    );
}
