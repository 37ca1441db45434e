//! The state of a block as it was before a call that may be stopped.

use super::status::{Counters, Status};
use crate::lanes::Row;

/// A state, or none: then it is empty.
#[derive(Clone, Debug)]
pub struct Kept<R: Row> {
    pub(super) rows: Vec<R>,
    pub(super) step_count: Vec<u64>,
    pub(super) status: Vec<Status>,
    pub(super) counters: Counters,
}

impl<R: Row> Default for Kept<R> {
    fn default() -> Self {
        Self {
            rows: Vec::new(),
            step_count: Vec::new(),
            status: Vec::new(),
            counters: Counters::default(),
        }
    }
}
