//! Elimination of one segment between two bodies, and the way back.

use super::super::banded::factor_row;
use super::super::{Isa, Number};
use super::{Chain, Segment};

/// The stored parts of a system.
pub(super) struct Parts<'a, const W: usize, N> {
    pub(super) chain: &'a Chain,
    pub(super) band: &'a mut [[N; W]],
    pub(super) border: &'a mut [[N; W]],
    pub(super) kept: &'a mut [[N; W]],
}

impl<const W: usize, N: Number> Parts<'_, W, N> {
    /// Eliminates a segment.
    #[inline(always)]
    pub(super) fn condense<
        I: Isa<W, Number = N>,
        const H: usize,
        const ROW: usize,
        const K: usize,
    >(
        &mut self,
        isa: I,
        segment: &Segment,
        right: &mut [[N; W]],
    ) {
        let (rows, _) = self.band.as_chunks_mut::<ROW>();
        for row in segment.rows.clone() {
            factor_row::<W, I, H, ROW>(isa, rows, row + H);
            substitute::<W, I, H>(isa, segment, &rows[row + H], row, right);
        }
        if segment.left.is_some() {
            self.eliminate_left::<I, H, ROW, K>(isa, segment, right);
        }
        if let Some(first) = segment.right {
            for slot in 0..K {
                self.eliminate_right::<I, H, ROW, K>(isa, segment, [first, slot], right);
            }
        }
    }

    /// The body before a segment: carries its border down, and takes what the segment adds to it.
    #[inline(always)]
    fn eliminate_left<I: Isa<W, Number = N>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        right: &mut [[N; W]],
    ) {
        let Some(left) = segment.left else { return };
        let Some(place) = self.chain.place(left) else { return };
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
            for k in first_column::<H>(segment, row)..H {
                let l = isa.load(&rows[row + H][k]);
                for j in 0..K {
                    u[j] = u[j] - l * isa.load(&border[row + k - H][j]);
                }
            }
            let inverse = isa.load(&rows[row + H][H]);
            let y = isa.load(&right[row]);
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
            subtract(isa, &mut right[left + j], loads[j]);
            for i in 0..=j {
                subtract(isa, &mut self.kept[self.chain.kept.at(place + j, place + i)], sums[j][i]);
            }
        }
    }

    /// A row of the body behind a segment, and what the segment adds to it.
    #[inline(always)]
    fn eliminate_right<I: Isa<W, Number = N>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        [first, slot]: [usize; 2],
        right: &mut [[N; W]],
    ) {
        let Some(place) = self.chain.place(first) else { return };
        let (rows, _) = self.band.as_chunks_mut::<ROW>();
        let (above, below) = rows.split_at_mut(first + slot + H);
        let row = first + slot;
        let columns = first_column::<H>(segment, row)..H - slot;
        let mut u = [isa.splat(0.0); H];
        let mut load = isa.splat(0.0);
        for k in columns.clone() {
            let column = &above[row + k];
            let mut sum = isa.load(&below[0][k]);
            for m in columns.start..k {
                sum = sum - u[m] * isa.load(&column[H + m - k]);
            }
            u[k] = sum;
            let l = sum * isa.load(&column[H]);
            isa.store(l, &mut below[0][k]);
            load = load + l * isa.load(&right[row + k - H]);
        }
        subtract(isa, &mut right[row], load);
        let kept = &self.chain.kept;
        for other in 0..=slot {
            let mut sum = isa.splat(0.0);
            for k in columns.clone() {
                let l = if other == slot { &below[0] } else { &above[first + other + H] };
                sum = sum + u[k] * isa.load(&l[k + slot - other]);
            }
            subtract(isa, &mut self.kept[kept.at(place + slot, place + other)], sum);
        }
        let Some(left) = segment.left.and_then(|left| self.chain.place(left)) else { return };
        let (border, _) = self.border.as_chunks::<K>();
        for j in 0..K {
            let mut sum = isa.splat(0.0);
            for k in columns.clone() {
                sum = sum + isa.load(&below[0][k]) * isa.load(&border[row + k - H][j]);
            }
            subtract(isa, &mut self.kept[kept.at(place + slot, left + j)], sum);
        }
    }
}

/// The first column of a row's band that lies in the segment.
#[inline(always)]
fn first_column<const H: usize>(segment: &Segment, row: usize) -> usize {
    H.saturating_sub(row - segment.rows.start)
}

#[inline(always)]
fn subtract<const W: usize, I: Isa<W>>(isa: I, entry: &mut [I::Number; W], value: I::F) {
    isa.store(isa.load(entry) - value, entry);
}

/// Forward substitution in one row.
#[inline(always)]
fn substitute<const W: usize, I: Isa<W>, const H: usize>(
    isa: I,
    segment: &Segment,
    factored: &[[I::Number; W]],
    row: usize,
    right: &mut [[I::Number; W]],
) {
    let mut sum = isa.load(&right[row]);
    for k in first_column::<H>(segment, row)..H {
        sum = sum - isa.load(&factored[k]) * isa.load(&right[row + k - H]);
    }
    isa.store(sum, &mut right[row]);
}

/// Backward substitution through a segment.
#[inline(always)]
pub(super) fn recover<
    const W: usize,
    I: Isa<W>,
    const H: usize,
    const ROW: usize,
    const K: usize,
>(
    isa: I,
    segment: &Segment,
    band: &[[I::Number; W]],
    border: &[[I::Number; W]],
    right: &[[I::Number; W]],
    solution: &mut [[I::Number; W]],
) {
    let (rows, _) = band.as_chunks::<ROW>();
    let (border, _) = border.as_chunks::<K>();
    let end = segment.right.map_or(segment.rows.end, |right| right + K);
    for row in segment.rows.clone().rev() {
        let mut sum = isa.load(&right[row]);
        if let Some(left) = segment.left {
            for j in 0..K {
                sum = sum - isa.load(&border[row][j]) * isa.load(&solution[left + j]);
            }
        }
        sum = sum * isa.load(&rows[row + H][H]);
        for k in 1..=H.min(end - 1 - row) {
            sum = sum - isa.load(&rows[row + H + k][H - k]) * isa.load(&solution[row + k]);
        }
        isa.store(sum, &mut solution[row]);
    }
}
