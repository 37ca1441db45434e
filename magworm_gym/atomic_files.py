"""Files that appear complete or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replace_file(path: Path) -> Iterator[Path]:
    """Gives a temporary path that becomes ``path`` when the block ends without an error."""
    part = path.with_name(f".part-{path.name}")
    yield part
    os.replace(part, path)


def write_text(path: Path, text: str) -> None:
    """Writes a text file, replacing what is there in one move."""
    with replace_file(path) as part:
        part.write_text(text, encoding="utf-8")
