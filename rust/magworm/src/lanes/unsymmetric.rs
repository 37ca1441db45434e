//! Banded systems without symmetry, solved by elimination without pivoting, one system per lane.
//!
//! Row r is stored with its columns r − h … r + h; h ghost rows of zeros stand above and below, as in
//! [`super::banded`]. A row is eliminated in registers and the right-hand side along with it, so the lower factor is
//! never stored: each matrix is solved for one right-hand side.

use super::banded::{Band, GHOSTS, unrolled, vectorized};
use super::{Isa, Row};

/// Numbers in a row of half-bandwidth h.
pub const fn row_length(half_bandwidth: usize) -> usize {
    2 * half_bandwidth + 1
}

/// Number of stored entries of a matrix of this shape.
pub fn entries(band: &Band) -> usize {
    (band.size() + 2 * band.half_bandwidth()) * row_length(band.half_bandwidth())
}

/// Rows of a right-hand side, ghosts included.
pub fn rows(band: &Band) -> usize {
    band.size() + 2 * band.half_bandwidth()
}

/// Place of entry (row, column).
#[inline(always)]
pub fn at(band: &Band, row: usize, column: usize) -> usize {
    let h = band.half_bandwidth();
    (row + h) * row_length(h) + h + column - row
}

/// Calls with half-bandwidth and row length as constants.
macro_rules! dispatch {
    ($band:expr, $h:ident, $row:ident => $work:block) => {
        match $band.half_bandwidth() {
            5 => dispatch!(5, $h, $row, $work),
            6 => dispatch!(6, $h, $row, $work),
            8 => dispatch!(8, $h, $row, $work),
            10 => dispatch!(10, $h, $row, $work),
            11 => dispatch!(11, $h, $row, $work),
            13 => dispatch!(13, $h, $row, $work),
            _ => dispatch!(16, $h, $row, $work),
        }
    };
    ($H:literal, $h:ident, $row:ident, $work:block) => {{
        const $h: usize = $H;
        const $row: usize = row_length($H);
        $work
    }};
}

/// Writes a symmetric matrix, stored by its lower half, in full.
pub fn expand<I: Isa>(isa: I, band: &Band, lower: &[I::Row], full: &mut [I::Row]) {
    let size = band.size();
    dispatch!(band, H, ROW => {
        vectorized!(isa, expand_rows::<I, H, ROW>(isa, size, lower, full));
    });
}

#[inline(always)]
fn expand_rows<I: Isa, const H: usize, const ROW: usize>(
    isa: I,
    size: usize,
    lower: &[I::Row],
    full: &mut [I::Row],
) {
    let (rows, _) = full.as_chunks_mut::<ROW>();
    for row in H..size + H {
        let stored = &lower[row * (H + 1)..(row + 1) * (H + 1)];
        let (above, below) = rows.split_at_mut(row);
        let above = above.last_chunk_mut::<H>().expect(GHOSTS);
        for k in 0..H {
            let value = isa.load(&stored[k]);
            isa.store(value, &mut below[0][k]);
            isa.store(value, &mut above[k][ROW - 1 - k]);
        }
        isa.store(isa.load(&stored[H]), &mut below[0][H]);
    }
    // Beyond the last column an elimination may have left something that is not a number.
    for (beyond, row) in rows[size..size + H].iter_mut().enumerate() {
        row[ROW - 1 - beyond..].fill(I::Row::zeros());
    }
}

/// Solves in place: `rhs` has ghost rows, `full` is used up. A `body` of so many unknowns only meets itself and its
/// neighbours, which leaves half of the work; 0 where there is no such order.
pub fn solve<I: Isa>(isa: I, band: &Band, body: usize, full: &mut [I::Row], rhs: &mut [I::Row]) {
    let size = band.size();
    match (band.half_bandwidth(), body) {
        (5, 3) => vectorized!(isa, solve_bodies::<I, 5, 11, 3, 9>(isa, size, full, rhs)),
        (11, 6) => vectorized!(isa, solve_bodies::<I, 11, 23, 6, 18>(isa, size, full, rhs)),
        _ => dispatch!(band, H, ROW => {
            vectorized!(isa, solve_rows::<I, H, ROW>(isa, size, full, rhs));
        }),
    }
}

#[inline(always)]
fn solve_rows<I: Isa, const H: usize, const ROW: usize>(
    isa: I,
    size: usize,
    full: &mut [I::Row],
    rhs: &mut [I::Row],
) {
    let (rows, _) = full.as_chunks_mut::<ROW>();
    for row in H..size + H {
        eliminate::<I, H, ROW>(isa, rows, rhs, row);
    }
    substitute::<I, H, ROW>(isa, size, full, rhs);
}

/// B: unknowns of a body, C: those of three.
#[inline(always)]
fn solve_bodies<I: Isa, const H: usize, const ROW: usize, const B: usize, const C: usize>(
    isa: I,
    size: usize,
    full: &mut [I::Row],
    rhs: &mut [I::Row],
) {
    let (rows, _) = full.as_chunks_mut::<ROW>();
    for body in 0..size / B {
        for slot in 0..B {
            eliminate_of_body::<I, H, ROW, B, C>(isa, rows, rhs, H + B * body, slot);
        }
    }
    substitute::<I, H, ROW>(isa, size, full, rhs);
}

/// One row: what stands left of the diagonal is eliminated by the rows above; the diagonal becomes 1/pivot.
#[inline(always)]
fn eliminate<I: Isa, const H: usize, const ROW: usize>(
    isa: I,
    rows: &mut [[I::Row; ROW]],
    rhs: &mut [I::Row],
    row: usize,
) {
    let one = isa.splat(1.0);
    let (above, below) = rows.split_at_mut(row);
    let (known, unknown) = rhs.split_at_mut(row);
    let above = above.last_chunk::<H>().expect(GHOSTS);
    let known = known.last_chunk::<H>().expect(GHOSTS);
    let mut current = [one; ROW];
    for k in 0..ROW {
        current[k] = isa.load(&below[0][k]);
    }
    let mut y = isa.load(&unknown[0]);
    unrolled!(k < H => {
        let l = current[k] * isa.load(&above[k][H]);
        for j in 1..=H {
            current[k + j] = current[k + j] - l * isa.load(&above[k][H + j]);
        }
        y = y - l * isa.load(&known[k]);
    });
    isa.store(one / current[H], &mut below[0][H]);
    for k in H + 1..ROW {
        isa.store(current[k], &mut below[0][k]);
    }
    isa.store(y, &mut unknown[0]);
}

/// The same for a row of a body whose first row is `first`. The row meets the body before its own, its own and the one
/// behind it, and so do the rows that eliminate it: 1,060 products for three bodies of six in place of 2,180. Columns are
/// numbered through these three bodies: a compiler then knows all of them but the diagonal.
#[inline(always)]
fn eliminate_of_body<I: Isa, const H: usize, const ROW: usize, const B: usize, const C: usize>(
    isa: I,
    rows: &mut [[I::Row; ROW]],
    rhs: &mut [I::Row],
    first: usize,
    slot: usize,
) {
    let one = isa.splat(1.0);
    let (above, below) = rows[first - B..].split_at_mut(B + slot);
    let (known, unknown) = rhs[first - B..].split_at_mut(B + slot);
    let entries =
        below[0][B - 1 - slot..].first_chunk_mut::<C>().expect("a row is four bodies long");
    let mut current = [one; C];
    for column in 0..C {
        current[column] = isa.load(&entries[column]);
    }
    let (mut y, mut pivot) = (isa.load(&unknown[0]), one);
    unrolled!(k < 2 * B => {
        if k < B + slot {
            let eliminating = &above[k];
            let l = current[k] * isa.load(&eliminating[H]);
            // To the end of the body behind that of the eliminating row.
            for j in 1..2 * B - k % B {
                current[k + j] = current[k + j] - l * isa.load(&eliminating[H + j]);
            }
            y = y - l * isa.load(&known[k]);
        } else if k == B + slot {
            pivot = current[k];
        }
    });
    // What stands left of the diagonal is not read again.
    for column in B + 1..C {
        isa.store(current[column], &mut entries[column]);
    }
    isa.store(one / pivot, &mut entries[B + slot]);
    isa.store(y, &mut unknown[0]);
}

#[inline(always)]
fn substitute<I: Isa, const H: usize, const ROW: usize>(
    isa: I,
    size: usize,
    full: &[I::Row],
    rhs: &mut [I::Row],
) {
    let (rows, _) = full.as_chunks::<ROW>();
    for row in (H..size + H).rev() {
        let (unknown, known) = rhs.split_at_mut(row + 1);
        let known = known.first_chunk::<H>().expect(GHOSTS);
        let (entries, mut sum) = (&rows[row], isa.load(&unknown[row]));
        unrolled!(k < H => {
            sum = sum - isa.load(&entries[H + 1 + k]) * isa.load(&known[k]);
        });
        isa.store(sum * isa.load(&entries[H]), &mut unknown[row]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// Three bodies of six unknowns: what bodies further apart than neighbours leave at zero may be skipped.
    #[test]
    fn bodies_solve_as_a_band_does() {
        let mut band = Band::diagonal(18);
        assert!(band.couple(&[0, 11]).is_ok());
        let mut full = vec![[0.0]; entries(&band)];
        for (row, column) in (0..18usize).flat_map(|row| (0..18).map(move |column| (row, column))) {
            if (row / 6).abs_diff(column / 6) < 2 {
                let entry = ((3 * row + 7 * column) % 11) as f64 / 11.0;
                full[at(&band, row, column)] = [entry + if row == column { 20.0 } else { 0.0 }];
            }
        }
        let mut rhs = vec![[0.0]; rows(&band)];
        (0..18).for_each(|row| rhs[11 + row] = [row as f64 - 7.0]);
        let (mut full_too, mut right_too) = (full.clone(), rhs.clone());
        solve(Scalar, &band, 6, &mut full, &mut rhs);
        solve(Scalar, &band, 0, &mut full_too, &mut right_too);
        assert_eq!(rhs, right_too);
    }

    proptest! {
        #[test]
        fn solves_like_a_dense_factorisation(
            numbers in prop::collection::vec(-1.0..1.0f64, 97),
            span in 1usize..17,
            size in 17usize..30,
        ) {
            let mut band = Band::diagonal(size);
            prop_assert!(band.couple(&[0, span]).is_ok());
            let h = band.half_bandwidth();
            let mut next = numbers.iter().cycle();
            let mut dense = DMatrix::zeros(size, size);
            let mut lower = vec![[0.0]; band.entries()];
            let mut full = vec![[0.0]; entries(&band)];
            for row in 0..size {
                for column in row.saturating_sub(h)..=row {
                    let value = next.next().unwrap() + if row == column { 20.0 } else { 0.0 };
                    dense[(row, column)] = value;
                    dense[(column, row)] = value;
                    lower[band.at(row, column)] = [value];
                }
            }
            expand(Scalar, &band, &lower, &mut full);
            for row in 0..size {
                for column in row.saturating_sub(h)..(row + h + 1).min(size) {
                    let skew = *next.next().unwrap();
                    dense[(row, column)] += skew;
                    full[at(&band, row, column)][0] += skew;
                }
            }
            let rhs = DVector::from_iterator(size, numbers.iter().copied().take(size));
            let mut solution = vec![[0.0]; rows(&band)];
            (0..size).for_each(|row| solution[h + row] = [rhs[row]]);
            solve(Scalar, &band, 0, &mut full, &mut solution);
            let expected = dense.lu().solve(&rhs).unwrap();
            for row in 0..size {
                prop_assert!((solution[h + row][0] - expected[row]).abs() < 1e-12);
            }
        }
    }
}
