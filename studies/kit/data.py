"""What was measured, written and read: rows as CSV, all else as JSON.

Both take dataclasses and give them back, checked against their types. Numbers are rounded to a few
significant digits, so that a file is small and says no more than is known. What is not a number is an empty
cell of a table, and the word ``nan`` or ``inf`` in JSON.
"""

import csv
import json
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import UnionType
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import msgspec
import numpy as np

T = TypeVar("T")
DIGITS = 6


def write_rows(path: Path, kind: type[Any], rows: Sequence[Any], digits: int = DIGITS) -> None:
    """Writes dataclasses of a kind, one a line.

    The fields of a dataclass within another are columns as well; a tuple of numbers is one cell, with spaces.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    names = [name for name, _ in _columns(kind)]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(names)
        for row in rows:
            cells = dict(_cells(row, digits))
            writer.writerow([cells.get(name, "") for name in names])


def read_rows(path: Path, kind: type[T]) -> list[T]:
    """Reads what :func:`write_rows` wrote.

    Raises:
        msgspec.ValidationError: A cell is not of its field's type.
    """
    with path.open(newline="", encoding="utf-8") as file:
        return [msgspec.convert(_nested(kind, row), kind, strict=False) for row in csv.DictReader(file)]


def write_json(path: Path, found: Any, digits: int = DIGITS) -> None:
    """Writes dataclasses, dictionaries, lists and arrays; a list of numbers stands on one line."""
    path.parent.mkdir(parents=True, exist_ok=True)
    plain = msgspec.to_builtins(found, enc_hook=lambda value: np.asarray(value).tolist())
    text = json.dumps(_rounded(plain, digits), indent=1, ensure_ascii=False, allow_nan=False)
    text = re.sub(r"\[\n([^\[\]{}]*?)\n\s*\]", lambda found: f"[{' '.join(found[1].split())}]", text)
    path.write_text(text + "\n", encoding="utf-8")


def read_json(path: Path, kind: type[T]) -> T:
    """Reads what :func:`write_json` wrote.

    Raises:
        msgspec.ValidationError: A value is not of its field's type.
    """
    values = json.loads(path.read_text(encoding="utf-8"))
    return msgspec.convert(values, kind, strict=False, dec_hook=_array)


def _array(kind: Any, values: Any) -> Any:
    (of,) = get_args(get_args(kind)[1])
    return np.asarray(values, of)


def _rounded(value: Any, digits: int) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{digits}g}") if math.isfinite(value) else str(value)
    if isinstance(value, dict):
        return {name: _rounded(each, digits) for name, each in value.items()}
    return [_rounded(each, digits) for each in value] if isinstance(value, list | tuple) else value


def _columns(kind: type[Any]) -> Iterator[tuple[str, Any]]:
    """Names and types of a dataclass's fields; of one within another its own."""
    for name, of in get_type_hints(kind).items():
        inner = _inner(of)
        yield from _columns(inner) if inner else [(name, of)]


def _inner(of: Any) -> Any:
    """The dataclass that a field holds, or may hold."""
    kinds = get_args(of) if get_origin(of) is UnionType else (of,)
    return next((kind for kind in kinds if is_dataclass(kind)), None)


def _cells(row: Any, digits: int) -> Iterator[tuple[str, Any]]:
    for field in fields(row):
        value = getattr(row, field.name)
        if is_dataclass(value):
            yield from _cells(value, digits)
        elif isinstance(value, tuple):
            yield field.name, " ".join(f"{number:.{digits}g}" for number in value)
        elif isinstance(value, float):
            yield field.name, "" if math.isnan(value) else f"{value:.{digits}g}"
        else:
            yield field.name, "" if value is None else str(value)


def _nested(kind: type[Any], cells: dict[str, str]) -> dict[str, Any]:
    """The cells of a row as msgspec takes them."""
    values: dict[str, Any] = {}
    for name, of in get_type_hints(kind).items():
        inner, absent, base = _inner(of), type(None) in get_args(of), get_origin(of) or of
        if inner:
            given = any(cells[column] for column, _ in _columns(inner))
            values[name] = _nested(inner, cells) if given or not absent else None
        elif isinstance(base, type) and issubclass(base, tuple):
            values[name] = cells[name].split()
        elif cells[name] == "" and of is not str:
            values[name] = None if absent else "nan"
        else:
            values[name] = cells[name]
    return values
