//! Scenes from and to TOML.

use serde::Deserialize;
use toml::{Table, Value};

use super::check::{Place, check_table};
use super::error::{Problem, SceneError};
use super::lines;
use super::{Scene, accuracy, rules};

impl Scene {
    /// Reads and validates a scene.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn from_toml(text: &str) -> Result<Self, SceneError> {
        let table = text.parse::<Table>().map_err(|error| lines::syntax_error(text, &error))?;
        Self::from_table(table).map_err(|problem| lines::located(text, problem))
    }

    /// Writes the scene so that [`Scene::from_toml`] reads back an equal one.
    ///
    /// A scene that was never validated may hold a count too great for TOML; then the text is one
    /// comment that says so.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).unwrap_or_else(|error| format!("# not a scene: {error}\n"))
    }

    /// Checks the grammar first: after that serde has nothing left to refuse.
    pub(super) fn from_table(mut table: Table) -> Result<Self, Problem> {
        table.iter_mut().for_each(|(_, value)| unsign_zeros(value));
        accuracy::expand(&mut table)?;
        check_table(&table, &Place::root())?;
        let scene = Self::deserialize(table)
            .map_err(|error| Problem::Syntax(error.message().replace('\n', "; ")))?;
        rules::check(&scene)?;
        Ok(scene)
    }
}

/// Zeros lose their sign: scenes that are equal then have equal texts.
fn unsign_zeros(value: &mut Value) {
    match value {
        Value::Float(number) if *number == 0.0 => *number = 0.0,
        Value::Array(items) => items.iter_mut().for_each(unsign_zeros),
        Value::Table(fields) => fields.iter_mut().for_each(|(_, value)| unsign_zeros(value)),
        _ => {}
    }
}
