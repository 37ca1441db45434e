//! Saving and restoring a batch, bit for bit.
//!
//! A snapshot is a header (magic, version, environments, bytes per environment, fingerprint of the
//! scene) and one column per environment, so it does not depend on how environments were laid out in
//! lanes. Numbers are little-endian `f64`, which hold those of a scene in single precision too.

use super::Batch;
use crate::interruption::{Interrupted, Interruption};
use crate::lanes::{Number, Row};
use crate::model::Model;
use crate::reset::apply_parameters;
use crate::state::{Block, Status};
use std::sync::Arc;

const MAGIC: &[u8; 8] = b"MAGWORM1";
const HEADER: usize = 8 + 3 * 8;

/// A snapshot that does not fit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// Not a snapshot, or cut short.
    #[error("state is not a MagWorm snapshot, or it was cut short ({0} bytes)")]
    Malformed(usize),
    /// Of another number of environments.
    #[error("state holds {found} environments; this batch has {expected}")]
    Count {
        /// In the snapshot.
        found: u64,
        /// In the batch.
        expected: u64,
    },
    /// Of another scene.
    #[error("state was saved from another scene; compare the scenes' TOML")]
    Scene,
    /// A status code that none has.
    #[error("state holds the unknown status code {0}")]
    StatusCode(u8),
}

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
        HEADER + self.count() * self.column_bytes()
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
        let size = self.column_bytes();
        let (header, columns) = out.split_at_mut(HEADER);
        let numbers = [self.count() as u64, size as u64, fingerprint(self.model())];
        header[..8].copy_from_slice(MAGIC);
        let places = header[8..].chunks_exact_mut(8);
        places
            .zip(numbers)
            .for_each(|(place, number)| place.copy_from_slice(&number.to_le_bytes()));
        self.pool().fill(interruption, columns, size, |environment, column| {
            let mut bytes = Vec::with_capacity(size);
            self.write_column(environment, &mut bytes);
            self.write_settings(environment, &mut bytes);
            column.copy_from_slice(&bytes);
        })
    }

    /// Takes a snapshot over.
    ///
    /// # Errors
    /// A snapshot of another scene or size, or one that is damaged; nothing is changed then.
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
        let (size, settings) = (self.column_bytes(), self.settings_bytes());
        let column = |environment: usize| {
            bytes[HEADER + size * environment..][..size].split_at(size - settings)
        };
        self.read_columns(interruption, |environment, state| {
            state.extend_from_slice(column(environment).0);
        })?;
        (0..self.count()).for_each(|k| self.read_settings(k, column(k).1));
        Ok(Ok(()))
    }

    /// Whether a snapshot is one of this batch.
    fn check(&self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let size = self.column_bytes();
        let malformed = SnapshotError::Malformed(bytes.len());
        if bytes.len() < HEADER || &bytes[..8] != MAGIC {
            return Err(malformed);
        }
        let found = number(&bytes[8..]);
        if found != self.count() as u64 {
            return Err(SnapshotError::Count { found, expected: self.count() as u64 });
        }
        if number(&bytes[24..]) != fingerprint(self.model()) || number(&bytes[16..]) != size as u64
        {
            return Err(SnapshotError::Scene);
        }
        if bytes.len() != HEADER + self.count() * size {
            return Err(malformed);
        }
        let columns = &bytes[HEADER..];
        let settings = self.settings_bytes();
        for column in columns.chunks(size) {
            let code = column[size - settings - 1];
            Status::from_code(code).ok_or(SnapshotError::StatusCode(code))?;
        }
        Ok(())
    }

    /// A batch of its own, as this one in lanes and threads, whose environment k is a copy of `environments[k]`: its
    /// state and its settings for the next reset, bit for bit.
    pub fn copies(&self, environments: &[usize]) -> Self {
        let copied = self.copies_unless(&Interruption::never(), environments);
        copied.expect("nothing stops it")
    }

    /// See [`copies`](Self::copies).
    ///
    /// # Errors
    /// The call was stopped.
    pub fn copies_unless(
        &self,
        interruption: &Interruption<'_>,
        environments: &[usize],
    ) -> Result<Self, Interrupted> {
        let (model, count) = (Arc::clone(self.model()), environments.len());
        let (lanes, threads) = (self.lanes(), Some(self.threads()));
        let mut batch = Self::new_unless(interruption, model, count, lanes, threads)?;
        batch.read_columns(interruption, |copy, state| {
            self.write_column(environments[copy], state);
        })?;
        let mut settings = Vec::new();
        for (copy, &environment) in environments.iter().enumerate() {
            settings.clear();
            self.write_settings(environment, &mut settings);
            batch.read_settings(copy, &settings);
        }
        Ok(batch)
    }

    fn column_bytes(&self) -> usize {
        let mut column = Vec::new();
        if self.count() > 0 {
            self.write_column(0, &mut column);
        }
        column.len() + self.settings_bytes()
    }

    fn settings_bytes(&self) -> usize {
        8 * Model::PARAMETERS.len() + self.model().magnets()
    }

    /// Factors and magnets for the next reset.
    fn write_settings(&self, environment: usize, out: &mut Vec<u8>) {
        let (parameters, magnets) = (Model::PARAMETERS.len(), self.model().magnets());
        let factors = &self.factors()[environment * parameters..][..parameters];
        factors.iter().for_each(|factor| out.extend(factor.to_bits().to_le_bytes()));
        out.extend(self.present()[environment * magnets..][..magnets].iter().map(|&p| u8::from(p)));
    }

    fn read_settings(&mut self, environment: usize, bytes: &[u8]) {
        let (parameters, magnets) = (Model::PARAMETERS.len(), self.model().magnets());
        let (factors, present) = bytes.split_at(8 * parameters);
        for (factor, bits) in
            self.factors_mut()[environment * parameters..].iter_mut().zip(factors.chunks(8))
        {
            *factor = f64::from_bits(number(bits));
        }
        for (is_in, &byte) in self.present_mut()[environment * magnets..].iter_mut().zip(present) {
            *is_in = byte == 1;
        }
    }
}

pub(super) fn write_lane<R: Row>(block: &Block<R>, lane: usize, out: &mut Vec<u8>) {
    for rows in block.state_rows() {
        rows.iter().for_each(|row| out.extend(row[lane].f64().to_bits().to_le_bytes()));
    }
    out.push(block.status[lane] as u8);
}

pub(super) fn read_lane<R: Row>(model: &Model, block: &mut Block<R>, lane: usize, column: &[u8]) {
    let mut numbers = column.chunks_exact(8).map(|bits| f64::from_bits(number(bits)));
    for rows in block.state_rows_mut() {
        for row in rows.iter_mut() {
            row[lane] = R::Number::of(numbers.next().unwrap_or(0.0));
        }
    }
    let code = column[column.len() - 1];
    block.status[lane] = Status::from_code(code).unwrap_or(Status::Unused);
    apply_parameters(model, block, lane);
}

fn number(bytes: &[u8]) -> u64 {
    let mut eight = [0; 8];
    eight.copy_from_slice(&bytes[..8]);
    u64::from_le_bytes(eight)
}

/// FNV-1a (Fowler, Noll & Vo) of the scene's TOML.
fn fingerprint(model: &Model) -> u64 {
    model.scene.to_toml().bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
