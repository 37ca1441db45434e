//! Holds TOML values against the grammar of a scene.

use toml::Value;

use super::error::Problem;
use super::fields::SCENE;
use super::schema::{Field, Kind, Presence, Table, Variant, quantity, required, variant_names};

/// The field that tells the variants of a table apart.
pub(super) const TAG: &str = "kind";
static TAG_FIELD: Field = required(TAG, Kind::Text);
static NOTHING: Table = Table { fields: &[] };

/// Longest text that a message repeats.
const LONGEST_QUOTE: usize = 60;

/// A table of the grammar, and where it stands in the scene.
pub(super) struct Place {
    path: String,
    table: &'static Table,
    /// Whether the table also has a `kind`.
    tagged: bool,
}

impl Place {
    /// The outermost table.
    pub fn root() -> Self {
        Self { path: String::new(), table: &SCENE, tagged: false }
    }

    /// The place of a field that holds `values`. What holds no fields is an empty place.
    pub fn within(path: String, values: &toml::Table, kind: &Kind) -> Result<Self, Problem> {
        let (table, tagged) = match kind {
            Kind::Table(table) => (*table, false),
            Kind::Variants(variants) => (variant(&path, values, variants)?, true),
            _ => (&NOTHING, false),
        };
        Ok(Self { path, table, tagged })
    }

    /// The field of a name.
    pub fn field(&self, name: &str) -> Option<&'static Field> {
        if self.tagged && name == TAG { Some(&TAG_FIELD) } else { self.table.field(name) }
    }

    /// Full path of a field.
    pub fn path_of(&self, name: &str) -> String {
        if self.path.is_empty() { name.into() } else { format!("{}.{name}", self.path) }
    }

    /// How a message names the place.
    pub fn title(&self) -> String {
        if self.path.is_empty() { "the scene".into() } else { self.path.clone() }
    }

    /// The problem of a name that this place does not know.
    pub fn unknown(&self, name: &str) -> Problem {
        let tag = self.tagged.then_some(TAG);
        let names = self.table.fields.iter().map(|field| field.name);
        let known: Vec<&str> = tag.into_iter().chain(names).collect();
        let known = if known.is_empty() { "no fields".into() } else { known.join(", ") };
        Problem::Unknown { field: shorten(&self.path_of(name)), table: self.title(), known }
    }
}

/// Checks the names, types and ranges of a table and of all within it.
pub(super) fn check_table(values: &toml::Table, place: &Place) -> Result<(), Problem> {
    if let Some(name) = values.keys().find(|name| place.field(name).is_none()) {
        return Err(place.unknown(name));
    }
    place.table.fields.iter().try_for_each(|field| {
        let path = place.path_of(field.name);
        match values.get(field.name) {
            Some(value) => check_value(path, value, &field.kind),
            None if field.presence == Presence::Optional => Ok(()),
            None => Err(Problem::Missing { field: path, allowed: field.kind.allowed() }),
        }
    })
}

fn check_value(path: String, value: &Value, kind: &Kind) -> Result<(), Problem> {
    match (kind, value) {
        (Kind::Table(_) | Kind::Variants(_), Value::Table(values)) => {
            check_table(values, &Place::within(path, values, kind)?)
        }
        (Kind::List { of, most }, Value::Array(values)) if values.len() <= *most => values
            .iter()
            .enumerate()
            .try_for_each(|(index, value)| check_value(format!("{path}[{index}]"), value, of)),
        _ if fits(value, kind) => Ok(()),
        _ => {
            let value = describe(value, kind);
            Err(Problem::Value { field: path, value, allowed: kind.allowed() })
        }
    }
}

/// Whether a single value has the type of `kind` and lies in its range.
fn fits(value: &Value, kind: &Kind) -> bool {
    match (kind, value) {
        (Kind::Number { low, high, .. }, Value::Float(number)) => (*low..=*high).contains(number),
        (Kind::Number { low, high, .. }, Value::Integer(number)) => {
            (*low..=*high).contains(&(*number as f64))
        }
        (Kind::Whole { low, high }, Value::Integer(number)) => (*low..=*high).contains(number),
        (Kind::Polarity, Value::Integer(number)) => [1, -1].contains(number),
        (Kind::Choice(names), Value::String(name)) => names.contains(&name.as_str()),
        (Kind::Flag, Value::Boolean(_)) | (Kind::Text, Value::String(_)) => true,
        _ => false,
    }
}

/// The fields that go with the `kind` written in a table.
fn variant(
    path: &str,
    values: &toml::Table,
    variants: &'static [Variant],
) -> Result<&'static Table, Problem> {
    let (field, allowed) = (format!("{path}.{TAG}"), variant_names(variants));
    let Some(tag) = values.get(TAG) else {
        return Err(Problem::Missing { field, allowed });
    };
    tag.as_str()
        .and_then(|name| variants.iter().find(|variant| variant.name == name))
        .map(|variant| variant.table)
        .ok_or_else(|| Problem::Value { field, value: describe(tag, &Kind::Text), allowed })
}

/// A value as a message shows it.
fn describe(value: &Value, kind: &Kind) -> String {
    let unit = if let Kind::Number { unit, .. } = kind { unit } else { "" };
    match value {
        Value::Float(number) => quantity(*number, unit),
        Value::Integer(number) if unit.is_empty() => number.to_string(),
        Value::Integer(number) => quantity(*number as f64, unit),
        Value::Boolean(flag) => flag.to_string(),
        Value::String(text) => format!("\"{}\"", shorten(text)),
        Value::Datetime(date) => format!("the date {date}"),
        Value::Array(list) => format!("a list of {}", list.len()),
        Value::Table(_) => "a table".into(),
    }
}

/// A text on one line, cut where it would drown the message.
fn shorten(text: &str) -> String {
    let line: String = text.escape_debug().take(LONGEST_QUOTE + 1).collect();
    match line.char_indices().nth(LONGEST_QUOTE) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}
