"""Blocks of a Markdown file that programs write, between ``<!-- NAME -->`` and ``<!-- /NAME -->``."""

import sys
from collections.abc import Mapping
from pathlib import Path


def splice(text: str, name: str, block: str) -> str:
    """A text with another block of this name.

    Raises:
        ValueError: The text has no such block.
    """
    begin, end = f"<!-- {name} -->", f"<!-- /{name} -->"
    before, found, rest = text.partition(begin)
    _, ended, after = rest.partition(end)
    if not found or not ended:
        raise ValueError(f"the lines {begin} and {end} are missing")
    return f"{before}{begin}\n{block}\n{end}{after}"


def write_or_check(file: Path, blocks: Mapping[str, str], *, check: bool) -> int:
    """Writes blocks into a file, or with ``check`` only compares; returns the exit status."""
    text = fresh = file.read_text(encoding="utf-8")
    for name, block in blocks.items():
        try:
            fresh = splice(fresh, name, block)
        except ValueError as error:
            print(f"{file}: {error}", file=sys.stderr)
            return 1
    if check and fresh != text:
        print(f"{', '.join(blocks)} in {file}: out of date; run 'make docs'", file=sys.stderr)
        return 1
    if not check:
        file.write_text(fresh, encoding="utf-8")
    return 0
