//! The words of one environment in a snapshot.

use crate::model::{Model, ROWS, Role};
use crate::state::Status;

/// Bytes of a word.
pub(super) const WORD: usize = 8;

/// The words of one environment.
pub(super) struct Column<'a> {
    words: &'a [u8],
    rows: usize,
    magnets: usize,
}

impl<'a> Column<'a> {
    /// Those of a robot of this model.
    pub(super) fn of(model: &Model, words: &'a [u8]) -> Self {
        Self { words, rows: state_rows(model), magnets: model.magnets() }
    }

    fn word(&self, place: usize) -> u64 {
        number(&self.words[WORD * place..])
    }

    fn numbers(&self, first: usize, count: usize) -> impl Iterator<Item = f64> {
        (first..first + count).map(|place| f64::from_bits(self.word(place)))
    }

    /// Fingerprint of its scene.
    pub(super) fn fingerprint(&self) -> u64 {
        self.word(0)
    }

    /// The numbers of its rows.
    pub(super) fn state(&self) -> impl Iterator<Item = f64> {
        self.numbers(1, self.rows)
    }

    /// Solver steps since the reset.
    pub(super) fn step_count(&self) -> u64 {
        self.word(1 + self.rows)
    }

    /// Code of the status.
    pub(super) fn status_code(&self) -> u64 {
        self.word(2 + self.rows)
    }

    /// The status; none where its code is unknown.
    pub(super) fn status(&self) -> Option<Status> {
        u8::try_from(self.status_code()).ok().and_then(Status::from_code)
    }

    /// Factors for the next reset.
    pub(super) fn next_factors(&self) -> impl Iterator<Item = f64> {
        self.numbers(3 + self.rows, Model::PARAMETERS.len())
    }

    /// Magnets for the next reset: 1 for those that are in.
    pub(super) fn next_present(&self) -> impl Iterator<Item = u64> {
        let first = 3 + self.rows + Model::PARAMETERS.len();
        (first..first + self.magnets).map(|place| self.word(place))
    }
}

/// Rows of the state of one environment.
pub(super) fn state_rows(model: &Model) -> usize {
    ROWS.iter().filter(|group| group.role == Role::State).map(|group| (group.rows)(model)).sum()
}

/// Words of one environment: fingerprint, state, solver steps, status, settings.
pub(super) fn column_words(model: &Model) -> usize {
    1 + state_rows(model) + 2 + Model::PARAMETERS.len() + model.magnets()
}

/// A word.
pub(super) fn number(bytes: &[u8]) -> u64 {
    let mut word = [0; WORD];
    word.copy_from_slice(&bytes[..WORD]);
    u64::from_le_bytes(word)
}
