//! Symmetric systems of a chain: rigid bodies joined by soft segments, one system per lane.
//!
//! Contact acts on the bodies alone and needs many passes; the segments between them do not change meanwhile.
//! So the soft unknowns are eliminated first, once a step (static condensation, Schur complement):
//! S = A_kk − A_ks A_ss⁻¹ A_sk over the *kept* unknowns of the bodies, 18 instead of 68 for a worm of three
//! magnets in space. Once their velocities are known, those of the soft unknowns follow.
//!
//! Within a segment unknowns are numbered along the body, so A_ss is banded, and the body behind it only meets its
//! last unknowns: its rows continue the band. The body before it meets its first unknowns, and elimination carries
//! that on to all of them: a *border* of as many columns as the body has unknowns. A segment is factored as L D Lᵀ
//! without pivoting, row by row.
//!
//! A system without bodies to keep, or whose soft unknowns touch the ground, is kept as a whole.

mod segment;

use super::Isa;
use super::banded::{Band, OutOfReach, vectorized};
use segment::{Parts, recover};
use std::ops::Range;

/// Unknowns of a body in space.
const BODY_IN_SPACE: usize = 6;
/// Half-bandwidths of segments between bodies that kernels are compiled for: with three unknowns a body, and with six. No number
/// stands in both.
const COMPILED_IN_PLANE: [usize; 3] = [5, 6, 8];
const COMPILED_IN_SPACE: [usize; 3] = [10, 11, 13];

/// Calls with half-bandwidth H, length of a row, and unknowns of a body K as constants.
macro_rules! dispatch {
    ($chain:expr, $h:ident, $row:ident, $k:ident => $work:block) => {
        match $chain.band.half_bandwidth() {
            5 => dispatch!(5, 6, 3, $h, $row, $k, $work),
            6 => dispatch!(6, 7, 3, $h, $row, $k, $work),
            8 => dispatch!(8, 9, 3, $h, $row, $k, $work),
            10 => dispatch!(10, 11, 6, $h, $row, $k, $work),
            11 => dispatch!(11, 12, 6, $h, $row, $k, $work),
            _ => dispatch!(13, 14, 6, $h, $row, $k, $work),
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
    before: Option<usize>,
    /// First unknown of the body behind it.
    behind: Option<usize>,
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
    ///
    /// # Errors
    /// Kernels are not compiled for two bodies as large.
    pub fn condensed(size: usize, bodies: &[usize], body: usize) -> Result<Self, OutOfReach> {
        let unknowns: Vec<usize> = bodies.iter().flat_map(|&first| first..first + body).collect();
        let mut place = vec![None; size];
        unknowns.iter().enumerate().for_each(|(k, &unknown)| place[unknown] = Some(k));
        let mut kept = Band::diagonal(unknowns.len());
        // A segment couples the bodies at its ends.
        for pair in 1..bodies.len() {
            let coupled = kept.couple(&[body * (pair - 1), body * (pair + 1) - 1]);
            let (from, to) = (bodies[pair - 1], bodies[pair] + body - 1);
            coupled.map_err(|_| OutOfReach { from, to })?;
        }
        let band = if body == BODY_IN_SPACE {
            Band::compiled_for(size, &COMPILED_IN_SPACE)
        } else {
            Band::compiled_for(size, &COMPILED_IN_PLANE)
        };
        Ok(Self { band, kept, place, unknowns, body, segments: segments(size, bodies, body) })
    }

    /// Makes room for entries between all pairs of the given unknowns.
    ///
    /// # Errors
    /// Two of them are further apart than kernels are compiled for, or a body lies between them.
    pub fn couple(&mut self, unknowns: &[usize]) -> Result<(), OutOfReach> {
        if self.segments.is_empty() {
            return self.kept.couple(unknowns);
        }
        for &row in unknowns {
            for &column in unknowns.iter().filter(|&&column| column <= row) {
                self.couple_pair(row, column)?;
            }
        }
        Ok(())
    }

    fn couple_pair(&mut self, row: usize, column: usize) -> Result<(), OutOfReach> {
        let out_of_reach = OutOfReach { from: column, to: row };
        match (self.place[row], self.place[column]) {
            (Some(row), Some(column)) => self.kept.couple(&[column, row]).map_err(|_| out_of_reach),
            // A body before a segment meets it in the border, which has room for no other.
            (None, Some(_)) => self.find(row, column).map(|_| ()).ok_or(out_of_reach),
            (_, None) if self.ends_before(column, row) => Err(out_of_reach),
            (_, None) => self.band.couple(&[column, row]),
        }
    }

    /// Whether the segment of a soft unknown, with the body behind it, ends before another unknown.
    fn ends_before(&self, soft: usize, unknown: usize) -> bool {
        let segment = self.segments.iter().find(|segment| segment.rows.contains(&soft));
        let end = |segment: &Segment| segment.behind.map_or(segment.rows.end, |b| b + self.body);
        segment.is_some_and(|segment| end(segment) <= unknown)
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
                let before = segment.and_then(|segment| segment.before);
                before.is_some_and(|before| (before..before + self.body).contains(&column))
            }
            (_, None) => reach(&self.band, row - column),
        };
        stored.then(|| self.at(row, column))
    }

    /// The entries of the kept unknowns.
    pub fn kept_entries<'a, R>(&self, matrix: &'a [R]) -> &'a [R] {
        &matrix[self.start_of_kept()..]
    }

    fn start_of_border(&self) -> usize {
        if self.segments.is_empty() { 0 } else { self.band.entries() }
    }

    fn start_of_kept(&self) -> usize {
        self.start_of_border() + self.body * self.place.len()
    }

    /// Sets all entries to zero that elimination leaves otherwise; the rest, two fifths for a worm, are zeros from the start.
    #[inline(always)]
    pub fn clear<I: Isa>(&self, isa: I, matrix: &mut [I::Row]) {
        let (soft, kept) = matrix.split_at_mut(self.start_of_kept());
        zero(isa, &mut kept[self.kept.inner()]);
        if self.segments.is_empty() {
            return;
        }
        let (band, border) = soft.split_at_mut(self.start_of_border());
        zero(isa, &mut band[self.band.inner()]);
        for segment in self.segments.iter().filter(|segment| segment.before.is_some()) {
            let rows = self.body * segment.rows.start..self.body * segment.rows.end;
            zero(isa, &mut border[rows]);
        }
    }

    /// Eliminates the soft unknowns in place: what is left of `matrix` and `rhs` at the kept unknowns is their own
    /// system.
    pub fn condense<I: Isa>(&self, isa: I, matrix: &mut [I::Row], rhs: &mut [I::Row]) {
        let (soft, kept) = matrix.split_at_mut(self.start_of_kept());
        let (band, border) = soft.split_at_mut(self.start_of_border());
        let mut parts = Parts { chain: self, band, border, kept };
        for segment in &self.segments {
            dispatch!(self, H, ROW, K => {
                vectorized!(isa, parts.condense::<I, H, ROW, K>(isa, segment, rhs));
            });
        }
    }

    /// Solutions at the soft unknowns, into `solution`, which holds those at the kept ones; `matrix` and `rhs` are
    /// those that [`Self::condense`] left.
    pub fn recover<I: Isa>(
        &self,
        isa: I,
        matrix: &[I::Row],
        rhs: &[I::Row],
        solution: &mut [I::Row],
    ) {
        let (band, border) = matrix[..self.start_of_kept()].split_at(self.start_of_border());
        for segment in &self.segments {
            dispatch!(self, H, ROW, K => {
                vectorized!(
                    isa,
                    recover::<I, H, ROW, K>(isa, segment, band, border, rhs, solution)
                );
            });
        }
    }
}

#[inline(always)]
fn zero<I: Isa>(isa: I, rows: &mut [I::Row]) {
    for row in rows {
        isa.store(isa.splat(0.0), row);
    }
}

fn segments(size: usize, bodies: &[usize], body: usize) -> Vec<Segment> {
    let mut segments = Vec::new();
    let (mut start, mut before) = (0, None);
    for behind in bodies.iter().map(|&first| Some(first)).chain([None]) {
        let end = behind.unwrap_or(size);
        if start < end {
            segments.push(Segment { rows: start..end, before, behind });
        }
        (start, before) = (end + body, behind);
    }
    segments
}

#[cfg(test)]
mod tests;
