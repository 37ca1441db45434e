//! Rows of lanes, aligned to a cache line so that a vector never straddles two.

use crate::lanes::Number;
use std::ops::{Deref, DerefMut};

const LINE_BYTES: usize = 64;

/// A list of rows, one number per lane in each.
#[derive(Debug)]
pub struct Rows<const W: usize, N = f64> {
    /// The rows stand at its end: kernels ask for them so often that one comparison less is felt.
    store: Vec<N>,
    start: usize,
}

impl<const W: usize, N: Number> Rows<W, N> {
    /// `rows` rows of zeros.
    pub fn zeros(rows: usize) -> Self {
        let line = LINE_BYTES / size_of::<N>();
        let mut store = vec![N::default(); rows * W + line];
        let start = match store.as_ptr().align_offset(LINE_BYTES) {
            offset if offset < line => offset,
            _ => 0,
        };
        store.truncate(start + rows * W);
        Self { store, start }
    }
}

impl<const W: usize, N: Number> Clone for Rows<W, N> {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.len());
        copy.copy_from_slice(self);
        copy
    }
}

impl<const W: usize, N: Number> Deref for Rows<W, N> {
    type Target = [[N; W]];
    #[inline(always)]
    fn deref(&self) -> &Self::Target {
        self.store[self.start..].as_chunks().0
    }
}

impl<const W: usize, N: Number> DerefMut for Rows<W, N> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Self::Target {
        self.store[self.start..].as_chunks_mut().0
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
