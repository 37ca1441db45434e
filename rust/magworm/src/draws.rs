//! Random numbers that depend on seed and episode alone.

/// Numbers that depend on (seed, episode, place in the sequence) alone: SplitMix64 (Steele, Lea &
/// Flood 2014) as a counter-based generator. Equal for any batch size, order and thread count.
#[derive(Clone, Copy, Debug)]
pub struct Draws {
    key: u64,
    count: u64,
}

impl Draws {
    /// The sequence of one episode of one environment.
    pub fn new(seed: u64, episode: u64) -> Self {
        Self { key: mix(mix(seed) ^ episode.wrapping_mul(0xd134_2543_de82_ef95)), count: 0 }
    }

    /// The next number, uniform in [low, high).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.count += 1;
        let bits = mix(self.key.wrapping_add(self.count.wrapping_mul(0x9e37_79b9_7f4a_7c15)));
        low + (high - low) * (bits >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
