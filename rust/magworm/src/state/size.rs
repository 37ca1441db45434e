//! What a block takes in memory.

use super::block::Block;
use super::rows::Rows;
use crate::lanes::Row;

/// What an allocator adds to each list of rows, at most [bytes].
const OVERHEAD: usize = 64 + 32;

impl<R: Row> Block<R> {
    /// What it takes, with the state that is kept before a call that may be stopped [bytes].
    pub fn bytes(&self) -> usize {
        let of_state = size_of_val(&*self.status) + size_of_val(&*self.step_count);
        let of_lanes = 2 * of_state + size_of_val(&*self.robot_before);
        size_of::<Self>() + sum(&self.state_rows()) + sum(&self.all_rows()) + of_lanes
    }
}

fn sum<R: Row>(lists: &[&Rows<R>]) -> usize {
    lists.iter().map(|rows| size_of_val(&rows[..]) + OVERHEAD).sum()
}
