"""Pages from templates: Markdown with places for numbers, see https://jinja.palletsprojects.com."""

import textwrap
from collections.abc import Iterable, Sequence
from inspect import getmembers, isfunction
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from studies.kit import words

WIDTH = 128


def page(template: Path, **values: Any) -> str:
    """A template filled with values.

    A template includes others of its folder, uses the functions of :mod:`studies.kit.words` as filters
    (``{{ lift_mm | number(2) }}``), and :func:`table` and :func:`image`. Lines that hold only a tag
    leave no line.

    Args:
        template: Path of the file.
        **values: What it names.

    Raises:
        jinja2.UndefinedError: It names a value that is not given.
    """
    environment = Environment(
        loader=FileSystemLoader(template.parent),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(getmembers(words, isfunction), wrapped=wrapped)
    environment.globals.update(table=table, image=image)
    return environment.get_template(template.name).render(values)


def table(head: Sequence[object], rows: Iterable[Sequence[object]]) -> str:
    """A Markdown table without its last line break."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, cells))} |" for cells in lines)


def image(file: str, caption: str) -> str:
    """A figure below ``docs/images/`` with its caption, as seen from a page in ``docs/``."""
    return f"![{caption}](images/{file})\n\n*{caption}*"


def wrapped(text: str) -> str:
    """A paragraph in lines of at most 128 characters."""
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False)
