//! Fingerprint of a scene: which states are its own.

use crate::scene::Scene;
use toml::Value;

/// FNV-1a (Fowler, Noll & Vo) over words of eight bytes: another word anywhere gives another sum.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sum(u64);

impl Sum {
    /// The sum of nothing.
    pub(crate) const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    /// Adds a word.
    #[must_use]
    pub(crate) const fn word(self, word: u64) -> Self {
        let mixed = (self.0 ^ word).wrapping_mul(0x0100_0000_01b3);
        Self(mixed ^ (mixed >> 32))
    }

    /// Adds a text.
    #[must_use]
    pub(crate) const fn text(mut self, text: &str) -> Self {
        let bytes = text.as_bytes();
        let mut k = 0;
        while k < bytes.len() {
            self = self.word(bytes[k] as u64);
            k += 1;
        }
        self.word(bytes.len() as u64)
    }

    /// The sum.
    pub(crate) const fn value(self) -> u64 {
        self.0
    }
}

/// The fingerprint of what a scene simulates: of all its values but its name, where −0 counts as 0.
pub(super) fn fingerprint(scene: &Scene) -> u64 {
    let mut value = Value::try_from(scene).expect("a scene is made of TOML's own types");
    value.as_table_mut().and_then(|table| table.remove("name"));
    add(Sum::EMPTY, &value).value()
}

fn add(sum: Sum, value: &Value) -> Sum {
    match value {
        // Adding 0 makes −0 positive.
        Value::Float(number) => sum.text("number").word((number + 0.0).to_bits()),
        Value::Array(values) => values.iter().fold(sum.text("list"), add).text("end"),
        Value::Table(table) => table
            .iter()
            .fold(sum.text("table"), |sum, (key, value)| add(sum.text(key), value))
            .text("end"),
        other => sum.text(&other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn preset() -> Scene {
        Scene::preset("paper-3").expect("a preset")
    }

    #[test]
    fn a_name_and_the_sign_of_zero_are_no_part_of_it() {
        let (mut named, mut signed) = (preset(), preset());
        named.name = "another".into();
        signed.start.x_m = -0.0;
        assert_eq!(fingerprint(&named), fingerprint(&preset()));
        assert_eq!(fingerprint(&signed), fingerprint(&preset()));
    }

    #[test]
    fn every_other_value_is() {
        let (mut heavier, mut fewer) = (preset(), preset());
        heavier.gravity_m_s2 = 9.810_000_000_000_002;
        fewer.ground = None;
        assert_ne!(fingerprint(&heavier), fingerprint(&preset()));
        assert_ne!(fingerprint(&fewer), fingerprint(&preset()));
    }
}
