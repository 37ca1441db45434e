//! Time and accuracy of one planar wrench, one lane and eight, by quadrature order.
//!
//! Drive 40 × 5 × 40 mm (length × height × width), body 10 × 3 × 10 mm, 22 mm between centres.
//! Time: the best of many repetitions over a sweep of poses. Error: the largest over the sweep,
//! relative to the largest force and torque of the sweep, against order 10.

use magworm::internals::lanes::{Isa, WIDE, WideTask, run_wide};
use magworm::internals::magnetic::{Cuboid, PlanarDipole, PlanarPair};
use std::hint::black_box;
use std::time::Instant;

const DRIVE: Cuboid = Cuboid { length_m: 0.040, height_m: 0.005, width_m: 0.040 };
const BODY: Cuboid = Cuboid { length_m: 0.010, height_m: 0.003, width_m: 0.010 };
const STRENGTH_T2: f64 = 1.22 * 1.22;
const ROWS: usize = 64;
const REPEATS: usize = 2000;

/// Offsets and angles of one row of lanes.
type Row = [[f64; WIDE]; 4];

fn poses() -> Vec<Row> {
    let count = (ROWS * WIDE) as f64;
    let pose = |i: usize| {
        let (sin, cos) = (0.7 * (37.0 * i as f64 / count).sin()).sin_cos();
        [0.06 * (2.0 * i as f64 / count - 1.0), 0.022, cos, sin]
    };
    (0..ROWS)
        .map(|row| {
            let lanes: [[f64; 4]; WIDE] = std::array::from_fn(|lane| pose(row * WIDE + lane));
            std::array::from_fn(|k| lanes.map(|pose| pose[k]))
        })
        .collect()
}

struct Sweep<'a>(&'a PlanarPair, &'a [Row]);
impl WideTask for Sweep<'_> {
    type Output = Vec<[[f64; WIDE]; 3]>;
    fn run<I: Isa<Row = [f64; WIDE]>>(self, isa: I) -> Self::Output {
        let mut wrenches = vec![[[0.0; WIDE]; 3]; self.1.len()];
        isa.vectorize(
            #[inline(always)]
            || {
                let strength = isa.splat(STRENGTH_T2);
                for (out, row) in wrenches.iter_mut().zip(self.1) {
                    let [dx, dy, cos, sin] = row.each_ref().map(|lanes| isa.load(lanes));
                    let wrench = self.0.wrench(dx, dy, cos, sin, strength);
                    for (lanes, value) in out.iter_mut().zip(wrench) {
                        isa.store(value, lanes);
                    }
                }
            },
        );
        wrenches
    }
}

fn scalar(poses: &[Row], wrench: impl Fn(f64, f64, f64, f64) -> [f64; 3]) -> Vec<[[f64; WIDE]; 3]> {
    let lane = |row: &Row, k: usize| wrench(row[0][k], row[1][k], row[2][k], row[3][k]);
    let transposed = |row: &Row| {
        let lanes: [[f64; 3]; WIDE] = std::array::from_fn(|k| lane(row, k));
        std::array::from_fn(|component| lanes.map(|wrench| wrench[component]))
    };
    poses.iter().map(transposed).collect()
}

/// Nanoseconds per wrench.
fn time(mut sweep: impl FnMut() -> Vec<[[f64; WIDE]; 3]>, repeats: usize) -> f64 {
    let best = (0..repeats)
        .map(|_| {
            let start = Instant::now();
            black_box(sweep());
            start.elapsed().as_nanos()
        })
        .min();
    best.unwrap_or(0) as f64 / (ROWS * WIDE) as f64
}

/// Largest errors of force and torque relative to their largest values.
fn error(values: &[[[f64; WIDE]; 3]], exact: &[[[f64; WIDE]; 3]]) -> [f64; 2] {
    let lanes = values.iter().zip(exact).flat_map(|(v, e)| (0..WIDE).map(move |k| (v, e, k)));
    let (mut gap, mut size) = ([0.0_f64; 2], [0.0_f64; 2]);
    for (v, e, k) in lanes {
        gap[0] = gap[0].max((v[0][k] - e[0][k]).hypot(v[1][k] - e[1][k]));
        gap[1] = gap[1].max((v[2][k] - e[2][k]).abs());
        size[0] = size[0].max(e[0][k].hypot(e[1][k]));
        size[1] = size[1].max(e[2][k].abs());
    }
    [gap[0] / size[0], gap[1] / size[1]]
}

fn main() {
    let poses = poses();
    let exact = run_wide(Sweep(&PlanarPair::new(DRIVE, BODY, 10), &poses));
    println!("order | scalar ns | eight lanes ns | force error | torque error");
    for order in 1..=5 {
        let pair = PlanarPair::new(DRIVE, BODY, order);
        let one = || scalar(&poses, |dx, dy, c, s| pair.wrench(dx, dy, c, s, STRENGTH_T2));
        let wide = || run_wide(Sweep(black_box(&pair), black_box(&poses)));
        let [force, torque] = error(&wide(), &exact);
        let (scalar_ns, wide_ns) = (time(one, REPEATS / 8), time(wide, REPEATS));
        println!("{order:5} | {scalar_ns:9.1} | {wide_ns:14.2} | {force:11.1e} | {torque:12.1e}");
    }
    let dipole = PlanarDipole::new(DRIVE, BODY);
    let one = || scalar(&poses, |dx, dy, c, s| dipole.wrench(dx, dy, c, s, STRENGTH_T2));
    let [force, torque] = error(&one(), &exact);
    println!("dipole| {:9.1} | {:>14} | {force:11.1e} | {torque:12.1e}", time(one, REPEATS), "");
}
