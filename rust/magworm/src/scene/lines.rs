//! Finds the line of a TOML text that a problem speaks of.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Problem, SceneError};

/// The error of a text that is not TOML.
pub(super) fn syntax_error(text: &str, error: &toml::de::Error) -> SceneError {
    SceneError {
        line: error.span().map(|span| line_of(text, span.start)),
        problem: Problem::Syntax(error.message().trim().replace('\n', "; ")),
    }
}

/// Adds the line of the field at fault, or of the innermost table around it that the text holds.
pub(super) fn located(text: &str, problem: Problem) -> SceneError {
    let offset = problem.field().and_then(|field| {
        let table = DeTable::parse(text).ok()?;
        innermost(table.get_ref(), field)
    });
    SceneError { line: offset.map(|offset| line_of(text, offset)), problem }
}

/// Byte offset of the last part of a path such as `reset.vary[1].low` that can be found.
fn innermost(table: &DeTable<'_>, path: &str) -> Option<usize> {
    let (mut offset, mut table) = (None, table);
    for part in path.split('.') {
        let (name, index) = split_index(part);
        let Some((key, value)) = table.get_key_value(name) else { break };
        offset = Some(key.span().start);
        let value = element(value, index, &mut offset);
        let Some(DeValue::Table(inner)) = value.map(Spanned::get_ref) else { break };
        table = inner;
    }
    offset
}

/// The element of a list, where the path asks for one.
fn element<'a, 'i>(
    value: &'a Spanned<DeValue<'i>>,
    index: Option<usize>,
    offset: &mut Option<usize>,
) -> Option<&'a Spanned<DeValue<'i>>> {
    let Some(index) = index else { return Some(value) };
    let element = value.get_ref().as_array()?.get(index)?;
    *offset = Some(element.span().start);
    Some(element)
}

/// `vary[1]` is `vary` and 1.
pub(super) fn split_index(part: &str) -> (&str, Option<usize>) {
    match part.strip_suffix(']').and_then(|part| part.split_once('[')) {
        Some((name, index)) => (name, index.parse().ok()),
        None => (part, None),
    }
}

fn line_of(text: &str, offset: usize) -> usize {
    1 + text.bytes().take(offset).filter(|byte| *byte == b'\n').count()
}
