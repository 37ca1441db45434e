//! Frames that follow a writhing rod for long.

use crate::report::Case;
use crate::space_world::Vector;
use crate::world::{ROD, World};

/// A clamped rod that nothing damps.
pub const WRITHING: [(&str, &str); 9] = [
    ("dimensions", "3"),
    ("gravity_m_s2", "9.81"),
    ("body.clamp", "'head'"),
    ("body.elements", "8"),
    ("body.width_m", "0.005"),
    ("solver.integrator", "'explicit'"),
    ("solver.step_s", "5e-5"),
    ("control.step_s", "5e-5"),
    ("material.damping_time_s", "0.0"),
];

/// a turned by the rotation that takes the unit vector `from` to `to` and leaves what is across both (Rodrigues).
pub fn carried(a: Vector, from: Vector, to: Vector) -> Vector {
    let axis = from.cross(&to);
    a * from.dot(&to) + axis.cross(&a) + axis * (axis.dot(&a) / (1.0 + from.dot(&to)))
}

/// a turned about the unit vector `axis`.
fn spun(a: Vector, axis: Vector, angle: f64) -> Vector {
    a * angle.cos() + axis.cross(&a) * angle.sin() + axis * (axis.dot(&a) * (1.0 - angle.cos()))
}

/// Sets a whirl of the tip and a spin about the axis.
pub fn whirl(world: &mut World) {
    world.set_flow(
        |p| Vector::new(0.0, 4.0 * p.x, 6.0 * p.x * (30.0 * p.x).cos()),
        Vector::x() * 25.0,
    );
}

/// 1e5 steps of an undamped clamped rod that whirls and twists: the frames stay orthonormal, and are where parallel
/// transport of the tangents by Rodrigues' formula and the integral of the twist rates take them; so is the twist.
#[test]
fn validates_space_frames_do_not_drift() {
    let mut case = Case::new("space_frames_do_not_drift", "Frames over 100 000 steps")
        .equation("u⁺ = R(t, θ̇Δt) R(t⁻ → t) u; τ = ∠ about t_f from R(t_e → t_f) u_e to u_f")
        .source(
            "M. Bergou et al., Discrete Viscous Threads, ACM Trans. Graph. 29 (2010) 116 (time-parallel \
            transport); the frames are integrated in the test by Rodrigues' formula",
        )
        .scene(ROD, &WRITHING)
        .note(
            "An undamped rod, clamped at one end, starts with a whirl of its tip and a spin about its axis and \
            writhes on for 5 s. What the simulator keeps is compared with frames that the test turns from the \
            motion of the nodes and the twist rates, each step a turn by 2 atan(½ θ̇Δt).",
        );
    let mut world = World::new(ROD, &WRITHING);
    whirl(&mut world);
    let (dt, twists) = (world.model.step_s, world.model.coordinates.twists.clone());
    let elements = world.last();
    let mut ups: Vec<Vector> = (0..elements).map(|e| world.up(e)).collect();
    let mut tangents: Vec<Vector> = (0..elements).map(|e| world.frame_tangent(e)).collect();
    let (mut skew, mut most_twist, mut least_cosine) = (0.0f64, 0.0f64, 1.0f64);
    for step in 0..100_000 {
        let now: Vec<Vector> = (0..elements).map(|e| world.tangent(e)).collect();
        world.steps(1);
        for e in 0..elements {
            ups[e] = carried(ups[e], tangents[e], now[e]);
            let rate = twists[e].map_or(0.0, |dof| world.block.v[dof][0]);
            ups[e] = spun(ups[e], now[e], 2.0 * (0.5 * rate * dt).atan());
            if step % 100 == 0 {
                let (up, t) = (world.up(e), world.frame_tangent(e));
                let side = t.cross(&up);
                let off = [up.norm() - 1.0, t.norm() - 1.0, side.norm() - 1.0, up.dot(&t)];
                skew = off.into_iter().fold(skew, |most, part| most.max(part.abs()));
            }
        }
        tangents = now;
        let twist: f64 = world.block.twist.iter().map(|row| row[0]).sum();
        most_twist = most_twist.max(twist.abs());
        least_cosine = least_cosine.min(tangents[elements - 1].x);
    }
    case.at_most("lengths less 1 and scalar products of the frames", "", skew, 1e-12);
    let off: Vec<f64> = (0..elements).map(|e| (world.up(e) - ups[e]).norm()).collect();
    case.spread("up directions", "rad", &off, 1e-11);
    world.refresh();
    let now: Vec<Vector> = (0..elements).map(|e| world.tangent(e)).collect();
    for e in 0..elements {
        ups[e] = carried(ups[e], tangents[e], now[e]);
    }
    world.steps(1);
    let twist: Vec<f64> = (1..elements)
        .map(|node| {
            let (e, f) = (node - 1, node);
            let up = carried(ups[e], now[e], now[f]);
            let angle = now[f].dot(&up.cross(&ups[f])).atan2(up.dot(&ups[f]));
            let off = world.block.twist[node - 1][0] - angle;
            off - (off / std::f64::consts::TAU).round() * std::f64::consts::TAU
        })
        .collect();
    case.spread("twist of the nodes", "rad", &twist, 1e-11);
    case.inside("greatest twist of the whole rod", "rad", most_twist, 0.5..=f64::INFINITY);
    case.inside("least cosine of the tip's slope", "", least_cosine, -1.0..=0.0);
    case.finish();
}
