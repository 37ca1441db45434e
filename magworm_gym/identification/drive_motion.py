"""The drive's motion as it was measured, as waypoints of a scene."""

import csv
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import path_of
from magworm_gym.identification.camera import START_SPAN_S, Camera
from magworm_gym.identification.deeplabcut import Tracks
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.table import read_text

Floats = NDArray[np.float64]

COLUMNS = ("time_s", "x_m", "y_m")


def waypoints(time_s: Floats, points_m: Floats) -> dict[str, Any]:
    """A motion of kind ``waypoints`` that starts at time 0.

    Args:
        time_s: Times, rising (W,) [s]; those before 0 are left out.
        points_m: Places of the drive (W, 2) [m].
    """
    first = np.array([np.interp(0.0, time_s, points_m[:, axis]) for axis in (0, 1)])
    later = time_s > 0.0
    time_s, points_m = np.append(0.0, time_s[later]), np.vstack([first, points_m[later]])
    x_m, y_m = points_m.T
    return {"kind": "waypoints", "time_s": time_s.tolist(), "x_m": x_m.tolist(), "y_m": y_m.tolist()}


def read_drive(path: str | PathLike[str], start_s: float) -> dict[str, Any]:
    """Reads the drive's motion from a CSV file with the columns time_s, x_m, y_m.

    Args:
        path: The file; places are in the axes of the scene.
        start_s: Time in the file at which the experiment begins [s].

    Raises:
        ProblemError: A file of another form; says line, column and value.
    """
    path = path_of("path", path)
    rows = list(csv.reader(read_text(path, "drive file").splitlines()))
    header = tuple(cell.strip() for cell in rows[0]) if rows else ()
    if header != COLUMNS:
        raise ProblemError(f"{path}, line 1 is {','.join(header)!r}; allowed: {','.join(COLUMNS)}")
    values: list[list[float]] = []
    for line, row in enumerate(rows[1:], start=2):
        if row:
            values.append(_numbers(path, line, row))
            if len(values) > 1 and values[-1][0] <= values[-2][0]:
                raise ProblemError(f"{path}, line {line}, time_s is {values[-1][0]:g}; allowed: rising")
    if not values:
        raise ProblemError(f"{path} has no rows; allowed: at least one after the header")
    table = np.array(values)
    return waypoints(table[:, 0] - start_s, table[:, 1:])


def _numbers(path: Path, line: int, row: list[str]) -> list[float]:
    if len(row) != len(COLUMNS):
        raise ProblemError(f"{path}, line {line} has {len(row)} columns; allowed: {len(COLUMNS)}")
    numbers = []
    for column, text in zip(COLUMNS, row, strict=True):
        try:
            number = float(text)
        except ValueError:
            number = float("nan")
        if not np.isfinite(number):
            raise ProblemError(f"{path}, line {line}, column {column} is {text!r}; allowed: a number")
        numbers.append(number)
    return numbers


def drive_from_film(
    tracks: Tracks,
    camera: Camera,
    part: str,
    magnets: list[str],
    start_m: Floats,
    *,
    least_likelihood: float,
    height_m: float | None,
) -> dict[str, Any]:
    """The drive's motion from a body part of the same film.

    Where the camera's origin is unknown, it follows from the magnets in the first 0.1 s, in which
    the robot must be in the scene's start pose.

    Args:
        tracks: What the tracking found.
        camera: The camera.
        part: The body part on the drive magnet.
        magnets: Body part of each magnet from the head; empty for those that were not tracked.
        start_m: Places of the magnets in the start pose (M, 2) [m].
        least_likelihood: Points below are left out [1].
        height_m: Height of the drive [m]; None takes the tracked one.

    Raises:
        ProblemError: The drive was found in no frame, or no magnet at the start.
    """
    time_s = camera.time_s(tracks.frames)
    track = tracks.part(part)
    seen = (track[:, 2] >= least_likelihood) & np.isfinite(track).all(axis=1)
    if not seen.any():
        raise ProblemError(f"{tracks.file}: {part!r} has no likelihood of at least {least_likelihood:g}")
    points = camera.points_m(track[seen, :2])
    if isinstance(camera.origin, str):
        points = points + _start_offset(tracks, camera, magnets, start_m, least_likelihood)
    if height_m is not None:
        points[:, 1] = height_m
    return waypoints(time_s[seen], points)


def _start_offset(
    tracks: Tracks, camera: Camera, magnets: list[str], start_m: Floats, least_likelihood: float
) -> Floats:
    """Start pose minus tracks in the first 0.1 s (2,) [m]."""
    time_s = camera.time_s(tracks.frames)
    begun = (time_s >= 0.0) & (time_s <= START_SPAN_S)
    offsets = []
    for magnet, part in enumerate(magnets):
        if part:
            track = tracks.part(part)
            kept = begun & (track[:, 2] >= least_likelihood) & np.isfinite(track).all(axis=1)
            offsets.append(start_m[magnet] - camera.points_m(track[kept, :2]))
    found = np.concatenate(offsets)
    if not len(found):
        raise ProblemError(
            f"{tracks.file}: no magnet is seen in the first {START_SPAN_S:g} s, so the drive's place is "
            "unknown; allowed: a start_s at which the robot is seen at rest, or origin = [x_px, y_px]"
        )
    return np.asarray(np.median(found, axis=0))
