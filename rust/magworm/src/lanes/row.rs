//! A row: one number of every lane, side by side in memory.

use super::Number;
use std::fmt::Debug;
use std::ops::{Index, IndexMut};

/// One number per lane, as memory holds them. An array of them; the width of a vector appears nowhere else.
pub trait Row:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + 'static
    + Index<usize, Output = Self::Number>
    + IndexMut<usize>
{
    /// What it holds.
    type Number: Number;
    /// How many of them.
    const LANES: usize;

    /// The row of what a function says of each lane.
    fn of_lanes(number: impl FnMut(usize) -> Self::Number) -> Self;
    /// Cuts numbers into rows; a rest that fills none is left out.
    fn cut(numbers: &[Self::Number]) -> &[Self];
    /// See [`cut`](Self::cut).
    fn cut_mut(numbers: &mut [Self::Number]) -> &mut [Self];

    /// Zero in every lane.
    #[inline(always)]
    fn zeros() -> Self {
        Self::of_lanes(|_| Self::Number::default())
    }
}

impl<N: Number, const W: usize> Row for [N; W] {
    type Number = N;
    const LANES: usize = W;

    #[inline(always)]
    fn of_lanes(number: impl FnMut(usize) -> N) -> Self {
        std::array::from_fn(number)
    }
    #[inline(always)]
    fn cut(numbers: &[N]) -> &[Self] {
        numbers.as_chunks().0
    }
    #[inline(always)]
    fn cut_mut(numbers: &mut [N]) -> &mut [Self] {
        numbers.as_chunks_mut().0
    }
}
