//! Layouts made by hand, which no scene gives.

use super::*;

struct Layout {
    coordinates: Coordinates,
    stretch: Vec<Stretch>,
    bend: Vec<Bend>,
    points: Vec<ContactPoint>,
}

fn layout(dimensions: usize) -> Layout {
    let mut scene = Scene::preset("paper-3").expect("a preset");
    scene.dimensions = dimensions;
    let mesh = Mesh::new(&scene);
    let coordinates = Coordinates::new(&mesh, Unknowns::Reduced, dimensions);
    Layout {
        stretch: stretch_springs(&scene, &mesh, &coordinates),
        bend: bending_springs(&scene, &mesh, &coordinates),
        points: mesh.contact_points.clone(),
        coordinates,
    }
}

fn compiled(layout: &Layout) -> Result<Chain, SceneError> {
    let Layout { coordinates, stretch, bend, points } = layout;
    let system = system(coordinates, stretch, bend, points).map_err(no_kernel)?;
    contacts::contact_pairs(points, coordinates, &system)?;
    Ok(system)
}

#[test]
fn springs_beyond_the_compiled_kernels_are_an_error_of_the_scene() {
    for dimensions in [2, 3] {
        for grounded in [false, true] {
            let mut across = layout(dimensions);
            if !grounded {
                across.points.clear();
            }
            assert!(compiled(&across).is_ok());
            let last = across.coordinates.anchors.len() - 1;
            across.stretch[0].stencil = Stencil::new(&across.coordinates, &[0, last]);
            let (unknowns, error) = (across.stretch[0].stencil.unknowns(), compiled(&across));
            let sentence = error.expect_err("a spring from end to end").to_string();
            let begin = format!("body is a layout that couples unknowns {} and ", unknowns[0]);
            assert!(sentence.starts_with(&begin), "{sentence}");
            assert!(sentence.ends_with("; allowed: springs between neighbours along the body"));
        }
    }
}

#[test]
fn contact_points_on_eliminated_unknowns_are_an_error_of_the_scene() {
    let mut soft = layout(2);
    let system = compiled(&soft).expect("a worm");
    let free = |anchor: &Anchor| matches!(anchor, Anchor::Free { .. });
    let node = soft.coordinates.anchors.iter().position(free).expect("a node of rubber");
    soft.points[0].frame = Frame::Node(node);
    let pairs = contacts::contact_pairs(&soft.points, &soft.coordinates, &system);
    let sentence = SceneError::from(pairs.expect_err("a point on rubber")).to_string();
    assert!(
        sentence.starts_with("body is a layout with a contact point on unknown "),
        "{sentence}"
    );
    // Where a point stands on rubber from the beginning, nothing is eliminated.
    assert!(compiled(&soft).is_ok());
}
