//! The state of W environments side by side, and batches of them.

mod batch;
mod block;
mod pool;
mod rows;
mod snapshot;

pub use batch::{Batch, LaneChoice, StepOutput, View};
pub use block::{Block, Counters, Status};
pub use rows::Rows;
pub use snapshot::SnapshotError;
