//! Scenes that come with the crate.

use super::Scene;
use super::error::{Problem, SceneError};

/// Name and text of each preset.
const TEXTS: [(&str, &str); 9] = [
    ("paper-3", include_str!("../../scenes/paper-3.toml")),
    ("paper-3-simulation", include_str!("../../scenes/paper-3-simulation.toml")),
    ("paper-4", include_str!("../../scenes/paper-4.toml")),
    ("paper-5", include_str!("../../scenes/paper-5.toml")),
    ("turn-3", include_str!("../../scenes/turn-3.toml")),
    ("turn-3-pair", include_str!("../../scenes/turn-3-pair.toml")),
    ("cantilever", include_str!("../../scenes/cantilever.toml")),
    ("belt-125", include_str!("../../scenes/belt-125.toml")),
    ("incline-block", include_str!("../../scenes/incline-block.toml")),
];

/// Names that [`Scene::preset`] knows.
pub const PRESETS: &[&str] = &{
    let mut names = [""; TEXTS.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = TEXTS[k].0;
        k += 1;
    }
    names
};

impl Scene {
    /// One of [`PRESETS`].
    ///
    /// # Errors
    /// A name that is not among them.
    pub fn preset(name: &str) -> Result<Self, SceneError> {
        let text = Self::preset_text(name)?;
        Self::from_toml(text)
    }

    /// The commented TOML text of one of [`PRESETS`]: a start for scenes of one's own.
    ///
    /// # Errors
    /// A name that is not among them.
    pub fn preset_text(name: &str) -> Result<&'static str, SceneError> {
        let text = TEXTS.iter().find(|(known, _)| *known == name).map(|(_, text)| *text);
        text.ok_or_else(|| Problem::Preset { name: name.into(), known: PRESETS.join(", ") }.into())
    }
}
