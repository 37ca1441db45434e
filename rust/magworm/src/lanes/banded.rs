//! Symmetric banded systems, factored as L D Lᵀ without pivoting, one system per lane.
//!
//! A matrix is stored by rows of its lower half: row r holds columns r − h … r (h the half-bandwidth),
//! entries left of the first non-zero column of a row are never touched.

use super::Isa;

/// Shape of a symmetric banded matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Band {
    first: Vec<usize>,
    half_bandwidth: usize,
}

impl Band {
    /// The shape of a diagonal matrix with `size` rows.
    pub fn diagonal(size: usize) -> Self {
        Self { first: (0..size).collect(), half_bandwidth: 0 }
    }

    /// Makes room for entries between all pairs of the given unknowns.
    pub fn couple(&mut self, dofs: &[usize]) {
        let Some(&lowest) = dofs.iter().min() else { return };
        for &row in dofs {
            self.first[row] = self.first[row].min(lowest);
            self.half_bandwidth = self.half_bandwidth.max(row - self.first[row]);
        }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.first.len()
    }

    /// Largest distance of an entry from the diagonal.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Number of stored entries.
    pub fn entries(&self) -> usize {
        self.size() * (self.half_bandwidth + 1)
    }

    /// Place of entry (row, column), column ≤ row.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> usize {
        row * (self.half_bandwidth + 1) + self.half_bandwidth + column - row
    }

    /// Factors in place: strictly lower entries become L, diagonal entries 1/D.
    #[inline(always)]
    pub fn factor<const W: usize, I: Isa<W>>(&self, isa: I, matrix: &mut [[f64; W]]) {
        let one = isa.splat(1.0);
        for row in 0..self.size() {
            let first = self.first[row];
            let mut pivot = isa.load(&matrix[self.at(row, row)]);
            for column in first..row {
                // u = L D of this entry; the column's own L was divided by D when it was made.
                let mut u = isa.load(&matrix[self.at(row, column)]);
                for k in first.max(self.first[column])..column {
                    u = u - isa.load(&matrix[self.at(row, k)])
                        * isa.load(&matrix[self.at(column, k)]);
                }
                isa.store(u, &mut matrix[self.at(row, column)]);
            }
            for column in first..row {
                let u = isa.load(&matrix[self.at(row, column)]);
                let l = u * isa.load(&matrix[self.at(column, column)]);
                pivot = pivot - u * l;
                isa.store(l, &mut matrix[self.at(row, column)]);
            }
            isa.store(one / pivot, &mut matrix[self.at(row, row)]);
        }
    }

    /// Solves in place with a factored matrix.
    #[inline(always)]
    pub fn solve<const W: usize, I: Isa<W>>(
        &self,
        isa: I,
        factored: &[[f64; W]],
        right: &mut [[f64; W]],
    ) {
        for row in 0..self.size() {
            let mut sum = isa.load(&right[row]);
            for column in self.first[row]..row {
                sum = sum - isa.load(&factored[self.at(row, column)]) * isa.load(&right[column]);
            }
            isa.store(sum, &mut right[row]);
        }
        for row in 0..self.size() {
            let scaled = isa.load(&right[row]) * isa.load(&factored[self.at(row, row)]);
            isa.store(scaled, &mut right[row]);
        }
        for row in (0..self.size()).rev() {
            let known = isa.load(&right[row]);
            for column in self.first[row]..row {
                let sum =
                    isa.load(&right[column]) - isa.load(&factored[self.at(row, column)]) * known;
                isa.store(sum, &mut right[column]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// A random symmetric matrix of the given shape, dense and banded, dominant or a saddle point.
    fn matrices(band: &Band, numbers: &[f64]) -> (DMatrix<f64>, Vec<[f64; 1]>) {
        let n = band.size();
        let mut dense = DMatrix::zeros(n, n);
        let mut packed = vec![[0.0]; band.entries()];
        let mut next = numbers.iter().cycle();
        for row in 0..n {
            for column in band.first[row]..=row {
                let mut value = *next.next().unwrap();
                if row == column {
                    value = (8.0 + value) * if row % 5 == 4 { -1.0 } else { 1.0 };
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
            couplings in prop::collection::vec((0usize..14, 1usize..5), 0..12),
        ) {
            let mut band = Band::diagonal(20);
            couplings.iter().for_each(|&(a, span)| band.couple(&[a, a + span]));
            let (dense, mut packed) = matrices(&band, &numbers);
            let right = DVector::from_iterator(20, numbers.iter().copied().take(20));
            let expected = dense.lu().solve(&right).unwrap();
            let mut solution: Vec<[f64; 1]> = right.iter().map(|&r| [r]).collect();
            band.factor(Scalar, &mut packed);
            band.solve(Scalar, &packed, &mut solution);
            for row in 0..20 {
                prop_assert!((solution[row][0] - expected[row]).abs() < 1e-12);
            }
        }
    }
}
