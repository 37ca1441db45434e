"""The problem file: what is in it, in a file that it is like, and what is given in place of that."""

from collections.abc import Collection, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from magworm_gym.arguments import path_of
from magworm_gym.documents import parse_toml
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.problem import Problem, make_problem
from magworm_gym.identification.sheet import read_text

MOST_FILES = 8
"""Most files that are each like the next."""


def read_problem(
    path: str | PathLike[str],
    search: Mapping[str, Any] | None = None,
    without: Collection[str] = (),
    values: Mapping[str, Any] | None = None,
) -> Problem:
    """Reads a problem file.

    Args:
        path: The TOML file; files that it names are relative to its folder.
        search: Settings of the search that replace those of the file.
        without: Groups of claims that are not fitted, only reported.
        values: Values of the scene that replace those of the file.

    Raises:
        ProblemError: A mistake in it or in a file that it names.
    """
    path = path_of("path", path)
    given = {"search": dict(search or {}), "values": dict(values or {})}
    entries = _merged(_entries(path), {key: each for key, each in given.items() if each})
    if without:
        entries = {**entries, "without": sorted(without)}
    try:
        return make_problem(entries, path.parent)
    except ProblemError as error:
        raise ProblemError(f"{path}: {error}") from error


def _entries(path: Path, most: int = MOST_FILES - 1) -> dict[str, Any]:
    """What a file holds and the file that it is like: it adds to tables and replaces lists."""
    entries = parse_toml(read_text(path, "problem file"), str(path), ProblemError)
    like = entries.pop("like", None)
    if like is None:
        return entries
    if not isinstance(like, str) or not most:
        raise ProblemError(
            f"{path}: like is {like!r}; allowed: another problem file that is not like this one"
        )
    return _merged(_entries(path.parent / like, most - 1), entries)


def _merged(entries: dict[str, Any], others: dict[str, Any]) -> dict[str, Any]:
    both = {
        key: _merged(entries[key], value)
        for key, value in others.items()
        if _is_table(entries.get(key)) and _is_table(value) and "." not in key
    }
    return {**entries, **others, **both}


def _is_table(value: object) -> bool:
    """Whether something is a table of paths, and no value that is a table."""
    return isinstance(value, dict) and not {"kind", "low", "high"} & value.keys()
