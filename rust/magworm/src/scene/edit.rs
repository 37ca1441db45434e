//! Copies of a scene with some fields replaced.

use toml::{Table, Value};

use super::Scene;
use super::accuracy;
use super::check::{Place, TAG};
use super::error::{Problem, SceneError};
use super::lines::split_index;
use super::schema::{Kind, Presence};

impl Scene {
    /// A copy with fields replaced, one after another, by dotted path: `ground.static_friction`, or
    /// `body.segment[2].thickness_m` in a list, counted from 0.
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

/// Replaces the field at a path within a table.
fn replace(
    values: &mut Table,
    place: &Place,
    path: &str,
    value: Option<&Value>,
) -> Result<(), Problem> {
    let (part, rest) = path.split_once('.').map_or((path, None), |(part, rest)| (part, Some(rest)));
    let (name, index) = split_index(part);
    let field = place.field(name).ok_or_else(|| place.unknown(part))?;
    let here = place.path_of(name);
    match (index, &field.kind, rest, value) {
        (Some(index), Kind::List { of, .. }, ..) => {
            let entry = entry(values.get_mut(name), &here, index)?;
            replace_entry(entry, format!("{here}[{index}]"), of, rest, value)
        }
        (Some(_), ..) => Err(place.unknown(part)),
        (None, kind, Some(rest), _) => {
            let inner = values.entry(name).or_insert_with(|| Value::Table(Table::new()));
            replace_within(inner, here, kind, rest, value)
        }
        (None, _, None, Some(value)) => {
            values.insert(name.into(), value.clone());
            Ok(())
        }
        (None, _, None, None) if field.presence == Presence::Required => {
            Err(Problem::Needed { field: here, table: place.title() })
        }
        (None, _, None, None) => {
            values.remove(name);
            Ok(())
        }
    }
}

/// An entry of a list, which must be there.
fn entry<'a>(
    list: Option<&'a mut Value>,
    path: &str,
    index: usize,
) -> Result<&'a mut Value, Problem> {
    let list = list.and_then(Value::as_array_mut);
    let count = list.as_ref().map_or(0, |list| list.len());
    let entry = list.and_then(|list| list.get_mut(index));
    entry.ok_or_else(|| Problem::Value {
        field: path.into(),
        value: format!("a list of {count}"),
        allowed: format!("{} entries or more where [{index}] is replaced", index + 1),
    })
}

/// Replaces an entry of a list or goes on inside it.
fn replace_entry(
    entry: &mut Value,
    path: String,
    kind: &Kind,
    rest: Option<&str>,
    value: Option<&Value>,
) -> Result<(), Problem> {
    match (rest, value) {
        (Some(rest), _) => replace_within(entry, path, kind, rest, value),
        (None, Some(value)) => {
            *entry = value.clone();
            Ok(())
        }
        (None, None) => {
            let table = path.rsplit_once('[').map_or("", |(list, _)| list).into();
            Err(Problem::Needed { field: path, table })
        }
    }
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
