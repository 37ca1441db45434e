//! FNV-1a, 64 bits (Fowler, Noll & Vo 1991), over numbers as little-endian `f64`.

use std::fmt;

/// The hash of the numbers so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hash(u64);

impl Hash {
    /// The hash of nothing.
    pub const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    /// Adds numbers.
    pub fn add(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.add_bytes(&value.to_le_bytes()));
    }

    fn add_bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

impl fmt::Display for Hash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[test]
fn hashes_are_the_published_ones() {
    let mut hash = Hash::EMPTY;
    hash.add_bytes(b"foobar");
    assert_eq!(hash.to_string(), "85944171f73967e8");
}
