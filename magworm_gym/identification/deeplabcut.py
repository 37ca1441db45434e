"""Reading the tracks that DeepLabCut and tools beside it write, as CSV or as HDF5."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import path_of
from magworm_gym.identification.deeplabcut_h5 import Frame, Label, is_hdf5, read_hdf5
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
    labels, frames, values = read_hdf5(path) if is_hdf5(path) else _read_csv(read_sheet(path, "track file"))
    sure = np.ones(len(values))
    parts = {
        part: np.stack([sure if at is None else values[:, at] for at in places], axis=1)
        for part, places in _parts(path, labels, individual).items()
    }
    return Tracks(path, _numbers(path, frames), parts)


def _read_csv(sheet: Sheet) -> tuple[list[Label], list[Frame], Floats]:
    """Labels of the columns (K,), frames (F,), values (F, K)."""
    header = _header(sheet)
    width = max(map(len, header.values()))
    individuals, parts, coordinates = (
        [*header.get(name, []), *[""] * (width - len(header.get(name, [])))] for name in HEADER[1:]
    )
    named = [at for at in range(width) if coordinates[at]]
    labels = list(zip(_filled(individuals), _filled(parts), coordinates, strict=True))
    frames: list[Frame] = []
    values: list[list[float]] = []
    for line, row in sheet.rows[len(header) :]:
        if len(row) < named[-1] + 2:
            raise ProblemError(
                f"{sheet.path}, line {line} has {len(row)} columns; allowed: {named[-1] + 2} or more"
            )
        for at, cell in enumerate(row[1:]):
            if cell and (at >= width or not coordinates[at]):
                raise sheet.refusal(line, f"column {at + 2}", cell, "nothing, since it has no header")
        number = sheet.number(line, "column 1", row[0], WHOLE)
        frames.append((f"line {line}, column 1 is {row[0]!r}", number))
        values.append([sheet.number(line, f"column {at + 2}", row[at + 1]) for at in named])
    return [labels[at] for at in named], frames, np.array(values, np.float64).reshape(len(frames), len(named))


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
    filled = [""]
    for cell in row:
        filled.append(cell or filled[-1])
    return filled[1:]


def _numbers(path: Path, frames: Sequence[Frame]) -> NDArray[np.int64]:
    """Numbers of frames (F,), which must be whole and rise."""
    last = -1.0
    for told, number in frames:
        if not (last < number <= LAST_FRAME and number == round(number)):
            allowed = WHOLE if last < 0.0 else f"{WHOLE}, greater than {last:.0f}"
            question = "; is it a time in s or ms?" if last < number < LAST_FRAME else ""
            raise ProblemError(f"{path}, {told}; allowed: {allowed}{question}")
        last = number
    if not frames:
        raise ProblemError(f"{path} has no frames; allowed: at least one row after the header rows")
    numbers = np.array([number for _, number in frames], np.int64)
    steps = np.diff(numbers)
    if len(steps) > 1 and steps.min() > 1 and np.ptp(steps) == 1:
        raise ProblemError(
            f"{path}, column 1 rises by {steps.min()} or {steps.max()} a row; allowed: the frame's number; "
            "is it a time in ms that was rounded?"
        )
    return numbers


def _parts(path: Path, labels: Sequence[Label], individual: str | None) -> dict[str, list[int | None]]:
    """Body part of the individual → columns of x, y and likelihood, None where there is none."""
    animals = list(dict.fromkeys(animal for animal, _, _ in labels if animal != OF_ALL))
    if (individual is not None and individual not in animals) or (individual is None and len(animals) > 1):
        asked = "tracks several animals" if individual is None else f"has no individual {individual!r}"
        known = ", ".join(filter(None, animals)) or "none, it tracks a single animal"
        raise ProblemError(f"{path} {asked}; allowed: individual (--individual) as one of: {known}")
    meant = [individual or animals[0] if animals else OF_ALL, OF_ALL]
    places: dict[tuple[str, str], int] = {}
    for at, (animal, part, coordinate) in enumerate(labels):
        if animal not in meant or OF_ENSEMBLES.fullmatch(coordinate):
            continue
        if coordinate not in COORDINATES:
            raise ProblemError(
                f"{path} has coordinates {coordinate!r} of {part!r}; allowed: {', '.join(COORDINATES)}"
            )
        if (part, coordinate) in places:
            raise ProblemError(f"{path} has {coordinate!r} of body part {part!r} twice; allowed: once")
        places[part, coordinate] = at
    for part, _ in places:
        for name in COORDINATES[:2]:
            if (part, name) not in places:
                raise ProblemError(f"{path} lacks {name!r} of body part {part!r}")
    return {part: [places.get((part, name)) for name in COORDINATES] for part, _ in places}
