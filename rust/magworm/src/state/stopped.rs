//! Calls that may be stopped: the state of a block is kept before, and put back where the call was stopped.

use super::block::Block;
use crate::interruption::Interruption;
use crate::lanes::Row;

impl<R: Row> Block<R> {
    /// Keeps the present state.
    fn keep(&mut self) {
        let mut kept = std::mem::take(&mut self.kept);
        let rows = self.state_rows();
        kept.rows.reserve_exact(rows.iter().map(|rows| rows.len()).sum());
        rows.iter().for_each(|rows| kept.rows.extend_from_slice(rows));
        kept.step_count.extend_from_slice(&self.step_count);
        kept.status.extend_from_slice(&self.status);
        kept.counters = self.counters;
        self.kept = kept;
    }

    /// Whether work on the block begins: not where the call is stopped already. Where it may be stopped on the way,
    /// the state is kept.
    pub(crate) fn begin(&mut self, interruption: &Interruption<'_>) -> bool {
        if interruption.is_possible() {
            self.keep();
        }
        !interruption.stops()
    }

    /// Goes on without what was kept; its memory stays.
    pub(crate) fn forget(&mut self) {
        self.kept.rows.clear();
        self.kept.step_count.clear();
        self.kept.status.clear();
    }

    /// Goes back to what was kept; says whether anything was. What is derived from the state is to be derived anew.
    pub(crate) fn put_back(&mut self) -> bool {
        let kept = std::mem::take(&mut self.kept);
        let anything = !kept.status.is_empty();
        if anything {
            let mut rest = &kept.rows[..];
            for rows in self.state_rows_mut() {
                let (these, others) = rest.split_at(rows.len());
                rows.copy_from_slice(these);
                rest = others;
            }
            self.step_count.copy_from_slice(&kept.step_count);
            self.status.copy_from_slice(&kept.status);
            self.counters = kept.counters;
        }
        self.kept = kept;
        anything
    }
}
