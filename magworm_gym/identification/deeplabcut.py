"""Reading the tracks that DeepLabCut and tools beside it write, as CSV or as HDF5."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import path_of
from magworm_gym.identification.deeplabcut_h5 import is_hdf5, read_hdf5
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.sheet import Sheet, read_sheet
from magworm_gym.recording import Floats

HEADER = ("scorer", "individuals", "bodyparts", "coords")
COORDINATES = ("x", "y", "likelihood")

OF_ENSEMBLES = re.compile(r"(x|y|likelihood)_\w+")
"""What ensembles of networks write beside coordinates, such as x_ens_median and y_posterior_var."""

OF_ALL = "single"
"""What DeepLabCut calls the individual of body parts that belong to none, such as a mark on the stage."""

LAST_FRAME = 10**8

WHOLE = "the frame's number, a whole one"


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

    def sure(self, name: str, least_likelihood: float) -> NDArray[np.bool_]:
        """In which frames (F,) a body part was found with a likelihood."""
        track = self.part(name)
        return np.asarray((track[:, 2] >= least_likelihood) & np.isfinite(track).all(axis=1))


@dataclass(frozen=True)
class Label:
    """What stands in a column: a coordinate of a body part of an individual, which may be empty."""

    individual: str
    part: str
    coordinate: str


@dataclass(frozen=True)
class Frame:
    """The number of a frame, where it stands and how it is written there."""

    place: str
    text: str
    number: float


def read_deeplabcut(path: str | PathLike[str], individual: str | None = None) -> Tracks:
    """Reads a file of DeepLabCut, CSV or HDF5.

    Header rows (scorer, perhaps individuals, bodyparts, coords), then a row for each frame: its number, and
    x, y and perhaps likelihood of each body part, 1 where there is none. Empty cells stand for a part
    that was not found; empty rows and columns say nothing.

    Args:
        path: The file.
        individual: Which individual is meant; may be left out where there is one only.

    Raises:
        ImportError: An HDF5 file, but the library h5py is missing.
        ProblemError: A file of another form; says line, column and value.
    """
    path = path_of("path", path)
    if is_hdf5(path):
        names, index, values = read_hdf5(path)
        labels = [Label(*each) for each in names]
        frames = [Frame(f"row {at}", f"{number:.12g}", number) for at, number in enumerate(index.tolist(), 1)]
    else:
        labels, frames, values = _read_csv(read_sheet(path, "track file"))
    numbers = _numbers(path, frames)
    columns = _columns(path, labels, individual)
    sure = np.ones(len(values))
    return Tracks(
        path,
        numbers,
        {
            part: np.stack([values[:, at["x"]], values[:, at["y"]], _column(values, at, sure)], axis=1)
            for part, at in columns.items()
        },
    )


def _column(values: Floats, at: dict[str, int], otherwise: Floats) -> Floats:
    return values[:, at["likelihood"]] if "likelihood" in at else otherwise


def _read_csv(sheet: Sheet) -> tuple[list[Label], list[Frame], Floats]:
    """Labels of the columns (K,), frames (F,), values (F, K)."""
    header = _header(sheet)
    width = max(map(len, header.values()))
    individuals, parts, coordinates = (
        header.get(name, []) + [""] * (width - len(header.get(name, []))) for name in HEADER[1:]
    )
    individuals, parts = _filled(individuals), _filled(parts)
    named = [at for at in range(width) if coordinates[at]]
    labels = [Label(individuals[at], parts[at], coordinates[at]) for at in named]
    frames: list[Frame] = []
    values: list[list[float]] = []
    for line, row in sheet.rows[len(header) :]:
        for at, cell in enumerate(row[1:]):
            if cell and (at >= width or not coordinates[at]):
                raise sheet.refusal(line, f"column {at + 2}", cell, "nothing, since it has no header")
        if len(row) < named[-1] + 2:
            raise ProblemError(
                f"{sheet.path}, line {line} has {len(row)} columns; allowed: {named[-1] + 2} or more"
            )
        frames.append(Frame(f"line {line}", row[0], sheet.number(line, "column 1", row[0], WHOLE)))
        values.append([sheet.number(line, f"column {at + 2}", row[at + 1]) for at in named])
    return labels, frames, np.array(values, np.float64).reshape(len(frames), len(named))


def _header(sheet: Sheet) -> dict[str, list[str]]:
    """Name of each header row → its cells after the first."""
    header: dict[str, list[str]] = {}
    for name in HEADER:
        line, row = sheet.rows[len(header)] if len(header) < len(sheet.rows) else (len(header) + 1, [""])
        if row[0] == name:
            header[name] = row[1:]
        elif name != "individuals":
            raise sheet.refusal(line, "its beginning", row[0], f"{name!r}, as DeepLabCut writes it")
    if not any(header["coords"]):
        raise ProblemError(f"{sheet.path} has no columns; allowed: {', '.join(COORDINATES)} of body parts")
    return header


def _filled(row: list[str]) -> list[str]:
    """Cells of a header of which merged ones have their text on the left."""
    return list(accumulate(row, _or_left))


def _or_left(left: str, cell: str) -> str:
    return cell or left


def _numbers(path: Path, frames: Sequence[Frame]) -> NDArray[np.int64]:
    """Numbers of frames, which must be whole and rise (F,)."""
    last = -1.0
    for frame in frames:
        if not (last < frame.number <= LAST_FRAME and frame.number == round(frame.number)):
            allowed = WHOLE if last < 0.0 else f"{WHOLE}, greater than {last:.0f}"
            question = "; is it a time in s or ms?" if last < frame.number < LAST_FRAME else ""
            raise ProblemError(
                f"{path}, {frame.place}, column 1 is {frame.text!r}; allowed: {allowed}{question}"
            )
        last = frame.number
    if not frames:
        raise ProblemError(f"{path} has no frames; allowed: at least one row after the header rows")
    numbers = np.array([frame.number for frame in frames], np.int64)
    steps = np.diff(numbers)
    if len(steps) > 1 and steps.min() > 1 and np.ptp(steps) == 1:
        raise ProblemError(
            f"{path}, column 1 rises by {steps.min()} or {steps.max()} a row; allowed: the frame's number; "
            "is it a time in ms that was rounded?"
        )
    return numbers


def _columns(path: Path, labels: Sequence[Label], individual: str | None) -> dict[str, dict[str, int]]:
    """Body part of the individual → places of its coordinates."""
    chosen = _individual(path, labels, individual)
    columns: dict[str, dict[str, int]] = {}
    for at, label in enumerate(labels):
        if label.individual not in (chosen, OF_ALL):
            continue
        found = columns.setdefault(label.part, {})
        if label.coordinate not in COORDINATES and not OF_ENSEMBLES.fullmatch(label.coordinate):
            raise ProblemError(
                f"{path}, coords of {label.part!r} are {label.coordinate!r} in column {at + 2}; allowed: "
                f"{', '.join(COORDINATES)}"
            )
        if label.coordinate in found:
            raise ProblemError(
                f"{path} has {label.coordinate!r} of body part {label.part!r} twice, in columns "
                f"{found[label.coordinate] + 2} and {at + 2}; allowed: each body part once"
            )
        found[label.coordinate] = at
    for part, found in columns.items():
        if missing := [name for name in ("x", "y") if name not in found]:
            raise ProblemError(f"{path} lacks {', '.join(missing)} of body part {part!r}")
    return columns


def _individual(path: Path, labels: Sequence[Label], individual: str | None) -> str:
    """The individual that was asked for, or the only one."""
    names = list(dict.fromkeys(label.individual for label in labels if label.individual != OF_ALL))
    if individual is None and len(names) <= 1:
        return names[0] if names else OF_ALL
    if individual is None or individual not in names:
        asked = "tracks several animals" if individual is None else f"has no individual {individual!r}"
        known = ", ".join(filter(None, names)) or "none, it tracks a single animal"
        raise ProblemError(f"{path} {asked}; allowed: individual (--individual) as one of: {known}")
    return individual
