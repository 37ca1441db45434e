//! Why a scene cannot be simulated, in one sentence.

use thiserror::Error;

/// A scene that cannot be simulated: what is wrong, and on which line where it was read from text.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}{problem}", place(*line))]
pub struct SceneError {
    /// Line of the TOML text, counted from 1; none for a scene that was not read from text.
    pub line: Option<usize>,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with a scene.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Problem {
    /// A value of the wrong type, outside its range, or at odds with another field.
    #[error("{field} is {value}; allowed: {allowed}")]
    Value {
        /// Dotted path of the field.
        field: String,
        /// What stands there, with its unit.
        value: String,
        /// What may stand there, with its unit.
        allowed: String,
    },
    /// A field without a default is absent.
    #[error("{field} is missing; allowed: {allowed}")]
    Missing {
        /// Dotted path of the field.
        field: String,
        /// What may stand there, with its unit.
        allowed: String,
    },
    /// A field that no scene has at this place.
    #[error("{field} is not a field of a scene; {table} has: {known}")]
    Unknown {
        /// Dotted path of the field.
        field: String,
        /// Dotted path of the table that holds it.
        table: String,
        /// Names of the fields of that table.
        known: String,
    },
    /// A path that cannot be taken out of the scene.
    #[error("{field} cannot be removed; it is needed by {table}")]
    Needed {
        /// Dotted path of the field.
        field: String,
        /// Dotted path of the table that holds it.
        table: String,
    },
    /// Text that is not TOML.
    #[error("not valid TOML: {0}")]
    Syntax(String),
    /// An ensemble that does not exist.
    #[error("there is no ensemble \"{name}\"; ensembles: {known}")]
    Ensemble {
        /// The name asked for.
        name: String,
        /// Names of the ensembles.
        known: String,
    },
    /// A preset that does not exist.
    #[error("there is no preset \"{name}\"; presets: {known}")]
    Preset {
        /// The name asked for.
        name: String,
        /// Names of the presets.
        known: String,
    },
}

impl Problem {
    /// Dotted path of the field at fault.
    pub fn field(&self) -> Option<&str> {
        match self {
            Self::Value { field, .. }
            | Self::Missing { field, .. }
            | Self::Unknown { field, .. }
            | Self::Needed { field, .. } => Some(field),
            Self::Syntax(_) | Self::Ensemble { .. } | Self::Preset { .. } => None,
        }
    }
}

impl From<Problem> for SceneError {
    fn from(problem: Problem) -> Self {
        Self { line: None, problem }
    }
}

fn place(line: Option<usize>) -> String {
    line.map(|line| format!("line {line}: ")).unwrap_or_default()
}
