"""Reading the tracks that DeepLabCut writes as CSV."""

import csv
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import path_of
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.table import read_text

Floats = NDArray[np.float64]

HEADER = ("scorer", "bodyparts", "coords")
COORDINATES = ("x", "y", "likelihood")


@dataclass(frozen=True)
class Tracks:
    """Body parts in the frames of a film.

    Attributes:
        file: Where they come from.
        frames: Numbers of the frames (F,), rising.
        parts: Body part → x, y, likelihood (F, 3) [px, px, 1]; NaN where it was not found.
    """

    file: Path
    frames: NDArray[np.int64]
    parts: dict[str, Floats]

    def part(self, name: str) -> Floats:
        """Track of a body part (F, 3).

        Raises:
            ProblemError: There is no such part.
        """
        if name not in self.parts:
            raise ProblemError(f"{self.file} has no body part {name!r}; it has: {', '.join(self.parts)}")
        return self.parts[name]


def read_deeplabcut(path: str | PathLike[str]) -> Tracks:
    """Reads a CSV file of DeepLabCut for a single animal.

    Three header rows (scorer, bodyparts, coords), then a row for each frame: its number, and x, y
    and likelihood of each body part. Empty cells stand for a part that was not found.

    Raises:
        ProblemError: A file of another form; says line, column and value.
    """
    path = path_of("path", path)
    rows = list(csv.reader(read_text(path, "track file").splitlines()))
    _check_header(path, rows)
    parts, coordinates = rows[1][1:], rows[2][1:]
    columns = _columns(path, parts, coordinates)
    width = len(rows[1])
    frames: list[int] = []
    cells: list[list[float]] = []
    for line, row in enumerate(rows[3:], start=4):
        if not row:
            continue
        if len(row) != width:
            raise ProblemError(f"{path}, line {line} has {len(row)} columns; allowed: {width}, as in line 2")
        frames.append(_frame(path, line, row[0], frames[-1] if frames else -1))
        cells.append([_cell(path, line, column, text) for column, text in enumerate(row[1:], start=2)])
    if not frames:
        raise ProblemError(f"{path} has no frames; allowed: at least one row after the three header rows")
    values = np.array(cells, np.float64)
    return Tracks(path, np.array(frames, np.int64), {part: values[:, at] for part, at in columns.items()})


def _check_header(path: Path, rows: list[list[str]]) -> None:
    if len(rows) > 1 and rows[1] and rows[1][0] == "individuals":
        raise ProblemError(
            f"{path}, line 2 names individuals, so it tracks several animals; allowed: tracks of a single "
            "animal with the header rows scorer, bodyparts, coords"
        )
    for line, name in enumerate(HEADER, start=1):
        found = rows[line - 1][0] if len(rows) >= line and rows[line - 1] else None
        if found != name:
            raise ProblemError(
                f"{path}, line {line} begins with {found!r}; allowed: {name!r}, as DeepLabCut writes it"
            )


def _columns(path: Path, parts: list[str], coordinates: list[str]) -> dict[str, list[int]]:
    """Body part → its three columns, counted without the frame's number."""
    if len(parts) != len(coordinates):
        raise ProblemError(f"{path}, line 3 has {len(coordinates) + 1} columns; allowed: {len(parts) + 1}")
    columns: dict[str, dict[str, int]] = {}
    for at, (part, coordinate) in enumerate(zip(parts, coordinates, strict=True)):
        found = columns.setdefault(part, {})
        if coordinate not in COORDINATES or coordinate in found:
            raise ProblemError(
                f"{path}, line 3, column {at + 2} is {coordinate!r} of {part!r}; "
                f"allowed: {', '.join(COORDINATES)}, once each"
            )
        found[coordinate] = at
    for part, found in columns.items():
        if len(found) < 3:
            missing = [name for name in COORDINATES if name not in found]
            raise ProblemError(f"{path}, line 3 lacks {', '.join(missing)} of body part {part!r}")
    return {part: [found[name] for name in COORDINATES] for part, found in columns.items()}


def _frame(path: Path, line: int, text: str, last: int) -> int:
    try:
        frame = int(float(text))
    except ValueError:
        frame = -1
    if frame <= last:
        raise ProblemError(
            f"{path}, line {line}, column 1 is {text!r}; allowed: the frame's number, greater than {last}"
        )
    return frame


def _cell(path: Path, line: int, column: int, text: str) -> float:
    try:
        return float(text) if text.strip() else float("nan")
    except ValueError as error:
        raise ProblemError(
            f"{path}, line {line}, column {column} is {text!r}; allowed: a number or nothing"
        ) from error
