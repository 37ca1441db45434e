//! Elimination of one segment between two bodies, and the way back.

use super::super::banded::{factor_row, unrolled};
use super::super::{Isa, Row};
use super::{Chain, Segment};
use std::ops::Range;

/// The stored parts of a system.
pub(super) struct Parts<'a, R> {
    pub(super) chain: &'a Chain,
    pub(super) band: &'a mut [R],
    pub(super) border: &'a mut [R],
    pub(super) kept: &'a mut [R],
}

impl<R: Row> Parts<'_, R> {
    /// Eliminates a segment.
    #[inline(always)]
    pub(super) fn condense<I: Isa<Row = R>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        rhs: &mut [R],
    ) {
        let (rows, _) = self.band.as_chunks_mut::<ROW>();
        let Range { start, end } = segment.rows.clone();
        // The first rows of a segment reach back to its beginning only.
        unrolled!(offset < H => {
            if start + offset < end {
                factor_row::<I, H, ROW>(isa, rows, start + offset + H, H - offset);
                substitute::<I, H>(isa, &rows[start + offset + H], H - offset, start + offset, rhs);
            }
        });
        for row in start + H..end {
            factor_row::<I, H, ROW>(isa, rows, row + H, 0);
            substitute::<I, H>(isa, &rows[row + H], 0, row, rhs);
        }
        if segment.before.is_some() {
            self.eliminate_body_before::<I, H, ROW, K>(isa, segment, rhs);
        }
        if let Some(first) = segment.behind {
            for slot in 0..K {
                self.eliminate_body_behind::<I, H, ROW, K>(isa, segment, [first, slot], rhs);
            }
        }
    }

    /// The body before a segment: carries its border down, and takes what the segment adds to it.
    #[inline(always)]
    fn eliminate_body_before<I: Isa<Row = R>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        rhs: &mut [R],
    ) {
        let Some(before) = segment.before else { return };
        let Some(place) = self.chain.place(before) else { return };
        let (rows, _) = self.band.as_chunks::<ROW>();
        let (border, _) = self.border.as_chunks_mut::<K>();
        let zero = isa.splat(0.0);
        let mut sums = [[zero; K]; K];
        let mut loads = [zero; K];
        for row in segment.rows.clone() {
            let mut u = [zero; K];
            for j in 0..K {
                u[j] = isa.load(&border[row][j]);
            }
            let reach = H.min(row - segment.rows.start);
            let (factors, above) = (&rows[row + H][H - reach..H], &border[row - reach..row]);
            for k in 0..reach {
                let l = isa.load(&factors[k]);
                for j in 0..K {
                    u[j] = u[j] - l * isa.load(&above[k][j]);
                }
            }
            let inverse = isa.load(&rows[row + H][H]);
            let y = isa.load(&rhs[row]);
            for j in 0..K {
                isa.store(u[j], &mut border[row][j]);
                let scaled = u[j] * inverse;
                loads[j] = loads[j] + scaled * y;
                for i in 0..=j {
                    sums[j][i] = sums[j][i] + scaled * u[i];
                }
            }
        }
        for j in 0..K {
            subtract(isa, &mut rhs[before + j], loads[j]);
            for i in 0..=j {
                subtract(isa, &mut self.kept[self.chain.kept.at(place + j, place + i)], sums[j][i]);
            }
        }
    }

    /// A row of the body behind a segment, and what the segment adds to it.
    #[inline(always)]
    fn eliminate_body_behind<I: Isa<Row = R>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        [first, slot]: [usize; 2],
        rhs: &mut [R],
    ) {
        let Some(place) = self.chain.place(first) else { return };
        let (rows, _) = self.band.as_chunks_mut::<ROW>();
        let (above, below) = rows.split_at_mut(first + slot + H);
        let row = first + slot;
        // Its columns in the segment: `count` of them from the `start`th of its band on.
        let start = first_column::<H>(segment, row);
        let count = H - slot - start;
        let at = row + start - H;
        let (entries, above_entries) = (&mut below[0], &above[row + start..][..count]);
        let known = &rhs[at..][..count];
        let mut u = [isa.splat(0.0); H];
        let mut load = isa.splat(0.0);
        for k in 0..count {
            let column = &above_entries[k];
            let mut sum = isa.load(&entries[start + k]);
            let (before, factors) = (&u[..k], &column[H - k..H]);
            for m in 0..k {
                sum = sum - before[m] * isa.load(&factors[m]);
            }
            u[k] = sum;
            let l = sum * isa.load(&column[H]);
            isa.store(l, &mut entries[start + k]);
            load = load + l * isa.load(&known[k]);
        }
        let u = &u[..count];
        subtract(isa, &mut rhs[row], load);
        let kept = &self.chain.kept;
        for other in 0..=slot {
            let l = if other == slot { &below[0] } else { &above[first + other + H] };
            let l = &l[start + slot - other..][..count];
            let mut sum = isa.splat(0.0);
            for k in 0..count {
                sum = sum + u[k] * isa.load(&l[k]);
            }
            subtract(isa, &mut self.kept[kept.at(place + slot, place + other)], sum);
        }
        let Some(before) = segment.before.and_then(|before| self.chain.place(before)) else {
            return;
        };
        let (border, _) = self.border.as_chunks::<K>();
        let (factors, border) = (&below[0][start..][..count], &border[at..][..count]);
        for j in 0..K {
            let mut sum = isa.splat(0.0);
            for k in 0..count {
                sum = sum + isa.load(&factors[k]) * isa.load(&border[k][j]);
            }
            subtract(isa, &mut self.kept[kept.at(place + slot, before + j)], sum);
        }
    }
}

/// The first column of a row's band that lies in the segment.
#[inline(always)]
fn first_column<const H: usize>(segment: &Segment, row: usize) -> usize {
    H.saturating_sub(row - segment.rows.start)
}

#[inline(always)]
fn subtract<I: Isa>(isa: I, entry: &mut I::Row, value: I::F) {
    isa.store(isa.load(entry) - value, entry);
}

/// Forward substitution in one row, whose entries in the segment begin in column `first`.
#[inline(always)]
fn substitute<I: Isa, const H: usize>(
    isa: I,
    factored: &[I::Row],
    first: usize,
    row: usize,
    rhs: &mut [I::Row],
) {
    let reach = H - first;
    let (known, unknown) = rhs.split_at_mut(row);
    let (factors, known) = (&factored[first..H], &known[row - reach..]);
    let mut sum = isa.load(&unknown[0]);
    for k in 0..reach {
        sum = sum - isa.load(&factors[k]) * isa.load(&known[k]);
    }
    isa.store(sum, &mut unknown[0]);
}

/// Backward substitution through a segment.
#[inline(always)]
pub(super) fn recover<I: Isa, const H: usize, const ROW: usize, const K: usize>(
    isa: I,
    segment: &Segment,
    band: &[I::Row],
    border: &[I::Row],
    rhs: &[I::Row],
    solution: &mut [I::Row],
) {
    let (rows, _) = band.as_chunks::<ROW>();
    let (border, _) = border.as_chunks::<K>();
    let end = segment.behind.map_or(segment.rows.end, |behind| behind + K);
    for row in segment.rows.clone().rev() {
        let mut sum = isa.load(&rhs[row]);
        if let Some(before) = segment.before {
            for j in 0..K {
                sum = sum - isa.load(&border[row][j]) * isa.load(&solution[before + j]);
            }
        }
        sum = sum * isa.load(&rows[row + H][H]);
        let reach = H.min(end - 1 - row);
        let (below, known) = (&rows[row + H..][..=reach], &solution[row..][..=reach]);
        for k in 1..=reach {
            sum = sum - isa.load(&below[k][H - k]) * isa.load(&known[k]);
        }
        isa.store(sum, &mut solution[row]);
    }
}
