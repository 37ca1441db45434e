//! The state of environments side by side, and batches of them.

mod batch;
mod block;
mod control;
mod pool;
mod pose;
mod rollout;
mod rows;
mod snapshot;
mod view;

pub use batch::{Batch, LaneChoice, StepOutput};
pub use block::{Block, Counters, Status};
pub use control::Steps;
pub(crate) use pool::Pool;
pub use pose::{Pose, Twist};
pub use rollout::{Plan, RolloutOutput};
pub use rows::Rows;
pub use snapshot::SnapshotError;
pub use view::View;
