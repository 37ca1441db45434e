"""Blocks of a Markdown file that programs write, between ``<!-- NAME -->`` and ``<!-- /NAME -->``."""

import re
import sys
from collections.abc import Callable
from pathlib import Path

BLOCK = re.compile(r"<!-- (?P<name>[^/ ]\S*) -->(?P<line>\n?).*?<!-- /(?P=name) -->", re.DOTALL)


def fill(text: str, block: Callable[[str], str | None]) -> str:
    """A text with new blocks, each on lines of its own, or within a line, as it was.

    Args:
        text: A text with blocks.
        block: Gives a block by its name; None for one that stays as it is.
    """

    def filled(found: re.Match[str]) -> str:
        name, line = found["name"], found["line"]
        new = block(name)
        return found[0] if new is None else f"<!-- {name} -->{line}{new}{line}<!-- /{name} -->"

    return BLOCK.sub(filled, text)


def write_or_compare(file: Path, fresh: str, *, check: bool) -> int:
    """Writes a file anew, or with ``check`` only compares; returns the exit status."""
    stale = not file.exists() or file.read_text(encoding="utf-8") != fresh
    if stale and check:
        print(f"{file} is out of date; run 'make docs'", file=sys.stderr)
        return 1
    if stale:
        file.write_text(fresh, encoding="utf-8")
    return 0
