//! Bodies that start bent: the strains that were asked for, the places that follow, and nothing new where they are straight.

#[path = "../base/mod.rs"]
mod base;
mod places;
mod strains;
mod world;

use magworm::Model;
use magworm::scene::Scene;
use world::{BODIES, Edits, MANY, ROD, SPACE, TWISTS, Vector, World, scene};

#[test]
fn zeros_are_straight_bit_for_bit_and_leave_no_trace() {
    for (preset, edits) in BODIES {
        for in_space in [false, true] {
            let space: &Edits<'_> = if in_space { &[SPACE] } else { &[] };
            let zeros: &Edits<'_> = &[
                ("start.bends_deg", "[0, -0.0]"),
                ("start.bends_aside_deg", "[0]"),
                ("start.twists_deg", "[]"),
            ];
            let pose: &Edits<'_> = &[("start.angle_deg", "20"), ("start.height_m", "0.01")];
            let mut straight = World::new(preset, &[edits, space, pose]);
            let mut zero = World::new(preset, &[edits, space, pose, zeros]);
            assert!(straight.model.shape.is_none() && zero.model.shape.is_none());
            assert_eq!(straight.bits(), zero.bits());
            straight.runs(20);
            zero.runs(20);
            assert_eq!(straight.bits(), zero.bits());
            assert!(!straight.model.scene.to_toml().contains("bends"));
        }
    }
}

#[test]
fn a_bent_start_survives_toml_and_is_told() {
    let bent = scene("robot", &[&[SPACE, MANY, TWISTS]]);
    let text = bent.to_toml();
    assert!(text.contains("bends_deg = [30.0, -200.0,") && !text.contains("bends_aside_deg"));
    assert_eq!(Scene::from_toml(&text), Ok(bent.clone()));
    let told = Model::compile(&bent).expect("a model").explain();
    assert!(told.contains("start         bent by up to "), "{told}");
    assert!(!World::new("robot", &[]).model.explain().contains("start "));
    let error = Scene::from_toml(&text.replace("-200.0", "-2000.0")).unwrap_err();
    let line = 1 + text[..text.find("bends_deg").expect("the list")].matches('\n').count();
    assert!(error.to_string().starts_with(&format!("line {line}: start.bends_deg[1] is -2000°")));
}

/// Bending moments of even curvature balance at every node but those beside the ends: nothing else moves at first.
#[test]
fn an_even_arc_is_let_go_from_its_ends() {
    for in_space in [false, true] {
        let space: &Edits<'_> = if in_space { &[SPACE] } else { &[] };
        let bent: &Edits<'_> = &[
            ("start.bends_deg", "[300]"),
            ("solver.integrator", "'explicit'"),
            ("solver.step_s", "1e-6"),
            ("control.step_s", "1e-6"),
            ("material.damping_time_s", "0"),
        ];
        // With as much of the angle at each node as the stretch that it stands for: even.
        let mut world = World::new("cantilever", &[ROD, space, bent]);
        let before: Vec<Vector> = (0..world.model.nodes()).map(|node| world.place(node)).collect();
        world.runs(1);
        let moved: Vec<f64> = (0..world.model.nodes())
            .map(|node| (world.place(node) - before[node]).norm())
            .collect();
        let greatest = moved.iter().fold(0.0f64, |most, &way| most.max(way));
        assert!(greatest > 1e-10, "{moved:?}");
        assert!(moved[2..11].iter().all(|&way| way < 1e-9 * greatest), "{moved:?}");
        assert!(moved[0] > 0.1 * greatest && moved[12] > 0.1 * greatest);
    }
}
