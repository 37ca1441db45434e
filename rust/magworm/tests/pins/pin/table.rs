//! The committed hashes.

use super::folder;
use super::hash::Hash;
use std::collections::BTreeMap;
use std::sync::Mutex;

const HEAD: &str =
    "# Hash of each pin. Written by `MAGWORM_WRITE_PINS=1 cargo test --test pins`.\n";

/// Tests run side by side and share one file.
static FILE: Mutex<()> = Mutex::new(());

/// Asserts that the hash of a pin is the committed one, or commits it where the environment asks for that.
#[track_caller]
pub fn check(pin: &str, hash: Hash) {
    let (path, hash) = (folder().join("hashes.toml"), hash.to_string());
    let guard = FILE.lock().unwrap();
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    let mut table: BTreeMap<String, String> = toml::from_str(&text).expect("a table of hashes");
    if std::env::var_os("MAGWORM_WRITE_PINS").is_some() {
        table.insert(pin.into(), hash);
        let text = HEAD.to_string() + &toml::to_string(&table).expect("a table");
        std::fs::write(path, text).expect("a file to write");
        return;
    }
    drop(guard);
    let old = table.get(pin).map_or("none", String::as_str);
    assert_eq!(hash, old, "{pin}: here the hash of the trajectory, there the committed one");
}
