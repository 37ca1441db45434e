//! Rows of lanes, aligned to a cache line so that a vector never straddles two.

use crate::lanes::Row;
use std::ops::{Deref, DerefMut};

const LINE_BYTES: usize = 64;

/// A list of rows, one number per lane in each.
#[derive(Debug)]
pub struct Rows<R: Row> {
    /// The rows stand at its end: kernels ask for them so often that one comparison less is felt.
    store: Vec<R::Number>,
    start: usize,
}

impl<R: Row> Rows<R> {
    /// `rows` rows of zeros.
    pub fn zeros(rows: usize) -> Self {
        let line = LINE_BYTES / size_of::<R::Number>();
        let mut store = vec![R::Number::default(); rows * R::LANES + line];
        let start = match store.as_ptr().align_offset(LINE_BYTES) {
            offset if offset < line => offset,
            _ => 0,
        };
        store.truncate(start + rows * R::LANES);
        Self { store, start }
    }
}

impl<R: Row> Clone for Rows<R> {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.len());
        copy.copy_from_slice(self);
        copy
    }
}

impl<R: Row> Deref for Rows<R> {
    type Target = [R];
    #[inline(always)]
    fn deref(&self) -> &[R] {
        R::cut(&self.store[self.start..])
    }
}

impl<R: Row> DerefMut for Rows<R> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [R] {
        R::cut_mut(&mut self.store[self.start..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_aligned_and_survive_cloning() {
        let mut rows = Rows::<[f64; 8]>::zeros(5);
        rows[4][7] = 3.0;
        let copy = rows.clone();
        assert_eq!(copy.len(), 5);
        assert_eq!(copy[4][7], 3.0);
        assert_eq!(copy.as_ptr() as usize % LINE_BYTES, 0);
    }
}
