//! Environments of one model, one per lane.

use super::kept::Kept;
use super::rows::Rows;
use crate::actuator::ActuatorRows;
use crate::lanes::{InstructionSet, Row};
use crate::model::rows::block_rows;
use crate::model::{Model, ROWS};

/// Why an environment stands still.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// It does not: the environment runs.
    #[default]
    Running = 0,
    /// A velocity was infinite or not a number.
    NotFinite = 1,
    /// An element was stretched beyond three times or squeezed below a tenth of its rest length.
    Overstretched = 2,
    /// A node sank into the ground by more than the body's thickness.
    Sunk = 3,
    /// A node or magnet ended a control step faster than the scene's `solver.fastest_m_s`.
    TooFast = 4,
    /// The lane belongs to no environment: the batch is not a multiple of the lanes.
    Unused = 255,
}

impl Status {
    /// The status of a code; none for codes that no status has.
    pub fn from_code(code: u8) -> Option<Self> {
        [
            Self::Running,
            Self::NotFinite,
            Self::Overstretched,
            Self::Sunk,
            Self::TooFast,
            Self::Unused,
        ]
        .into_iter()
        .find(|status| *status as u8 == code)
    }

    /// One sentence about it.
    pub fn text(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::NotFinite => "a velocity became infinite or not a number",
            Self::Overstretched => {
                "an element was stretched beyond 3 times or squeezed below 0.1 of its rest length"
            }
            Self::Sunk => "a node sank into the ground by more than the body's thickness",
            Self::TooFast => "a node or magnet moved faster than solver.fastest_m_s",
            Self::Unused => "unused lane",
        }
    }
}

/// Work done since the block was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Solver steps of the block.
    pub steps: u64,
    /// Linear systems with contact that were solved, or without where nothing touches.
    pub factorisations: u64,
    /// Trials of the contact solve, see [`crate::contact`].
    pub trials: u64,
    /// Wrenches of one drive magnet on one body magnet.
    pub wrenches: u64,
}

impl Counters {
    /// The sum of both.
    pub fn plus(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            factorisations: self.factorisations + other.factorisations,
            trials: self.trials + other.trials,
            wrenches: self.wrenches + other.wrenches,
        }
    }
}

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
            /// The robot seen from above when a control step began, see [`Self::robot_pose`], shape [lanes].
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
    /// The rows of the actuators.
    pub fn actuator_rows(&mut self) -> ActuatorRows<'_, R> {
        let Self { stage, target, action, .. } = self;
        ActuatorRows { state: stage, target, action }
    }
}
