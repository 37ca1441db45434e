//! Rules of contact: points below nodes, the edges of feet, feet that touch each other, and rebound.

use super::super::error::Problem;
use super::super::schema::quantity;
use super::super::{ContactPoints, Integrator, Plan, Scene};
use super::require;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    nodes(scene)?;
    edges(scene)?;
    between_feet(scene)?;
    restitution(scene)
}

/// A node has no section that turns.
fn nodes(scene: &Scene) -> Result<(), Problem> {
    if scene.contact.points == ContactPoints::Feet {
        return Ok(());
    }
    let plain =
        scene.dimensions == 2 && scene.contact.edge_radius_m == 0.0 && !scene.contact.between_feet;
    require(plain, "contact.points", "nodes".into(), || {
        "feet in space, with contact.edge_radius_m and with contact.between_feet".into()
    })
}

fn edges(scene: &Scene) -> Result<(), Problem> {
    let radius_m = scene.contact.edge_radius_m;
    if radius_m == 0.0 {
        return Ok(());
    }
    let most_m = most_rounded_m(scene);
    require(radius_m <= most_m, "contact.edge_radius_m", quantity(radius_m, "m"), || {
        format!("at most {}, half of the shortest edge of a foot", quantity(most_m, "m"))
    })
}

fn between_feet(scene: &Scene) -> Result<(), Problem> {
    let field = "contact.between_feet";
    let allowed = |holds: bool, words: &'static str| {
        require(holds || !scene.contact.between_feet, field, "true".into(), || words.into())
    };
    allowed(scene.ground.is_some(), "false without [ground], whose contact springs feet have")?;
    let explicit = scene.solver.integrator == Integrator::Explicit;
    allowed(!explicit, "false where solver.integrator is \"explicit\"")?;
    let feet = Plan::new(scene).segments.iter().filter(|segment| segment.foot).count();
    allowed(feet > 1, "false where the body has less than two feet")
}

fn restitution(scene: &Scene) -> Result<(), Problem> {
    let e = scene.contact.restitution;
    let possible = scene.ground.is_some() || e == 0.0;
    require(possible, "contact.restitution", e.to_string(), || {
        "0 without [ground], whose contact springs touch".into()
    })
}

/// Half of the shortest edge of all feet; 0 without feet.
fn most_rounded_m(scene: &Scene) -> f64 {
    let plan = Plan::new(scene);
    let feet = plan.segments.iter().filter(|segment| segment.foot);
    let shortest_m = feet.map(|foot| {
        let in_plane_m = foot.length_m.min(foot.thickness_m);
        if scene.dimensions == 2 { in_plane_m } else { in_plane_m.min(foot.width_m) }
    });
    shortest_m.reduce(f64::min).map_or(0.0, |edge_m| 0.5 * edge_m)
}
