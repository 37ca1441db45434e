//! Saving and restoring a batch, bit for bit.
//!
//! A snapshot is a list of little-endian words of eight bytes: a header (magic, layout, environments, words per
//! environment, checksum of all other words) and one column per environment (fingerprint of its scene, rows of the state,
//! solver steps, status, settings of the next reset), so it does not depend on how environments were laid out in lanes.
//! Where scenes need different numbers of words, the shorter columns end with zeros.
//! Numbers are `f64`, which hold those of a scene in single precision too.
//!
//! The layout is a sum over the declaration of the rows ([`ROWS`]): a row more, one renamed or moved gives another.
//! A snapshot is checked whole before anything is changed.

use super::Batch;
use super::check::{SnapshotError, check};
use super::column::{Column, WORD, column_words, number};
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::{Number, Row};
use crate::model::{Model, ROWS, Role, Sum};
use crate::reset::apply_parameters;
use crate::state::Block;
use std::sync::Arc;

const MAGIC: &[u8; WORD] = b"MAGWORM2";
/// Words of the header.
const HEADER: usize = 5;
/// Its last word.
const CHECKSUM: usize = HEADER - 1;

impl Batch {
    /// Everything that changes in time.
    pub fn snapshot(&self) -> Vec<u8> {
        let mut out = vec![0; self.snapshot_bytes()];
        // Nothing stops it.
        let _ = self.snapshot_unless(&Interruption::never(), &mut out);
        out
    }

    /// Length of a snapshot [bytes].
    pub fn snapshot_bytes(&self) -> usize {
        WORD * (HEADER + self.count() * self.words())
    }

    /// Words per environment: of the scene that needs most.
    fn words(&self) -> usize {
        self.ensemble().models().iter().map(|model| column_words(model)).max().unwrap_or(0)
    }

    /// Writes a snapshot of just that length.
    ///
    /// # Errors
    /// The call was stopped; what is written is no snapshot.
    pub fn snapshot_unless(
        &self,
        interruption: &Interruption<'_>,
        out: &mut [u8],
    ) -> Result<(), Interrupted> {
        let words = self.words();
        let (header, columns) = out.split_at_mut(WORD * HEADER);
        self.pool().fill(interruption, columns, WORD * words, |environment, column| {
            let mut bytes = Vec::with_capacity(WORD * words);
            self.write_column(environment, &mut bytes);
            bytes.resize(WORD * words, 0);
            column.copy_from_slice(&bytes);
        })?;
        let magic = number(MAGIC);
        let numbers = [magic, layout(), self.count() as u64, words as u64, 0];
        let places = header.chunks_exact_mut(WORD);
        places.zip(numbers).for_each(|(place, word)| place.copy_from_slice(&word.to_le_bytes()));
        let sum = checksum(out);
        out[WORD * CHECKSUM..][..WORD].copy_from_slice(&sum.to_le_bytes());
        Ok(())
    }

    /// Takes a snapshot over.
    ///
    /// # Errors
    /// A snapshot of another scene, size or layout, or one that is damaged; nothing is changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        self.restore_unless(&Interruption::never(), bytes).unwrap_or(Ok(()))
    }

    /// See [`restore`](Self::restore).
    ///
    /// # Errors
    /// The call was stopped; nothing is changed then.
    pub fn restore_unless(
        &mut self,
        interruption: &Interruption<'_>,
        bytes: &[u8],
    ) -> Result<Result<(), SnapshotError>, Interrupted> {
        if let Err(error) = self.check(bytes) {
            return Ok(Err(error));
        }
        let column = |environment| column_of(bytes, environment);
        self.read_columns(interruption, |environment, state| {
            state.extend_from_slice(column(environment));
        })?;
        (0..self.count())
            .for_each(|environment| self.read_settings(environment, column(environment)));
        Ok(Ok(()))
    }

    /// Whether a snapshot is one of this batch.
    fn check(&self, bytes: &[u8]) -> Result<(), SnapshotError> {
        self.check_header(bytes)?;
        (0..self.count()).try_for_each(|environment| {
            let (model, column) = (self.model_of(environment), column_of(bytes, environment));
            let another = || SnapshotError::Scene { environment, name: model.scene.name.clone() };
            let enough = column.len() >= WORD * column_words(model);
            let column = enough.then(|| Column::of(model, column));
            let column = column.filter(|column| column.fingerprint() == model.fingerprint);
            check(model, environment, &column.ok_or_else(another)?)
        })
    }

    fn check_header(&self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let malformed = SnapshotError::Malformed(bytes.len());
        if bytes.len() < WORD * HEADER || !bytes.starts_with(&MAGIC[..WORD - 1]) {
            return Err(malformed);
        }
        let [magic, layout_found, count, words, sum] =
            std::array::from_fn(|k| number(&bytes[WORD * k..]));
        if magic != number(MAGIC) || layout_found != layout() {
            return Err(SnapshotError::Layout {
                found: layout_name(&bytes[..WORD], layout_found),
                expected: layout_name(MAGIC, layout()),
            });
        }
        let length = count.checked_mul(words).and_then(|words| words.checked_add(HEADER as u64));
        if length.and_then(|words| words.checked_mul(WORD as u64)) != Some(bytes.len() as u64) {
            return Err(malformed);
        }
        if sum != checksum(bytes) {
            return Err(SnapshotError::Checksum(bytes.len()));
        }
        if count != self.count() as u64 {
            return Err(SnapshotError::Count { found: count, expected: self.count() as u64 });
        }
        Ok(())
    }

    /// Everything of one environment.
    pub(super) fn write_column(&self, environment: usize, out: &mut Vec<u8>) {
        let (parameters, magnets) = (Model::PARAMETERS.len(), self.model().magnets());
        let mut add = |word: u64| out.extend(word.to_le_bytes());
        add(self.model_of(environment).fingerprint);
        self.write_state(environment, &mut add);
        let factors = &self.factors()[environment * parameters..][..parameters];
        factors.iter().for_each(|factor| add(factor.to_bits()));
        let present = &self.present()[environment * magnets..][..magnets];
        present.iter().for_each(|&is_in| add(u64::from(is_in)));
    }

    /// Takes factors and magnets for the next reset over from a column.
    pub(super) fn read_settings(&mut self, environment: usize, column: &[u8]) {
        let (parameters, magnets) = (Model::PARAMETERS.len(), self.model().magnets());
        let model = Arc::clone(self.model_of(environment));
        let column = Column::of(&model, column);
        let factors = &mut self.factors_mut()[environment * parameters..][..parameters];
        factors.iter_mut().zip(column.next_factors()).for_each(|(factor, next)| *factor = next);
        let present = &mut self.present_mut()[environment * magnets..][..magnets];
        present.iter_mut().zip(column.next_present()).for_each(|(is_in, next)| *is_in = next == 1);
    }
}

/// Hands the state of one lane on, word by word.
pub(super) fn write_lane<R: Row>(block: &Block<R>, lane: usize, add: &mut dyn FnMut(u64)) {
    for rows in block.state_rows() {
        rows.iter().for_each(|row| add(row[lane].f64().to_bits()));
    }
    add(block.step_count[lane]);
    add(block.status[lane] as u64);
}

/// Takes the state of one lane over from a column that was checked.
pub(super) fn read_lane<R: Row>(model: &Model, block: &mut Block<R>, lane: usize, column: &[u8]) {
    let column = Column::of(model, column);
    let mut numbers = column.state();
    for rows in block.state_rows_mut() {
        for (row, number) in rows.iter_mut().zip(&mut numbers) {
            row[lane] = R::Number::of(number);
        }
    }
    block.step_count[lane] = column.step_count();
    block.status[lane] = column.status().unwrap_or_default();
    apply_parameters(model, block, lane);
}

/// A sum over what is declared of the rows of the state, and over the parameters that have factors.
fn layout() -> u64 {
    let state = ROWS.iter().filter(|group| group.role == Role::State);
    let rows = state.fold(Sum::EMPTY, |sum, group| sum.text(group.name).text(group.unit));
    Model::PARAMETERS.iter().fold(rows, |sum, parameter| sum.text(parameter.name())).value()
}

/// Name of a layout for a message. The first one had no sum.
fn layout_name(magic: &[u8], layout: u64) -> String {
    let name = String::from_utf8_lossy(magic).escape_default().to_string();
    if magic == b"MAGWORM1" { name } else { format!("{name}-{layout:016x}") }
}

/// The column of an environment in a snapshot whose header fits.
fn column_of(bytes: &[u8], environment: usize) -> &[u8] {
    let (header, columns) = bytes.split_at(WORD * HEADER);
    let size = columns.len() / (number(&header[2 * WORD..]) as usize).max(1);
    &columns[size * environment..][..size]
}

/// A sum over all words but its own.
fn checksum(bytes: &[u8]) -> u64 {
    let words = bytes.chunks_exact(WORD).enumerate();
    let others = words.filter(|(place, _)| *place != CHECKSUM);
    others.fold(Sum::EMPTY, |sum, (_, word)| sum.word(number(word))).value()
}
