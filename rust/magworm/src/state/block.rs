//! Environments of one model, one per lane.

use super::kept::Kept;
use super::rows::Rows;
use super::status::{Counters, Status};
use crate::actuator::{ActuatorRows, each};
use crate::lanes::{InstructionSet, Row};
use crate::model::rows::block_rows;
use crate::model::{Model, ROWS};

macro_rules! declare {
    (
        State { $($(#[doc = $state_doc:literal])+ $state:ident: $state_unit:literal, $state_rows:expr $(=> $allowed:expr)?;)* }
        Derived { $($(#[doc = $derived_doc:literal])+ $derived:ident: $derived_unit:literal, $derived_rows:expr;)* }
        Workspace { $($(#[doc = $work_doc:literal])+ $work:ident: $work_unit:literal, $work_rows:expr;)* }
        Contact { $($(#[doc = $contact_doc:literal])+ $contact:ident: $contact_unit:literal, $contact_rows:expr;)* }
    ) => {
        /// The state of as many environments as a row has lanes, and the workspace of their step. Its rows are declared
        /// in [`crate::model::ROWS`].
        #[derive(Clone, Debug)]
        pub struct Block<R: Row> {
            $($(#[doc = $state_doc])+ #[doc = concat!("[", $state_unit, "]")] pub $state: Rows<R>,)*
            /// Solver steps since the reset, shape [lanes].
            pub step_count: Box<[u64]>,
            /// Status of each environment, shape [lanes].
            pub status: Box<[Status]>,
            $($(#[doc = $derived_doc])+ #[doc = concat!("[", $derived_unit, "]")] pub $derived: Rows<R>,)*
            $($(#[doc = $work_doc])+ #[doc = concat!("[", $work_unit, "]")] pub $work: Rows<R>,)*
            /// The contact solve.
            pub contact: Workspace<R>,
            /// The robot of the agent seen from above when a control step began, see [`Self::robot_pose`], shape [lanes].
            pub robot_before: Box<[[f64; 3]]>,
            /// The state before a call that may be stopped.
            pub(super) kept: Kept<R>,
            /// The instruction set that a batch steps the block on; bits do not depend on it.
            pub set: InstructionSet,
            /// Work done.
            pub counters: Counters,
        }

        /// Rows of the contact solve of one step; nothing in here outlives it.
        #[derive(Clone, Debug)]
        pub struct Workspace<R: Row> {
            $($(#[doc = $contact_doc])+ #[doc = concat!("[", $contact_unit, "]")] pub $contact: Rows<R>,)*
        }

        impl<R: Row> Block<R> {
            /// A block of zeros, whose lanes are unused.
            pub(crate) fn zeros(model: &Model) -> Self {
                // Fields are made in the order of their declaration.
                let mut counts = ROWS.iter().map(|group| (group.rows)(model));
                let mut rows = || Rows::zeros(counts.next().unwrap_or(0));
                Self {
                    $($state: rows(),)*
                    $($derived: rows(),)*
                    $($work: rows(),)*
                    contact: Workspace { $($contact: rows(),)* },
                    step_count: vec![0; R::LANES].into(),
                    status: vec![Status::Unused; R::LANES].into(),
                    robot_before: vec![[0.0; 3]; R::LANES].into(),
                    kept: Kept::default(),
                    set: InstructionSet::widest(),
                    counters: Counters::default(),
                }
            }

            /// The rows of the state, in the order of their declaration: with `step_count` and `status` all that a snapshot
            /// needs to hold.
            pub fn state_rows(&self) -> [&Rows<R>; STATE_ROWS] {
                [$(&self.$state),*]
            }

            /// All rows.
            pub(super) fn all_rows(&self) -> [&Rows<R>; ROWS.len()] {
                [$(&self.$state,)* $(&self.$derived,)* $(&self.$work,)* $(&self.contact.$contact),*]
            }

            /// The rows of [`Self::state_rows`], to be written.
            pub fn state_rows_mut(&mut self) -> [&mut Rows<R>; STATE_ROWS] {
                [$(&mut self.$state),*]
            }
        }

        const STATE_ROWS: usize = [$(stringify!($state)),*].len();
    };
}
block_rows!(declare);

impl<R: Row> Block<R> {
    /// The rows of an actuator, by its place in the list.
    pub fn actuator_rows(&mut self, model: &Model, place: usize) -> ActuatorRows<'_, R> {
        let Self { stage, target, action, .. } = self;
        let all = ActuatorRows { state: stage, target, action };
        let mut each = each(&model.program.actuators, all);
        each.nth(place).expect("an actuator of the model").1
    }
}
