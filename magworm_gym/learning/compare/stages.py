"""Stages of a comparison whose results are kept, so that a stopped one goes on."""

import functools
import hashlib
import inspect
import json
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from magworm_gym import _magworm
from magworm_gym.atomic_files import write_json


class Stages:
    """Keeps the result of each stage as JSON, under a name made from all that decides it.

    Args:
        folder: Folder of the results; made if it is missing.
        say: Takes one line about each stage.
    """

    def __init__(self, folder: Path, say: Callable[[str], None] = print) -> None:
        self._folder = folder
        self._say = say
        self._told: set[Path] = set()
        folder.mkdir(parents=True, exist_ok=True)

    def result(
        self, name: str, decided_by: dict[str, Any], made_by: Iterable[Any], compute: Callable[[], Any]
    ) -> Any:
        """Computes a stage, or reads what an earlier run with the same settings has kept.

        Args:
            name: Name of the stage; part of the file's name.
            decided_by: Every setting that changes the result, as plain values.
            made_by: Functions, classes and modules whose source files do; the compiled simulator does always.
            compute: Gives the result as plain values.

        Returns:
            The result, as read back from JSON.
        """
        sources = {made.__name__: source_digest(made) for made in (*made_by, _magworm)}
        settings = json.dumps([decided_by, sources], sort_keys=True)
        path = self._folder / f"{name}-{hashlib.sha256(settings.encode()).hexdigest()[:12]}.json"
        kept = _read(path)
        if kept is None:
            began = time.monotonic()
            write_json(path, compute())
            self._say(f"{name}: {time.monotonic() - began:.1f} s")
            kept = _read(path)
        elif path not in self._told:
            self._say(f"{name}: kept from an earlier run")
        self._told.add(path)
        return kept


def _read(path: Path) -> Any:
    """What a file holds; None where it is missing or damaged."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def source_digest(made: Any) -> str:
    """Digest of the file of a function, a class or a module."""
    return _file_digest(inspect.getfile(made))


@functools.cache
def _file_digest(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def content_digest(folder: Path) -> str:
    """Digest of the files of a folder, their names and contents, wherever it lies."""
    digest = hashlib.sha256()
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        content = path.read_bytes()
        digest.update(f"{path.relative_to(folder).as_posix()}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()
