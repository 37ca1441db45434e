//! The state of environments side by side: rows of numbers, and where the parts of a robot are.

mod block;
mod kept;
mod pose;
mod rows;
mod size;
mod status;
mod stopped;

pub use block::{Block, Workspace};
pub use pose::{Pose, Twist};
pub use rows::Rows;
pub use status::{Counters, Status};
