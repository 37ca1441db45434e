//! The page of the rows of a block, docs/rows.md, is what the declaration says.
//!
//! `MAGWORM_WRITE_ROWS=1 cargo test --test rows` writes it.

use magworm::internals::{Allowed, ROWS, Role, RowGroup};
use std::path::Path;

const HEAD: &str = "\
# Rows of a block

A block holds the numbers of eight robots, or sixteen in single precision, one per lane of a row. All of its rows are declared in
`rust/magworm/src/model/rows.rs`; this page is written from there by `MAGWORM_WRITE_ROWS=1 cargo test --test rows`. A snapshot holds the
state in this order, with the solver steps since the reset, the status, and factors and magnets for the next reset.

| row | unit | role | what it is | in a state |
|---|---|---|---|---|
";

fn allowed(group: &RowGroup) -> String {
    match (group.role, group.allowed) {
        (Role::Derived | Role::Workspace, _) => String::new(),
        (_, Allowed::Range(low, high)) => format!("{low:e} to {high:e}"),
        (_, Allowed::Whole(most)) => format!("a whole number from 0 to {most}"),
        (_, Allowed::Factors) => "0 or more; of the drive's speed any".into(),
        (_, Allowed::Frames) => "unit vectors at right angles".into(),
    }
}

fn page() -> String {
    let line = |group: &RowGroup| {
        let role = format!("{:?}", group.role).to_lowercase();
        let meaning = group.meaning.replace("[`", "`").replace("`]", "`").replace("crate::", "");
        format!("| `{}` | {} | {role} | {meaning} | {} |\n", group.name, group.unit, allowed(group))
    };
    HEAD.to_string() + &ROWS.iter().map(line).collect::<String>()
}

#[test]
fn the_page_is_what_the_declaration_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/rows.md");
    if std::env::var_os("MAGWORM_WRITE_ROWS").is_some() {
        std::fs::write(&path, page()).expect("a page to write");
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(written == page(), "docs/rows.md is not what rows.rs declares: write it anew");
}
