//! Symmetric banded systems, factored as L D Lᵀ without pivoting, one system per lane.
//!
//! A matrix is stored by rows of its lower half: row r holds columns r − h … r, h the half-bandwidth.
//! Above the first and below the last row stand h ghost rows of zeros, so that no loop has to know where
//! the matrix ends. The half-bandwidth is one of a few, known when the kernels are compiled: inner
//! loops unroll and their numbers stay in registers.

use super::Isa;
use std::ops::Range;

/// Half-bandwidths that kernels are compiled for. In the plane: rods, worms, magnets next to each other, and
/// nodes that multipliers tie to a magnet from both sides; in space: rods, worms, magnets next to each other.
const COMPILED: [usize; 7] = [5, 6, 8, 10, 11, 13, 16];

/// Why there are as many rows above and below each row as the half-bandwidth.
pub(super) const GHOSTS: &str = "ghost rows stand above the first row and below the last";

/// Compiles an expression for the instruction set as a function of its own.
macro_rules! vectorized {
    ($isa:expr, $work:expr) => {
        $isa.vectorize(
            #[inline(always)]
            || $work,
        )
    };
}
pub(super) use vectorized;

/// Writes a block out once for each k from 0 below an end of at most 16 that is known when it is compiled. Compilers
/// leave long loops as loops, and a loop keeps its numbers in memory and asks at each of them whether it is there.
macro_rules! unrolled {
    ($k:ident < $end:expr => $work:block) => {
        unrolled!(@ $k, $end, $work, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)
    };
    (@ $k:ident, $end:expr, $work:block, $($number:literal)*) => {
        $(
            if $number < $end {
                let $k: usize = $number;
                $work
            }
        )*
    };
}
pub(super) use unrolled;

/// Two unknowns of a stencil that no compiled kernel couples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfReach {
    /// The lower one.
    pub from: usize,
    /// The higher one.
    pub to: usize,
}

/// Shape of a symmetric banded matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Band {
    size: usize,
    half_bandwidth: usize,
    /// Half-bandwidths that it may have, in ascending order.
    compiled: &'static [usize],
}

impl Band {
    /// The shape of a diagonal matrix with `size` rows.
    pub fn diagonal(size: usize) -> Self {
        Self::compiled_for(size, &COMPILED)
    }

    /// The same, where kernels are compiled for some half-bandwidths only.
    pub(super) fn compiled_for<const N: usize>(size: usize, compiled: &'static [usize; N]) -> Self {
        const { assert!(N > 0) };
        Self { size, half_bandwidth: compiled[0], compiled }
    }

    /// Makes room for entries between all pairs of the given unknowns.
    ///
    /// # Errors
    /// Two of them are further apart than kernels are compiled for.
    pub fn couple(&mut self, unknowns: &[usize]) -> Result<(), OutOfReach> {
        let (Some(&from), Some(&to)) = (unknowns.iter().min(), unknowns.iter().max()) else {
            return Ok(());
        };
        let needed = self.half_bandwidth.max(to - from);
        let found = self.compiled.iter().find(|&&h| h >= needed);
        self.half_bandwidth = *found.ok_or(OutOfReach { from, to })?;
        Ok(())
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Largest distance of an entry from the diagonal.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Number of stored entries, ghost rows included.
    pub fn entries(&self) -> usize {
        (self.size + 2 * self.half_bandwidth) * (self.half_bandwidth + 1)
    }

    /// Places of all entries but those of the ghost rows.
    pub fn inner(&self) -> Range<usize> {
        let ghosts = self.half_bandwidth * (self.half_bandwidth + 1);
        ghosts..self.entries() - ghosts
    }

    /// Place of entry (row, column), column ≤ row.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> usize {
        let h = self.half_bandwidth;
        (row + h) * (h + 1) + h + column - row
    }

    /// Factors in place: strictly lower entries become L, diagonal entries 1/D.
    pub fn factor<I: Isa>(&self, isa: I, matrix: &mut [I::Row]) {
        match self.half_bandwidth {
            5 => vectorized!(isa, factor::<I, 5, 6>(isa, self.size, matrix)),
            6 => vectorized!(isa, factor::<I, 6, 7>(isa, self.size, matrix)),
            8 => vectorized!(isa, factor::<I, 8, 9>(isa, self.size, matrix)),
            10 => vectorized!(isa, factor::<I, 10, 11>(isa, self.size, matrix)),
            11 => vectorized!(isa, factor::<I, 11, 12>(isa, self.size, matrix)),
            13 => vectorized!(isa, factor::<I, 13, 14>(isa, self.size, matrix)),
            _ => vectorized!(isa, factor::<I, 16, 17>(isa, self.size, matrix)),
        }
    }

    /// Matrix times vector, from the entries of the lower half.
    #[inline(always)]
    pub fn multiply<I: Isa>(
        &self,
        isa: I,
        matrix: &[I::Row],
        vector: &[I::Row],
        product: &mut [I::Row],
    ) {
        let h = self.half_bandwidth;
        for row in 0..self.size {
            let first = row.saturating_sub(h);
            let (before, after) = vector.split_at(row + 1);
            let before = &before[first..];
            let left = &matrix[self.at(row, first)..][..before.len()];
            let mut sum = isa.splat(0.0);
            for k in 0..before.len() {
                sum = sum + isa.load(&left[k]) * isa.load(&before[k]);
            }
            // Entries of a column stand a row less one apart.
            let after = &after[..h.min(after.len())];
            let mut place = self.at(row, row);
            for k in 0..after.len() {
                place += h;
                sum = sum + isa.load(&matrix[place]) * isa.load(&after[k]);
            }
            isa.store(sum, &mut product[row]);
        }
    }

    /// Solves in place with a factored matrix.
    pub fn solve<I: Isa>(&self, isa: I, factored: &[I::Row], rhs: &mut [I::Row]) {
        match self.half_bandwidth {
            5 => vectorized!(isa, solve::<I, 5, 6>(isa, factored, rhs)),
            6 => vectorized!(isa, solve::<I, 6, 7>(isa, factored, rhs)),
            8 => vectorized!(isa, solve::<I, 8, 9>(isa, factored, rhs)),
            10 => vectorized!(isa, solve::<I, 10, 11>(isa, factored, rhs)),
            11 => vectorized!(isa, solve::<I, 11, 12>(isa, factored, rhs)),
            13 => vectorized!(isa, solve::<I, 13, 14>(isa, factored, rhs)),
            _ => vectorized!(isa, solve::<I, 16, 17>(isa, factored, rhs)),
        }
    }
}

/// Row by row: u = L D of the row's entries from the rows above, then L = u / D.
#[inline(always)]
fn factor<I: Isa, const H: usize, const ROW: usize>(isa: I, size: usize, matrix: &mut [I::Row]) {
    let (rows, _) = matrix.as_chunks_mut::<ROW>();
    for row in H..size + H {
        factor_row::<I, H, ROW>(isa, rows, row, 0);
    }
}

/// One row, given those above it, whose entries begin in column `first`.
#[inline(always)]
pub(super) fn factor_row<I: Isa, const H: usize, const ROW: usize>(
    isa: I,
    rows: &mut [[I::Row; ROW]],
    row: usize,
    first: usize,
) {
    let one = isa.splat(1.0);
    let (above, below) = rows.split_at_mut(row);
    let above = above.last_chunk::<H>().expect(GHOSTS);
    let current = &mut below[0];
    let mut pivot = isa.load(&current[H]);
    let mut u = [one; H];
    unrolled!(column < H => {
        if column >= first {
            let mut sum = isa.load(&current[column]);
            for k in first..column {
                sum = sum - u[k] * isa.load(&above[column][H + k - column]);
            }
            u[column] = sum;
        }
    });
    unrolled!(column < H => {
        if column >= first {
            let l = u[column] * isa.load(&above[column][H]);
            pivot = pivot - u[column] * l;
            isa.store(l, &mut current[column]);
        }
    });
    isa.store(one / pivot, &mut current[H]);
}

/// Forward and backward substitution; the last H unknowns travel along in registers.
#[inline(always)]
fn solve<I: Isa, const H: usize, const ROW: usize>(
    isa: I,
    factored: &[I::Row],
    rhs: &mut [I::Row],
) {
    let (rows, _) = factored.as_chunks::<ROW>();
    let mut known = [isa.splat(0.0); H];
    for (row, value) in rhs.iter_mut().enumerate() {
        let mut sum = isa.load(value);
        for k in 0..H {
            sum = sum - isa.load(&rows[row + H][k]) * known[k];
        }
        for k in 1..H {
            known[k - 1] = known[k];
        }
        known[H - 1] = sum;
        isa.store(sum, value);
    }
    let mut known = [isa.splat(0.0); H];
    for (row, value) in rhs.iter_mut().enumerate().rev() {
        let mut sum = isa.load(value) * isa.load(&rows[row + H][H]);
        let below = rows[row + H + 1..].first_chunk::<H>().expect(GHOSTS);
        for k in 0..H {
            sum = sum - isa.load(&below[k][H - 1 - k]) * known[k];
        }
        for k in (1..H).rev() {
            known[k] = known[k - 1];
        }
        known[0] = sum;
        isa.store(sum, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    #[test]
    fn a_stencil_beyond_the_compiled_bands_is_told_and_changes_nothing() {
        let mut band = Band::diagonal(40);
        assert_eq!(band.couple(&[3, 9, 19]), Ok(()));
        let before = band.clone();
        assert_eq!(band.couple(&[9, 21, 4]), Err(OutOfReach { from: 4, to: 21 }));
        assert_eq!(band, before);
    }

    /// A random symmetric matrix of the given shape, dense and banded, dominant or a saddle point.
    fn matrices(band: &Band, numbers: &[f64]) -> (DMatrix<f64>, Vec<[f64; 1]>) {
        let n = band.size();
        let mut dense = DMatrix::zeros(n, n);
        let mut packed = vec![[0.0]; band.entries()];
        let mut next = numbers.iter().cycle();
        for row in 0..n {
            for column in row.saturating_sub(band.half_bandwidth())..=row {
                let mut value = *next.next().unwrap();
                if row == column {
                    value = (20.0 + value) * if row % 5 == 4 { -1.0 } else { 1.0 };
                }
                dense[(row, column)] = value;
                dense[(column, row)] = value;
                packed[band.at(row, column)] = [value];
            }
        }
        (dense, packed)
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
            let (dense, mut packed) = matrices(&band, &numbers);
            let rhs = DVector::from_iterator(size, numbers.iter().copied().take(size));
            let expected = dense.lu().solve(&rhs).unwrap();
            let mut solution: Vec<[f64; 1]> = rhs.iter().map(|&r| [r]).collect();
            band.factor(Scalar, &mut packed);
            band.solve(Scalar, &packed, &mut solution);
            for row in 0..size {
                prop_assert!((solution[row][0] - expected[row]).abs() < 1e-12);
            }
        }
    }
}
