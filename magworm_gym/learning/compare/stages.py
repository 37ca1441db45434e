"""Stages of an evaluation whose results are kept, so that a stopped one goes on."""

import functools
import hashlib
import json
import time
from collections.abc import Callable
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

    def result(self, name: str, decided_by: dict[str, Any], compute: Callable[[], Any]) -> Any:
        """Computes a stage, or reads what an earlier run with the same settings has kept.

        Args:
            name: Name of the stage; part of the file's name.
            decided_by: Every setting that changes the result, as plain values.
            compute: Gives the result as plain values.

        Returns:
            The result, as read back from JSON.
        """
        settings = json.dumps({**decided_by, "simulator": _simulator()}, sort_keys=True)
        key = hashlib.sha256(settings.encode()).hexdigest()[:12]
        path = self._folder / f"{name}-{key}.json"
        if not path.exists():
            began = time.monotonic()
            write_json(path, compute())
            self._say(f"{name}: {time.monotonic() - began:.1f} s")
        elif path not in self._told:
            self._say(f"{name}: kept from an earlier run")
        self._told.add(path)
        return json.loads(path.read_text(encoding="utf-8"))


@functools.cache
def _simulator() -> str:
    """Digest of the compiled simulator: another build may move robots otherwise."""
    return hashlib.sha256(Path(_magworm.__file__).read_bytes()).hexdigest()
