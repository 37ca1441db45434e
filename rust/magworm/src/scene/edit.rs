//! Copies of a scene with some fields replaced.

use toml::{Table, Value};

use super::Scene;
use super::accuracy;
use super::check::{Place, TAG};
use super::error::{Problem, SceneError};
use super::schema::{Kind, Presence};

impl Scene {
    /// A copy with fields replaced, one after another, by dotted path: `ground.static_friction`.
    ///
    /// A table or list replaces the whole one. `None` takes the field out: an optional table is then
    /// left out of the simulation, a field with a default returns to it. A path into an absent
    /// table begins that table. `solver.accuracy` writes the values that it stands for.
    ///
    /// # Errors
    /// A path that no scene has, with the fields that are known there; or a scene that does not
    /// validate once all is replaced.
    pub fn with_values(&self, values: &[(String, Option<Value>)]) -> Result<Self, SceneError> {
        let mut table = self.to_table()?;
        for (path, value) in values {
            if let ("solver.accuracy", Some(word)) = (path.as_str(), value) {
                accuracy::choose(&mut table, word)?;
                continue;
            }
            replace(&mut table, &Place::root(), path, value.as_ref())?;
        }
        Ok(Self::from_table(table)?)
    }
}

fn replace(
    values: &mut Table,
    place: &Place,
    path: &str,
    value: Option<&Value>,
) -> Result<(), Problem> {
    let (name, rest) = path.split_once('.').map_or((path, None), |(name, rest)| (name, Some(rest)));
    let field = place.field(name).ok_or_else(|| place.unknown(name))?;
    let Some(rest) = rest else {
        return match value {
            None if field.presence == Presence::Required => {
                Err(Problem::Needed { field: place.path_of(name), table: place.title() })
            }
            None => {
                values.remove(name);
                Ok(())
            }
            Some(value) => {
                values.insert(name.into(), value.clone());
                Ok(())
            }
        };
    };
    let inner = values.entry(name).or_insert_with(|| Value::Table(Table::new()));
    replace_within(inner, place.path_of(name), &field.kind, rest, value)
}

/// Goes on inside the value at `path`.
fn replace_within(
    inner: &mut Value,
    path: String,
    kind: &Kind,
    rest: &str,
    value: Option<&Value>,
) -> Result<(), Problem> {
    let no_fields = &mut Table::new();
    let inner = inner.as_table_mut().unwrap_or(no_fields);
    // The kind of a table that is just begun cannot be looked up before it is written.
    if let (Kind::Variants(_), TAG, Some(value)) = (kind, rest, value) {
        inner.insert(TAG.into(), value.clone());
        return Ok(());
    }
    let place = Place::within(path, inner, kind)?;
    replace(inner, &place, rest, value)
}
