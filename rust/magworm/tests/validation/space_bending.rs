//! Bending in space about any axis is bending in the plane.

use crate::report::Case;
use crate::space_world::Vector;
use crate::world::{ROD, World};

const LENGTH_M: f64 = 0.1;

/// A clamped rod with a heavy tip; α = ρAgL³/EI of the rod alone is 18.
const HANGING: [(&str, &str); 6] = [
    ("body.clamp", "'head'"),
    ("gravity_m_s2", "9.81"),
    ("material.youngs_modulus_pa", "400e3"),
    ("body.magnets", "[{position_m=0.096,polarity=1}]"),
    ("material.damping_time_s", "0.002"),
    ("control.step_s", "1.0"),
];
/// Sections and magnets: as in the plane, then with width and thickness exchanged.
const FLAT: [(&str, &str); 3] = [
    ("body.width_m", "0.01"),
    ("body.thickness_m", "0.004"),
    ("magnet", "{length_m=8e-3,width_m=0.008,height_m=0.003,remanence_t=0.0,density_kg_m3=7500}"),
];
const DEEP: [(&str, &str); 3] = [
    ("body.width_m", "0.004"),
    ("body.thickness_m", "0.01"),
    ("magnet", "{length_m=8e-3,width_m=0.003,height_m=0.008,remanence_t=0.0,density_kg_m3=7500}"),
];
const SQUARE: [(&str, &str); 3] = [
    ("body.width_m", "0.005"),
    ("body.thickness_m", "0.005"),
    ("magnet", "{length_m=8e-3,width_m=0.004,height_m=0.004,remanence_t=0.0,density_kg_m3=7500}"),
];

/// A way to lay a rod in space so that it moves as one does in the plane.
struct Laid {
    name: &'static str,
    plane: [(&'static str, &'static str); 3],
    space: [(&'static str, &'static str); 3],
    roll: f64,
    yaw_deg: f64,
}

fn ways() -> [Laid; 4] {
    let quarter = std::f64::consts::FRAC_PI_2;
    let way = |name, plane, space, roll, yaw_deg| Laid { name, plane, space, roll, yaw_deg };
    [
        way("along x", FLAT, FLAT, 0.0, 0.0),
        way("yawed by 37°", FLAT, FLAT, 0.0, 37.0),
        way("on its side, width and thickness exchanged", FLAT, DEEP, quarter, 0.0),
        way("square, rolled by 30° and yawed by −70°", SQUARE, SQUARE, quarter / 3.0, -70.0),
    ]
}

/// Farthest any node lies from its place in the plane, turned by the yaw, over L.
fn apart(plane: &World, space: &World, yaw_deg: f64) -> f64 {
    let (sin, cos) = yaw_deg.to_radians().sin_cos();
    (0..=plane.last())
        .map(|node| {
            let [x, y] = plane.node(node);
            (space.place(node) - Vector::new(x * cos, y, -x * sin)).norm() / LENGTH_M
        })
        .fold(0.0, f64::max)
}

/// Worlds of one way in the plane and in space.
fn pair(way: &Laid, more: &[(&str, &str)]) -> [World; 2] {
    let yaw = way.yaw_deg.to_string();
    let plane = World::new(ROD, &[&HANGING[..], &way.plane, more].concat());
    let turned = [("dimensions", "3"), ("start.yaw_deg", yaw.as_str())];
    let mut space = World::new(ROD, &[&HANGING[..], &way.space, more, &turned].concat());
    space.roll(way.roll);
    [plane, space]
}

/// Differences at ten times of a motion.
fn along_the_way([mut plane, mut space]: [World; 2], seconds: f64, yaw_deg: f64) -> Vec<f64> {
    let part = |_| {
        plane.run(seconds / 10.0);
        space.run(seconds / 10.0);
        apart(&plane, &space, yaw_deg)
    };
    (0..10).map(part).collect()
}

/// A heavy rod with a heavy tip falls from the horizontal and comes to rest, about its weak, its strong and an oblique
/// axis, in the plane's kernel and in space. Without a magnet the difference is rounding, carried on by the motion. A magnet
/// turns by ω Δt a step in the plane and by 2 atan(½ ω Δt) in space, which differs by (ω Δt)³/12: second order in Δt.
#[test]
fn validates_space_bending_as_in_the_plane() {
    let mut case =
        Case::new("space_bending_as_in_the_plane", "Bending about any axis as in the plane")
            .equation("EI₁ = E w h³/12 about the side, EI₂ = E h w³/12 about the up direction")
            .source("The planar kernel, itself compared with the elastica above")
            .scene(ROD, &[&HANGING[..], &FLAT, &[("dimensions", "3")]].concat())
            .note(
                "A clamped rod with a heavy magnet at its tip is let go from the horizontal and \
                hangs down in the end. *On its side*: rolled by 90° about its axis, with width and \
                thickness exchanged in body and magnet, so that it bends to the side in its own \
                frame. The farthest node counts, over L, at ten times of the motion. *Bare*: without the magnet, where what \
                differs is rounding; a magnet turns by ω Δt a step in the plane and by 2 atan(½ ω Δt) in space.",
            );
    let implicit = [("solver.step_s", "1e-3")];
    let explicit = [
        ("solver.integrator", "'explicit'"),
        ("solver.step_s", "2e-5"),
        ("material.damping_time_s", "2e-4"),
    ];
    let bare = [("body.magnets", ""), ("magnet", "")];
    let schemes = [("implicit", &implicit[..], 0.6), ("explicit", &explicit[..], 0.1)];
    for (scheme, edits, seconds) in schemes {
        for way in ways() {
            for (load, without, band) in
                [("bare", &bare[..], 1e-11), ("with a magnet", &[][..], 2e-6)]
            {
                let worlds = pair(&way, &[edits, without].concat());
                let differences = along_the_way(worlds, seconds, way.yaw_deg);
                let what = format!("moving, {scheme}, {load}, {}", way.name);
                case.spread(what, "of L", &differences, band);
            }
        }
    }
    let slower = [("solver.step_s", "5e-4")];
    let [coarse, fine] = [&implicit, &slower].map(|edits| {
        let way = &ways()[0];
        let differences = along_the_way(pair(way, edits), 0.6, way.yaw_deg);
        differences.into_iter().fold(0.0, f64::max)
    });
    case.inside(
        "order in Δt of the difference with a magnet",
        "",
        (coarse / fine).log2(),
        1.7..=2.3,
    );
    for way in ways() {
        let still = [("solver.step_s", "0.01"), ("material.damping_time_s", "0.05")];
        let [mut plane, mut space] = pair(&way, &still);
        crate::statics::settle(&mut plane);
        space.come_to_rest();
        let drop = -plane.node(plane.last())[1] / LENGTH_M;
        assert!(drop > 0.7, "a large deflection, here {drop}");
        let what = format!("at rest, {}", way.name);
        case.at_most(what, "L", apart(&plane, &space, way.yaw_deg), 1e-9);
    }
    case.finish();
}
