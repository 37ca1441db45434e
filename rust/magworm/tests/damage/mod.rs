//! What becomes of bytes on a bad disk: flips, cuts and splices, each a function of its number.

use magworm::internals::Draws;

/// Words of a snapshot's header; the last is its checksum.
pub const HEADER: usize = 5;

/// One kind of damage after another.
pub struct Damage {
    draws: Draws,
}

impl Damage {
    /// The damage of this number.
    pub fn new(number: u64) -> Self {
        Self { draws: Draws::new(number, 15) }
    }

    /// A damaged copy; splices take from `other`.
    pub fn applied(mut self, bytes: &[u8], other: &[u8]) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        match self.below(8) {
            0 => bytes.truncate(self.below(bytes.len())),
            1 => self.splice(&mut bytes, other),
            2 => self.overwrite(&mut bytes, other),
            _ => (0..=self.below(3)).for_each(|_| self.flip(&mut bytes)),
        }
        bytes
    }

    fn below(&mut self, count: usize) -> usize {
        self.draws.uniform(0.0, count as f64) as usize
    }

    fn flip(&mut self, bytes: &mut [u8]) {
        let bit = self.below(8 * bytes.len());
        bytes[bit / 8] ^= 1 << (bit % 8);
    }

    /// Puts some words of the other in place of as many or fewer of these.
    fn splice(&mut self, bytes: &mut Vec<u8>, other: &[u8]) {
        let (start, from) = (8 * self.below(bytes.len() / 8), 8 * self.below(other.len() / 8));
        let [removed, added] = [0; 2].map(|_| 8 * self.below(6));
        let end = (start + removed).min(bytes.len());
        bytes.splice(start..end, other[from..].iter().copied().take(added));
    }

    /// Writes some words of the other over these, somewhere else.
    fn overwrite(&mut self, bytes: &mut [u8], other: &[u8]) {
        let (start, from) = (8 * self.below(bytes.len() / 8), 8 * self.below(other.len() / 8));
        let count = (8 * (1 + self.below(6))).min(bytes.len() - start).min(other.len() - from);
        bytes[start..start + count].copy_from_slice(&other[from..from + count]);
    }
}

/// Makes the checksum of damaged bytes fit: FNV-1a over words, each mixed down.
pub fn renew_checksum(bytes: &mut [u8]) {
    let (words, _) = bytes.as_chunks_mut::<8>();
    if words.len() < HEADER {
        return;
    }
    let mut sum: u64 = 0xcbf2_9ce4_8422_2325;
    for (_, word) in words.iter().enumerate().filter(|(place, _)| *place != HEADER - 1) {
        let mixed = (sum ^ u64::from_le_bytes(*word)).wrapping_mul(0x0100_0000_01b3);
        sum = mixed ^ (mixed >> 32);
    }
    words[HEADER - 1] = sum.to_le_bytes();
}
