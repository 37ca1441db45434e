//! Wrenches of a drive magnet on eight body magnets at once.

use crate::counted;
use magworm::Model;
use magworm::internals::PairModel;
use magworm::internals::lanes::math::sin_cos;
use magworm::internals::lanes::{InstructionSet, Isa, WIDE, WideTask, run_wide_on};
use std::hint::black_box;

const ROWS: usize = 64;

/// Along, angle in the plane x–y: its cosine and sine, eight poses a row.
type Row = [[f64; WIDE]; 3];

/// Height of the body over the drive, and its place beside it [m].
const ABOVE_M: f64 = 0.022;
const BESIDE_M: f64 = 0.005;

struct Sweep<'a>(&'a PairModel, &'a [Row], &'a mut [[f64; WIDE]; 6]);

impl WideTask for Sweep<'_> {
    type Output = ();
    fn run<I: Isa<Row = [f64; WIDE]>>(self, isa: I) {
        let Sweep(pair, rows, total) = self;
        isa.vectorize(
            #[inline(always)]
            || {
                for row in rows {
                    let [along, cos, sin] =
                        [isa.load(&row[0]), isa.load(&row[1]), isa.load(&row[2])];
                    let (zero, one) = (isa.splat(0.0), isa.splat(1.0));
                    let mut wrench = [zero; 6];
                    match pair {
                        PairModel::Cuboid(pair) => {
                            let found = pair.wrench(along, one * ABOVE_M, cos, sin, one);
                            wrench[..3].copy_from_slice(&found);
                        }
                        PairModel::SpatialCuboid(pair) => {
                            let axes = [[cos, sin, zero], [-sin, cos, zero], [zero, zero, one]];
                            wrench = pair.wrench([along, one * ABOVE_M, one * BESIDE_M], axes);
                        }
                        PairModel::ObliqueCuboid(_)
                        | PairModel::Dipole(_)
                        | PairModel::SpatialDipole(_) => {}
                    }
                    for k in 0..6 {
                        isa.store(isa.load(&total[k]) + wrench[k], &mut total[k]);
                    }
                }
            },
        );
    }
}

/// Number of wrenches of eight lanes.
pub fn count(model: &Model, set: InstructionSet) -> Result<u64, String> {
    let magnetics = model.program.magnetics.as_ref().ok_or("the scene has no magnets")?;
    let poses = poses();
    let mut total = [[0.0; WIDE]; 6];
    counted(&mut || run_wide_on(set, Sweep(&magnetics.models[0], black_box(&poses), &mut total)));
    black_box(total);
    Ok(ROWS as u64)
}

/// Poses from 60 mm before the drive to 60 mm behind it, at angles up to 0.7 rad.
fn poses() -> Vec<Row> {
    let mut rows = vec![[[0.0; WIDE]; 3]; ROWS];
    for pose in 0..ROWS * WIDE {
        let share = 2.0 * pose as f64 / (ROWS * WIDE) as f64 - 1.0;
        let (turn, _) = sin_cos(18.0 * share);
        let (sin, cos) = sin_cos(0.7 * turn);
        let row = &mut rows[pose / WIDE];
        for (component, value) in row.iter_mut().zip([0.06 * share, cos, sin]) {
            component[pose % WIDE] = value;
        }
    }
    rows
}
