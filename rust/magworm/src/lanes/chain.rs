//! Symmetric systems of a chain: rigid bodies joined by soft segments, one system per lane.
//!
//! Contact acts on the bodies alone and needs many passes; the segments between them do not change meanwhile.
//! So the soft unknowns are eliminated first, once a step (static condensation, Schur complement):
//! S = A_kk − A_ks A_ss⁻¹ A_sk over the *kept* unknowns of the bodies, 18 instead of 68 for a worm of three
//! magnets in space. Once their velocities are known, those of the soft unknowns follow.
//!
//! Within a segment unknowns are numbered along the body, so A_ss is banded, and the body behind it (its *right* one)
//! only meets its last unknowns: its rows continue the band. The body before it (its *left* one) meets its
//! first unknowns, and elimination carries that on to all of them: a *border* of as many columns as the body has
//! unknowns. A segment is factored as L D Lᵀ without pivoting, row by row.
//!
//! A system without bodies to keep, or whose soft unknowns touch the ground, is kept as a whole.

use super::Isa;
use super::banded::{Band, factor_row, vectorized};
use std::ops::Range;

/// Unknowns of a body in space.
const BODY_IN_SPACE: usize = 6;

/// Calls with half-bandwidth H, length of a row, and unknowns of a body K as constants.
macro_rules! dispatch {
    ($chain:expr, $h:ident, $row:ident, $k:ident => $work:block) => {
        match ($chain.band.half_bandwidth(), $chain.body) {
            (5, 3) => dispatch!(5, 6, 3, $h, $row, $k, $work),
            (6, 3) => dispatch!(6, 7, 3, $h, $row, $k, $work),
            (8, 3) => dispatch!(8, 9, 3, $h, $row, $k, $work),
            (10, _) => dispatch!(10, 11, 6, $h, $row, $k, $work),
            (11, _) => dispatch!(11, 12, 6, $h, $row, $k, $work),
            (13, _) => dispatch!(13, 14, 6, $h, $row, $k, $work),
            (h, k) => unreachable!("segments of half-bandwidth {h} between bodies of {k} unknowns"),
        }
    };
    ($H:literal, $ROW:literal, $K:literal, $h:ident, $row:ident, $k:ident, $work:block) => {{
        const $h: usize = $H;
        const $row: usize = $ROW;
        const $k: usize = $K;
        $work
    }};
}

/// Shape of such a system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    band: Band,
    kept: Band,
    /// For each unknown its place among the kept ones.
    place: Vec<Option<usize>>,
    /// The kept unknowns.
    unknowns: Vec<usize>,
    /// Unknowns of a body.
    body: usize,
    segments: Vec<Segment>,
}

/// Soft unknowns between two bodies, or between a body and an end.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Segment {
    rows: Range<usize>,
    /// First unknown of the body before it.
    left: Option<usize>,
    /// First unknown of the body behind it.
    right: Option<usize>,
}

impl Chain {
    /// The shape of a diagonal system of `size` unknowns that is kept as a whole.
    pub fn whole(size: usize) -> Self {
        Self {
            band: Band::diagonal(0),
            kept: Band::diagonal(size),
            place: (0..size).map(Some).collect(),
            unknowns: (0..size).collect(),
            body: 0,
            segments: Vec::new(),
        }
    }

    /// The shape of a diagonal system of `size` unknowns of which bodies of `body` unknowns each are kept, given by
    /// their first unknowns in ascending order.
    pub fn condensed(size: usize, bodies: &[usize], body: usize) -> Self {
        let unknowns: Vec<usize> = bodies.iter().flat_map(|&first| first..first + body).collect();
        let mut place = vec![None; size];
        unknowns.iter().enumerate().for_each(|(k, &unknown)| place[unknown] = Some(k));
        let mut kept = Band::diagonal(unknowns.len());
        // A segment couples the bodies at its ends.
        for pair in 1..bodies.len() {
            kept.couple(&[body * (pair - 1), body * (pair + 1) - 1]);
        }
        if let Some(last) = body.checked_sub(1) {
            kept.couple(&[0, last]);
        }
        let mut band = Band::diagonal(size);
        if body == BODY_IN_SPACE {
            // The least that kernels are compiled for with so many unknowns a body.
            band.couple(&[0, 10]);
        }
        Self { band, kept, place, unknowns, body, segments: segments(size, bodies, body) }
    }

    /// Makes room for entries between all pairs of the given unknowns.
    ///
    /// # Panics
    /// If two of them are more than sixteen apart: no stencil reaches further.
    pub fn couple(&mut self, unknowns: &[usize]) {
        if self.segments.is_empty() {
            return self.kept.couple(unknowns);
        }
        for &row in unknowns {
            for &column in unknowns {
                // A body before a segment meets it in the border.
                if column <= row && self.place[column].is_none() {
                    self.band.couple(&[column, row]);
                }
            }
        }
    }

    /// Shape of the system of the kept unknowns.
    pub fn kept(&self) -> &Band {
        &self.kept
    }

    /// Unknowns of a body where only bodies are kept, else 0.
    pub fn body(&self) -> usize {
        self.body
    }

    /// The kept unknowns in ascending order.
    pub fn unknowns(&self) -> &[usize] {
        &self.unknowns
    }

    /// Place of an unknown among the kept ones.
    pub fn place(&self, unknown: usize) -> Option<usize> {
        self.place[unknown]
    }

    /// Half-bandwidth of the system in its natural order.
    pub fn half_bandwidth(&self) -> usize {
        if self.segments.is_empty() {
            self.kept.half_bandwidth()
        } else {
            self.band.half_bandwidth()
        }
    }

    /// Number of stored entries.
    pub fn entries(&self) -> usize {
        self.start_of_kept() + self.kept.entries()
    }

    /// Place of entry (row, column), column ≤ row.
    pub fn at(&self, row: usize, column: usize) -> usize {
        match (self.place[row], self.place[column]) {
            (Some(row), Some(column)) => self.start_of_kept() + self.kept.at(row, column),
            (None, Some(column)) => self.start_of_border() + self.body * row + column % self.body,
            (_, None) => self.band.at(row, column),
        }
    }

    /// Place of entry (row, column), column ≤ row; none where the shape has no room for it.
    pub fn find(&self, row: usize, column: usize) -> Option<usize> {
        let reach = |band: &Band, distance: usize| distance <= band.half_bandwidth();
        let stored = match (self.place[row], self.place[column]) {
            (Some(row), Some(column)) => reach(&self.kept, row - column),
            (None, Some(_)) => {
                let segment = self.segments.iter().find(|segment| segment.rows.contains(&row));
                let left = segment.and_then(|segment| segment.left);
                left.is_some_and(|left| (left..left + self.body).contains(&column))
            }
            (_, None) => reach(&self.band, row - column),
        };
        stored.then(|| self.at(row, column))
    }

    /// The entries of the kept unknowns.
    pub fn kept_entries<'a, const W: usize>(&self, matrix: &'a [[f64; W]]) -> &'a [[f64; W]] {
        &matrix[self.start_of_kept()..]
    }

    fn start_of_border(&self) -> usize {
        if self.segments.is_empty() { 0 } else { self.band.entries() }
    }

    fn start_of_kept(&self) -> usize {
        self.start_of_border() + self.body * self.place.len()
    }

    /// Eliminates the soft unknowns in place: what is left of `matrix` and `right` at the kept unknowns is their own
    /// system.
    pub fn condense<const W: usize, I: Isa<W>>(
        &self,
        isa: I,
        matrix: &mut [[f64; W]],
        right: &mut [[f64; W]],
    ) {
        let (soft, kept) = matrix.split_at_mut(self.start_of_kept());
        let (band, border) = soft.split_at_mut(self.start_of_border());
        let mut parts = Parts { chain: self, band, border, kept };
        for segment in &self.segments {
            dispatch!(self, H, ROW, K => {
                vectorized!(isa, parts.condense::<I, H, ROW, K>(isa, segment, right));
            });
        }
    }

    /// Solutions at the soft unknowns, into `solution`, which holds those at the kept ones; `matrix` and `right` are
    /// those that [`Self::condense`] left.
    pub fn recover<const W: usize, I: Isa<W>>(
        &self,
        isa: I,
        matrix: &[[f64; W]],
        right: &[[f64; W]],
        solution: &mut [[f64; W]],
    ) {
        let (band, border) = matrix[..self.start_of_kept()].split_at(self.start_of_border());
        for segment in &self.segments {
            dispatch!(self, H, ROW, K => {
                vectorized!(
                    isa,
                    recover::<W, I, H, ROW, K>(isa, segment, band, border, right, solution)
                );
            });
        }
    }
}

/// The stored parts of a system.
struct Parts<'a, const W: usize> {
    chain: &'a Chain,
    band: &'a mut [[f64; W]],
    border: &'a mut [[f64; W]],
    kept: &'a mut [[f64; W]],
}

impl<const W: usize> Parts<'_, W> {
    #[inline(always)]
    fn condense<I: Isa<W>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        right: &mut [[f64; W]],
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
    fn eliminate_left<I: Isa<W>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        right: &mut [[f64; W]],
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
    fn eliminate_right<I: Isa<W>, const H: usize, const ROW: usize, const K: usize>(
        &mut self,
        isa: I,
        segment: &Segment,
        [first, slot]: [usize; 2],
        right: &mut [[f64; W]],
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
fn subtract<const W: usize, I: Isa<W>>(isa: I, entry: &mut [f64; W], value: I::F) {
    isa.store(isa.load(entry) - value, entry);
}

/// Forward substitution in one row.
#[inline(always)]
fn substitute<const W: usize, I: Isa<W>, const H: usize>(
    isa: I,
    segment: &Segment,
    factored: &[[f64; W]],
    row: usize,
    right: &mut [[f64; W]],
) {
    let mut sum = isa.load(&right[row]);
    for k in first_column::<H>(segment, row)..H {
        sum = sum - isa.load(&factored[k]) * isa.load(&right[row + k - H]);
    }
    isa.store(sum, &mut right[row]);
}

/// Backward substitution through a segment.
#[inline(always)]
fn recover<const W: usize, I: Isa<W>, const H: usize, const ROW: usize, const K: usize>(
    isa: I,
    segment: &Segment,
    band: &[[f64; W]],
    border: &[[f64; W]],
    right: &[[f64; W]],
    solution: &mut [[f64; W]],
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

fn segments(size: usize, bodies: &[usize], body: usize) -> Vec<Segment> {
    let mut segments = Vec::new();
    let (mut start, mut left) = (0, None);
    for right in bodies.iter().map(|&first| Some(first)).chain([None]) {
        let end = right.unwrap_or(size);
        if start < end {
            segments.push(Segment { rows: start..end, left, right });
        }
        (start, left) = (end + body, right);
    }
    segments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// A random chain: soft unknowns, bodies of `body` unknowns, entries where `reach` allows and no body lies between.
    fn random(chain: &Chain, reach: usize, numbers: &[f64]) -> (DMatrix<f64>, Vec<[f64; 1]>) {
        let size = chain.place.len();
        let mut next = numbers.iter().cycle();
        let (mut dense, mut stored) = (DMatrix::zeros(size, size), vec![[0.0]; chain.entries()]);
        for row in 0..size {
            for column in row.saturating_sub(reach)..=row {
                let parts = (column..=row).map(|k| chain.place[k].map(|place| place / chain.body));
                // Neighbours only: a segment and the bodies at its ends, or a body and itself.
                let bodies: Vec<_> = parts.collect();
                let across = bodies.len() > 2
                    && bodies[1..bodies.len() - 1].iter().any(|part| {
                        part.is_some()
                            && *part != bodies[0]
                            && part != bodies.last().expect("two ends")
                    });
                let both = bodies[0].is_some() && bodies.last().expect("two ends").is_some();
                if across || both && bodies[0] != *bodies.last().expect("two ends") {
                    continue;
                }
                let value = next.next().expect("a cycle") + if row == column { 30.0 } else { 0.0 };
                dense[(row, column)] = value;
                dense[(column, row)] = value;
                stored[chain.at(row, column)] = [value];
            }
        }
        (dense, stored)
    }

    fn solves(bodies: &[usize], body: usize, size: usize, reach: usize, numbers: &[f64]) -> f64 {
        let mut chain = Chain::condensed(size, bodies, body);
        let mut free = 0;
        for &first in bodies.iter().chain([&size]) {
            // A segment with the body behind it.
            for row in free..(first + body).min(size) {
                chain.couple(&[row.saturating_sub(reach).max(free), row]);
            }
            free = first + body;
        }
        let (dense, mut matrix) = random(&chain, reach, numbers);
        let mut right: Vec<[f64; 1]> =
            (0..size).map(|k| [numbers[k % numbers.len()] + 0.5]).collect();
        let expected = DVector::from_iterator(size, right.iter().map(|r| r[0]));
        let expected = dense.lu().solve(&expected).expect("regular");
        chain.condense(Scalar, &mut matrix, &mut right);
        let kept = chain.kept();
        let mut own: Vec<[f64; 1]> = chain.kept_entries(&matrix)[..kept.entries()].to_vec();
        let mut found: Vec<[f64; 1]> = chain.unknowns().iter().map(|&k| right[k]).collect();
        kept.factor(Scalar, &mut own);
        kept.solve(Scalar, &own, &mut found);
        let mut solution = vec![[0.0]; size];
        chain.unknowns().iter().zip(found).for_each(|(&k, value)| solution[k] = value);
        chain.recover(Scalar, &matrix, &right, &mut solution);
        (0..size).map(|k| (solution[k][0] - expected[k]).abs()).fold(0.0, f64::max)
    }

    proptest! {
        #[test]
        fn chains_solve_like_a_dense_factorisation(
            numbers in prop::collection::vec(-1.0..1.0f64, 97),
            soft in prop::collection::vec(0usize..12, 4),
        ) {
            for (body, reach) in [(3, 6), (6, 13)] {
                let mut bodies = vec![soft[0]];
                for between in &soft[1..3] {
                    bodies.push(bodies[bodies.len() - 1] + body + between);
                }
                let size = bodies[2] + body + soft[3];
                prop_assert!(solves(&bodies, body, size, reach, &numbers) < 1e-12);
            }
        }
    }
}
