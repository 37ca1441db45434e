//! How an environment fares, and what work a block has done.

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
    /// Wrenches of one magnet on another.
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
