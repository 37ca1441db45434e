//! Rules of a bent start: parts that the mesh can bend, by angles that its nodes can have.

use super::super::bends::{angle_rad, bending_lengths_m, strains};
use super::super::error::Problem;
use super::super::fields::GREATEST_BEND_DEG;
use super::super::schema::quantity;
use super::super::{Mesh, Scene, Start};
use super::{require, rounded};
use crate::lanes::math::degrees;

/// Ours: greatest angle between the elements at a node, and greatest twist from one to the next [°]. At 180° neither the
/// direction of the turn nor the frames are defined.
const GREATEST_AT_A_NODE_DEG: f64 = 150.0;

/// A list of angles and its field.
type List<'a> = (&'static str, &'a [f64]);

/// Checks the lists of a scene whose body is sound.
pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    let lists = lists(&scene.start);
    if lists.iter().all(|(_, list_deg)| list_deg.is_empty()) {
        return Ok(());
    }
    let mesh = Mesh::new(scene);
    lists.iter().try_for_each(|list| parts(&mesh, *list))?;
    let strains = strains(scene, &mesh);
    strains.iter().enumerate().try_for_each(|(place, strain)| node(&mesh, &lists, place, *strain))
}

fn lists(start: &Start) -> [List<'_>; 3] {
    [
        ("start.bends_deg", &start.bends_deg),
        ("start.bends_aside_deg", &start.bends_aside_deg),
        ("start.twists_deg", &start.twists_deg),
    ]
}

/// A list by itself.
fn parts(mesh: &Mesh, (field, list_deg): List<'_>) -> Result<(), Problem> {
    let (count, nodes) = (list_deg.len(), mesh.elements.len() - 1);
    require(count <= nodes, field, format!("a list of {count}"), || {
        format!("a list of at most {nodes}, as many as the body has nodes that bend")
    })?;
    let whole_deg: f64 = list_deg.iter().map(|angle_deg| angle_deg.abs()).sum();
    let whole = format!("{} in all, signs aside", quantity(rounded(whole_deg), "°"));
    require(whole_deg <= GREATEST_BEND_DEG, field, whole, || {
        format!("at most {}", quantity(GREATEST_BEND_DEG, "°"))
    })?;
    list_deg.iter().enumerate().try_for_each(|(part, &angle_deg)| {
        let bends = || bending_lengths_m(mesh, count, part).iter().any(|&length_m| length_m > 0.0);
        let field = format!("{field}[{part}]");
        require(angle_deg == 0.0 || bends(), field, quantity(angle_deg, "°"), || {
            "0 where nothing bends in a part of the body".into()
        })
    })
}

/// The strains of all lists at a node, the `place`-th that bends.
fn node(mesh: &Mesh, lists: &[List<'_>; 3], place: usize, strain: [f64; 3]) -> Result<(), Problem> {
    let [_, _, twist] = strain;
    let twist_deg = degrees(twist.abs());
    at_node(mesh, &lists[2..], place, twist_deg, "a twist")?;
    at_node(mesh, &lists[..2], place, degrees(angle_rad(strain)), "an angle")
}

fn at_node(
    mesh: &Mesh,
    lists: &[List<'_>],
    place: usize,
    here_deg: f64,
    what: &str,
) -> Result<(), Problem> {
    if here_deg <= GREATEST_AT_A_NODE_DEG {
        return Ok(());
    }
    let (field, value) = greatest(mesh, lists, place);
    let [most, here] = [GREATEST_AT_A_NODE_DEG, rounded(here_deg)].map(|deg| quantity(deg, "°"));
    let allowed = format!(
        "{what} of at most {most} at a node, here {here} at node {} of {}, counted from 0 at the head",
        place + 1,
        mesh.arc_m.len()
    );
    Err(Problem::Value { field, value, allowed })
}

/// Field and value of the part that bends a node most.
fn greatest(mesh: &Mesh, lists: &[List<'_>], place: usize) -> (String, String) {
    let parts = lists.iter().flat_map(|(field, list_deg)| {
        list_deg.iter().enumerate().map(move |(part, &angle_deg)| {
            let lengths_m = bending_lengths_m(mesh, list_deg.len(), part);
            let share = lengths_m[place] / lengths_m.iter().sum::<f64>().max(f64::MIN_POSITIVE);
            (share * angle_deg.abs(), format!("{field}[{part}]"), quantity(angle_deg, "°"))
        })
    });
    let most = parts.max_by(|a, b| a.0.total_cmp(&b.0));
    most.map_or_else(Default::default, |(_, field, value)| (field, value))
}
