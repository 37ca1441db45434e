//! The grammar of a scene: which fields a table has, their types, units and ranges.
//!
//! serde alone loses the field path and the line inside tagged enums, and accepts unknown fields in
//! some of them. So a scene is first held against this grammar, which also is the one place where
//! ranges and units are written down.

/// A table of named fields.
pub(super) struct Table {
    pub fields: &'static [Field],
}

/// One field of a table.
pub(super) struct Field {
    pub name: &'static str,
    pub kind: Kind,
    pub presence: Presence,
}

/// Whether a field must be written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Presence {
    /// It must.
    Required,
    /// It has a default, or is left out of the simulation.
    Optional,
}

/// What may stand in a field.
pub(super) enum Kind {
    /// A finite number in a closed interval.
    Number { unit: &'static str, low: f64, high: f64 },
    /// A whole number in a closed interval.
    Whole { low: i64, high: i64 },
    /// 1 or −1.
    Polarity,
    /// true or false.
    Flag,
    /// Any text.
    Text,
    /// One of some names.
    Choice(&'static [&'static str]),
    /// A list of one kind, no longer than `most`.
    List { of: &'static Kind, most: usize },
    /// A table.
    Table(&'static Table),
    /// A table whose field `kind` says which fields the rest has.
    Variants(&'static [Variant]),
}

/// One value of `kind`, and the fields that go with it.
pub(super) struct Variant {
    pub name: &'static str,
    pub table: &'static Table,
}

impl Table {
    /// The field of a name.
    pub fn field(&self, name: &str) -> Option<&'static Field> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// Names of all fields, for a message.
    pub fn names(&self) -> String {
        self.fields.iter().map(|field| field.name).collect::<Vec<_>>().join(", ")
    }
}

/// Names of all variants, for a message.
pub(super) fn variant_names(variants: &[Variant]) -> String {
    variants.iter().map(|variant| variant.name).collect::<Vec<_>>().join(", ")
}

impl Kind {
    /// What may stand here, for a message.
    pub fn allowed(&self) -> String {
        match self {
            Self::Number { unit, low, high } => {
                format!("{} to {}", number(*low), quantity(*high, unit))
            }
            Self::Whole { low, high } => format!("a whole number from {low} to {high}"),
            Self::Polarity => "1 or -1".into(),
            Self::Flag => "true or false".into(),
            Self::Text => "a text".into(),
            Self::Choice(names) => names.join(", "),
            Self::List { of, most } => format!("a list of at most {most}, each {}", of.allowed()),
            Self::Table(table) => format!("a table with {}", table.names()),
            Self::Variants(variants) => {
                format!("a table whose kind is one of {}", variant_names(variants))
            }
        }
    }
}

/// A number as a person writes it: no exponent near 1.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 {
        // Without a sign, as the zeros of a scene are.
        "0".into()
    } else if !value.is_finite() || (1e-3..1e5).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A number with its unit; the empty unit is none.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    match unit {
        "" => number(value),
        "°" => number(value) + "°",
        unit => format!("{} {unit}", number(value)),
    }
}

/// A field that must be written.
pub(super) const fn required(name: &'static str, kind: Kind) -> Field {
    Field { name, kind, presence: Presence::Required }
}

/// A field with a default, or a table that may be left out.
pub(super) const fn optional(name: &'static str, kind: Kind) -> Field {
    Field { name, kind, presence: Presence::Optional }
}

/// A number in [low, high] with a unit.
pub(super) const fn real(unit: &'static str, low: f64, high: f64) -> Kind {
    Kind::Number { unit, low, high }
}

/// A whole number in [low, high].
pub(super) const fn whole(low: i64, high: i64) -> Kind {
    Kind::Whole { low, high }
}
