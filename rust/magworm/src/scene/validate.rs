//! Validation of a scene that was built or changed in code.

use toml::Table;

use super::check::{Place, check_table};
use super::error::{Problem, SceneError};
use super::{Scene, rules};

impl Scene {
    /// Checks every field once, so that compiling and stepping cannot fail.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn validate(&self) -> Result<(), SceneError> {
        check_table(&self.to_table()?, &Place::root())?;
        Ok(rules::check(self)?)
    }

    /// The scene as TOML values.
    pub(super) fn to_table(&self) -> Result<Table, Problem> {
        Table::try_from(self).map_err(|error| Problem::Value {
            field: "a count".into(),
            value: error.to_string(),
            allowed: format!("a whole number up to {}", i64::MAX),
        })
    }
}
