//! Saving and restoring a batch, bit for bit.
//!
//! A snapshot is a header (magic, version, environments, bytes per environment, fingerprint of the
//! scene) and one column per environment, so it does not depend on how environments were laid out in
//! lanes. Numbers are little-endian `f64`, which hold those of a scene in single precision too.

use super::Batch;
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
        let size = self.column_bytes();
        let mut out = Vec::with_capacity(HEADER + self.count() * size);
        out.extend_from_slice(MAGIC);
        out.extend((self.count() as u64).to_le_bytes());
        out.extend((size as u64).to_le_bytes());
        out.extend(fingerprint(self.model()).to_le_bytes());
        for environment in 0..self.count() {
            self.write_column(environment, &mut out);
            self.write_settings(environment, &mut out);
        }
        out
    }

    /// Takes a snapshot over.
    ///
    /// # Errors
    /// A snapshot of another scene or size, or one that is damaged; nothing is changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
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
        for (environment, column) in columns.chunks(size).enumerate() {
            self.read_settings(environment, &column[size - settings..]);
            self.read_column(environment, &column[..size - settings]);
        }
        Ok(())
    }

    /// A batch of its own, as this one in lanes and threads, whose environment k is a copy of `environments[k]`: its
    /// state and its settings for the next reset, bit for bit.
    pub fn copies(&self, environments: &[usize]) -> Self {
        let model = Arc::clone(self.model());
        let mut batch = Self::new(model, environments.len(), self.lanes(), Some(self.threads()));
        let mut bytes = Vec::new();
        for (copy, &environment) in environments.iter().enumerate() {
            bytes.clear();
            self.write_column(environment, &mut bytes);
            let state = bytes.len();
            self.write_settings(environment, &mut bytes);
            batch.read_column(copy, &bytes[..state]);
            batch.read_settings(copy, &bytes[state..]);
        }
        batch
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
