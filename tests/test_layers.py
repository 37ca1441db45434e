"""The check of the layers finds what it should, and the simulator passes it."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
TABLE = """# Architecture

## Layers

| modules | what they hold |
|---|---|
| `low` | numbers |
| `middle` | kernels |
| `high` | steps |

## Other

| `never` | not of the table |
"""
CRATE = {
    "lib.rs": "mod low; mod middle; mod high; pub use high::Step;",
    "low.rs": "pub struct Number; /// See [`crate::high::Step`].\npub fn number() {}",
    "middle/mod.rs": "mod left; mod right; pub use left::Left; use crate::low::Number;",
    "middle/left.rs": 'pub struct Left; // crate::high::Step\nfn f() -> &\'static str { "crate::high" }',
    "middle/right.rs": "use super::Left;",
    "high.rs": "use crate::{low, middle::Left}; pub struct Step; fn f(_: low::Number, _: Left) {}",
}


def check(root: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / ".ci" / "layers.py"), str(root)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def broken(folder: Path, **changes: str) -> list[str]:
    """What the check says of a small crate with other files; `middle__left` stands for `middle/left.rs`."""
    files = CRATE | {name.replace("__", "/") + ".rs": text for name, text in changes.items()}
    for name, text in files.items():
        path = folder / "rust" / "magworm" / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    (folder / "ARCHITECTURE.md").write_text(TABLE, encoding="utf-8")
    result = check(folder)
    assert result.stderr == ""
    lines = result.stdout.splitlines()
    assert result.returncode == (lines != ["Layers hold."])
    return [line.removeprefix("rust/magworm/src/") for line in lines]


def test_the_simulator_keeps_its_layers():
    result = check(ROOT)
    assert result.returncode == 0, result.stdout + result.stderr


def test_a_crate_without_a_fault_passes(tmp_path):
    assert broken(tmp_path) == ["Layers hold."]


@pytest.mark.parametrize(
    "low",
    [
        "use crate::high::Step;",
        "use crate::{middle::Left as _, high::{self as top}};",
        "pub(crate) use super::high::*;",
        "pub use crate::Step as Stride;",
        "fn f(_: &crate::high::Step) {}",
        "fn f() { let _ = [1, 2].map(|_| crate::high ::Step); }",
        "mod inner { fn f() -> super::super::high::Step { todo!() } }",
    ],
)
def test_a_higher_module_is_found_wherever_it_is_named(tmp_path, low):
    assert "low.rs:2: low names high, which stands in a higher layer" in broken(tmp_path, low="\n" + low)


def test_what_a_lower_module_hands_on_is_followed_to_its_own(tmp_path):
    lines = broken(tmp_path, low="pub use crate::high::Step;", middle__right="use crate::low::Step;")
    assert "middle/right.rs:1: middle::right names high, which stands in a higher layer" in lines


def test_modules_beside_each_other_that_name_each_other_are_found(tmp_path):
    left = "pub struct Left; use super::right::f;"
    back = "which names it back, directly or around"
    assert broken(tmp_path, middle__left=left, middle__right="use super::Left; pub fn f() {}") == [
        f"middle/left.rs:1: middle::left names middle::right, {back}",
        f"middle/right.rs:1: middle::right names middle::left, {back}",
    ]


def test_a_module_that_the_table_forgot_is_named_and_so_is_one_that_is_gone(tmp_path):
    lines = broken(tmp_path, lib="mod low; mod high; mod other;", other="", high="")
    assert lines == ["ARCHITECTURE.md: no layer holds other", "ARCHITECTURE.md: there is no module middle"]


def test_tests_may_name_what_they_like(tmp_path):
    test = "#[cfg(test)]\nmod tests { use crate::high::Step; fn f() { if true {} } }\npub struct Number;"
    assert broken(tmp_path, low=test) == ["Layers hold."]
