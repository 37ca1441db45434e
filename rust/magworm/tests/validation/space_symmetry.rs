//! Space has no direction of its own but the vertical: mirrored and turned scenes move as the mirror image and the
//! turned one.

use crate::report::{Case, short};
use crate::world::{World, number};
use magworm::internals::ContactMode;
use nalgebra::Vector3;
use std::ops::RangeInclusive;

/// A robot and the path of its drive, as seen from above; heights are not touched by mirrors and turns about the
/// vertical. Places are x, z and yaw.
#[derive(Clone)]
struct Path {
    start: [f64; 3],
    time_s: Vec<f64>,
    height_m: Vec<f64>,
    drive: Vec<[f64; 3]>,
}

impl Path {
    /// One pass beneath the robot, at an angle and beside it, with a drive that turns on its way.
    fn pass() -> Self {
        Self {
            start: [0.004, 0.003, 0.2],
            time_s: vec![0.0, 0.1, 1.3],
            height_m: vec![-0.03, -0.022, -0.022],
            drive: vec![[-0.05, 0.012, -0.3], [-0.045, 0.010, -0.3], [0.10, -0.015, 0.5]],
        }
    }

    /// Drags the robot aside and turns it.
    fn swing() -> Self {
        Self {
            start: [0.0, 0.0, 0.0],
            time_s: vec![0.0, 0.3, 0.8, 1.2],
            height_m: vec![-0.04, -0.022, -0.022, -0.03],
            drive: vec![
                [0.027, 0.0, 0.0],
                [0.027, 0.004, 0.3],
                [0.02, 0.03, 1.2],
                [0.0, 0.03, 1.2],
            ],
        }
    }

    fn map(&self, f: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        Self {
            start: f(self.start),
            drive: self.drive.iter().map(|place| f(*place)).collect(),
            ..self.clone()
        }
    }

    /// Nodes at each instant, and in how many a foot slides.
    fn run(&self, edits: &[(&str, &str)]) -> (Vec<Vec<Vector3<f64>>>, usize) {
        let list = |k: usize, scale: f64| -> String {
            let numbers = self.drive.iter().map(|place| number(place[k] * scale));
            numbers.collect::<Vec<_>>().join(", ")
        };
        let plain =
            |values: &[f64]| values.iter().map(|v| number(*v)).collect::<Vec<_>>().join(", ");
        let degrees = 1f64.to_degrees();
        let motion = format!(
            "{{ kind = 'waypoints', time_s = [{}], x_m = [{}], y_m = [{}], z_m = [{}], yaw_deg = [{}] }}",
            plain(&self.time_s),
            list(0, 1.0),
            plain(&self.height_m),
            list(1, 1.0),
            list(2, degrees),
        );
        let start = format!(
            "{{ x_m = {}, z_m = {}, yaw_deg = {}, height_m = 0.0 }}",
            number(self.start[0]),
            number(self.start[1]),
            number(self.start[2] * degrees)
        );
        let mut all = vec![
            ("dimensions", "3"),
            ("solver.step_s", "0.001"),
            ("drive.motion", &motion),
            ("start", &start),
        ];
        all.extend(edits);
        let mut world = World::new("robot", &all);
        let mut sliding = 0;
        let instants = (0..INSTANTS).map(|_| {
            world.run(0.01);
            sliding += usize::from(
                world.block.contact_mode.iter().any(|mode| mode[0] == ContactMode::Slide.code()),
            );
            world.places()
        });
        (instants.collect(), sliding)
    }
}

/// Greatest distance of nodes at each instant from those of another run, brought back [m].
fn apart(
    here: &[Vec<Vector3<f64>>],
    there: &[Vec<Vector3<f64>>],
    back: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Vec<f64> {
    let far = |(here, there): (&Vec<Vector3<f64>>, &Vec<Vector3<f64>>)| {
        here.iter().zip(there).map(|(a, b)| (a - back(b)).norm()).fold(0.0, f64::max)
    };
    here.iter().zip(there).map(far).collect()
}

/// How far the robot went, so that standing still does not pass [m].
fn way(nodes: &[Vec<Vector3<f64>>]) -> f64 {
    (nodes[nodes.len() - 1][0] - nodes[0][0]).norm()
}

/// Instants of a run: every 10 ms.
const INSTANTS: usize = 120;

/// Fields of a scene and their values in TOML.
type Edits = &'static [(&'static str, &'static str)];

/// How far rounding may drive the runs apart while feet stick, slide and stick again [m]: a millionth of a stride of 3 mm.
const BAND_M: f64 = 3e-9;
/// At how many of its instants a foot slides, so that what is compared is not a robot at rest.
const SLIDING: RangeInclusive<f64> = 12.0..=INSTANTS as f64;

/// Motions and laws, and edits of the laws.
fn runs() -> [(&'static str, Path, Edits); 4] {
    let others: Edits = &[("solver.magnet_model", "'dipole'"), ("solver.curvature", "'tangent'")];
    [
        ("pass", Path::pass(), &[]),
        ("pass, dipoles, κ = 2 tan(φ/2)", Path::pass(), others),
        ("swing", Path::swing(), &[]),
        ("swing, dipoles, κ = 2 tan(φ/2)", Path::swing(), others),
    ]
}

/// Distances at some instants, for the table of a case.
fn growth(name: &str, apart: &[f64]) -> Vec<String> {
    let cells = [0, 9, 29, 59, 89, INSTANTS - 1].map(|instant| short(apart[instant]));
    println!("{name}: {cells:?}");
    [name.to_string()].into_iter().chain(cells).collect()
}

const HEAD: [&str; 7] = ["motion", "10 ms", "0.1 s", "0.3 s", "0.6 s", "0.9 s", "1.2 s"];

#[test]
fn validates_mirror_images_in_space() {
    let mut case = Case::new(
        "mirror_images_in_space",
        "A mirrored robot moves as the mirror image",
    )
    .equation("z → −z: yaw → −yaw of robot and drive; x, y unchanged")
    .source("Symmetry of all laws; poles of a mirrored magnet are those of its mirror image")
    .scene("robot", &[("dimensions", "3"), ("solver.step_s", "0.001"), ("drive.motion", "…")])
    .note(
        "Greatest distance of a node from its mirror image, every 10 ms: one pass of the drive \
        beneath the robot, at an angle to it, and a drive that drags it aside and turns it. On the \
        way feet stick, slide and stick again.",
    );
    let mut table = vec![];
    for (name, path, edits) in runs() {
        let (here, sliding) = path.run(edits);
        let (image, _) = path.map(|[x, z, yaw]| [x, -z, -yaw]).run(edits);
        let back = |node: &Vector3<f64>| Vector3::new(node.x, node.y, -node.z);
        let distances = apart(&here, &image, back);
        case.inside(format!("way of the head, {name}"), "m", way(&here), 1e-3..=1.0);
        case.inside(
            format!("instants at which a foot slides, {name}"),
            "",
            sliding as f64,
            SLIDING,
        );
        case.spread(format!("distance, {name}"), "m", &distances, BAND_M);
        table.push(growth(name, &distances));
    }
    case.table("Distance [m]:", &HEAD, table);
    case.finish();
}

#[test]
fn validates_turned_scenes_in_space() {
    let mut case = Case::new(
        "turned_scenes_in_space",
        "A scene turned about the vertical moves the same",
    )
    .equation("x → x cos α + z sin α, z → z cos α − x sin α, yaw → yaw + α")
    .source("Symmetry of all laws")
    .scene("robot", &[("dimensions", "3"), ("solver.step_s", "0.001"), ("drive.motion", "…")])
    .note(
        "Greatest distance of a node from its place in the scene that is not turned, every 10 \
        ms, over turns of 30°, 90°, 180°, 217° and −65°; motions and rounding as above.",
    );
    let mut table = vec![];
    for (name, path, edits) in runs() {
        let (here, sliding) = path.run(edits);
        let mut farthest = vec![0.0f64; INSTANTS];
        for turn in [30.0, 90.0, 180.0, 217.0, -65.0].map(f64::to_radians) {
            let (sin, cos) = turn.sin_cos();
            let about = |[x, z, yaw]: [f64; 3]| [x * cos + z * sin, z * cos - x * sin, yaw + turn];
            let back =
                |n: &Vector3<f64>| Vector3::new(n.x * cos - n.z * sin, n.y, n.z * cos + n.x * sin);
            let distances = apart(&here, &path.map(about).run(edits).0, back);
            farthest.iter_mut().zip(distances).for_each(|(far, one)| *far = far.max(one));
        }
        case.inside(format!("way of the head, {name}"), "m", way(&here), 1e-3..=1.0);
        case.inside(
            format!("instants at which a foot slides, {name}"),
            "",
            sliding as f64,
            SLIDING,
        );
        case.spread(format!("distance, {name}"), "m", &farthest, BAND_M);
        table.push(growth(name, &farthest));
    }
    case.table("Distance [m]:", &HEAD, table);
    case.finish();
}
