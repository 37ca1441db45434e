//! Rows of lanes, aligned to a cache line so that a vector never straddles two.

use std::ops::{Deref, DerefMut};

const LINE_BYTES: usize = 64;
const LINE: usize = LINE_BYTES / size_of::<f64>();

/// A list of rows, one number per lane in each.
#[derive(Debug)]
pub struct Rows<const W: usize> {
    store: Vec<f64>,
    start: usize,
    rows: usize,
}

impl<const W: usize> Rows<W> {
    /// `rows` rows of zeros.
    pub fn zeros(rows: usize) -> Self {
        let store = vec![0.0; rows * W + LINE];
        let start = match store.as_ptr().align_offset(LINE_BYTES) {
            offset if offset < LINE => offset,
            _ => 0,
        };
        Self { store, start, rows }
    }
}

impl<const W: usize> Clone for Rows<W> {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.rows);
        copy.copy_from_slice(self);
        copy
    }
}

impl<const W: usize> Deref for Rows<W> {
    type Target = [[f64; W]];
    #[inline(always)]
    fn deref(&self) -> &Self::Target {
        self.store[self.start..self.start + self.rows * W].as_chunks().0
    }
}

impl<const W: usize> DerefMut for Rows<W> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Self::Target {
        self.store[self.start..self.start + self.rows * W].as_chunks_mut().0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_aligned_and_survive_cloning() {
        let mut rows = Rows::<8>::zeros(5);
        rows[4][7] = 3.0;
        let copy = rows.clone();
        assert_eq!(copy.len(), 5);
        assert_eq!(copy[4][7], 3.0);
        assert_eq!(copy.as_ptr() as usize % LINE_BYTES, 0);
    }
}
