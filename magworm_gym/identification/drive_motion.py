"""The drive's motion as it was measured, as waypoints of a scene."""

from dataclasses import dataclass
from heapq import heappop, heappush
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from magworm_gym.arguments import path_of
from magworm_gym.identification.camera import START_SPAN_S
from magworm_gym.identification.deeplabcut import Tracks
from magworm_gym.identification.filmed import FilmTable
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.sheet import read_sheet
from magworm_gym.recording import Floats

COLUMNS = ("time_s", "x_m", "y_m")

MOST_LONGER = 100.0
"""Times the experiment that a measured motion may last without a word [1]."""

MOST_WAYPOINTS = 10_000
"""Most waypoints of a scene."""

FARTHEST_M = 1e-4
"""Greatest distance of a measured motion from the waypoints that stand for it [m]."""

UNCOVERED = 0.1
"""Part of an experiment that a measured motion may leave out at either end without a word [1]."""


@dataclass(frozen=True)
class StageLog:
    """What a stage wrote down.

    Attributes:
        file: Where it comes from.
        time_s: Times, rising (W,) [s].
        points_m: Places of the drive (W, 2) in the axes of the scene [m].
        rows: Number of rows; those of equal time are averaged.
        spread_m: Greatest distance of a coordinate from the mean at its time [m].
    """

    file: Path
    time_s: Floats
    points_m: Floats
    rows: int
    spread_m: float


def read_stage(path: str | PathLike[str]) -> StageLog:
    """Reads the drive's motion from a CSV file with the columns time_s, x_m, y_m among others.

    Raises:
        ProblemError: A file of another form; says line, column and value.
    """
    path = path_of("path", path)
    sheet = read_sheet(path, "drive file")
    line, header = sheet.rows[0] if sheet.rows else (1, [])
    if any(header.count(name) != 1 for name in COLUMNS):
        raise ProblemError(f"{path}, line {line} is {','.join(header)!r}; allowed: {','.join(COLUMNS)}")
    rows: list[list[float]] = []
    for line, row in sheet.rows[1:]:
        cells = dict(zip(header, row, strict=False))
        rows.append(
            [sheet.number(line, f"column {name}", cells.get(name, ""), "a number") for name in COLUMNS]
        )
        if not np.isfinite(rows[-1]).all():
            raise ProblemError(
                f"{path}, line {line} is {','.join(row)!r}; allowed: {','.join(COLUMNS)}, numbers all"
            )
        if len(rows) > 1 and rows[-1][0] < rows[-2][0]:
            raise ProblemError(f"{path}, line {line}, time_s is {rows[-1][0]:g}; allowed: rising")
    if not rows:
        raise ProblemError(f"{path} has no rows; allowed: at least one after the header")
    time_s, points_m = np.split(np.array(rows), [1], axis=1)
    times_s, first, place, count = np.unique(
        time_s[:, 0], return_index=True, return_inverse=True, return_counts=True
    )
    means_m = np.add.reduceat(points_m, first, axis=0) / count[:, None]
    return StageLog(path, times_s, means_m, len(rows), float(np.abs(points_m - means_m[place]).max()))


def drive_from_stage(log: StageLog, start_s: float, duration_s: float) -> tuple[dict[str, Any], list[str]]:
    """The drive's motion during an experiment, and what there is to say of it.

    Args:
        log: What the stage wrote down.
        start_s: Time in it at which the experiment begins [s].
        duration_s: Duration of the experiment [s].

    Raises:
        ProblemError: It says nothing of the time of the experiment, or cannot be followed.
    """
    time_s = log.time_s - start_s
    first_s, last_s = float(time_s[0]), float(time_s[-1])
    told = f"{log.file}: its times less start_s = {start_s:g} are {first_s:g} to {last_s:g} s"
    if len(time_s) > 1 and (last_s <= 0.0 or first_s >= duration_s):
        raise ProblemError(
            f"{told}, and the experiment lasts from 0 to {duration_s:g} s; allowed: times on the clock of "
            "the film, or a start_s that brings them there"
        )
    remarks = []
    if len(time_s) > 1 and max(first_s, duration_s - last_s) > UNCOVERED * duration_s:
        remarks.append(f"{told} of 0 to {duration_s:g} s; in the rest the drive stands still")
    if last_s > MOST_LONGER * duration_s:
        remarks.append(f"{told}, and the experiment lasts {duration_s:g} s: are they in s?")
    motion, more = waypoints(log.file, time_s, log.points_m, duration_s, log.rows, log.spread_m)
    return motion, remarks + more


def waypoints(
    file: Path, time_s: Floats, points_m: Floats, duration_s: float, rows: int, spread_m: float = 0.0
) -> tuple[dict[str, Any], list[str]]:
    """A motion of kind ``waypoints`` that starts at time 0, and by how much it misses a row at most.

    Args:
        file: Where the motion was measured.
        time_s: Times, rising (W,) [s]; those before 0 are left out.
        points_m: Places of the drive (W, 2) [m].
        duration_s: Where there are too many, those after it are left out [s].
        rows: Number of rows of the file.
        spread_m: By how much they miss the places at most [m].

    Raises:
        ProblemError: Waypoints cannot follow it.
    """
    first = np.array([np.interp(0.0, time_s, points_m[:, axis]) for axis in (0, 1)])
    later = time_s > 0.0
    time_s, points_m = np.append(0.0, time_s[later]), np.vstack([first, points_m[later]])
    error_m = spread_m
    if len(time_s) > MOST_WAYPOINTS:
        until = int(np.searchsorted(time_s, duration_s)) + 1
        kept, missed_m = thinned(time_s[:until], points_m[:until], MOST_WAYPOINTS)
        time_s, points_m, error_m = time_s[kept], points_m[kept], error_m + missed_m
    told = f"{file}: {len(time_s)} waypoints for its {rows} rows miss none by more than {error_m:.2g} m"
    if error_m > FARTHEST_M:
        raise ProblemError(f"{told}; allowed: {FARTHEST_M:g} m")
    x_m, y_m = points_m.T
    motion = {"kind": "waypoints", "time_s": time_s.tolist(), "x_m": x_m.tolist(), "y_m": y_m.tolist()}
    return motion, [told] if error_m > 0.0 else []


def thinned(time_s: Floats, points_m: Floats, most: int) -> tuple[list[int], float]:
    """Points between which straight lines miss the others least: their places, and by how much at most [m].

    The point that is missed most is kept next, as Ramer, Douglas and Peucker do, until none is missed.

    Args:
        time_s: Times, rising (W,) [s].
        points_m: Places (W, 2) [m].
        most: Most points that are kept.
    """

    def missed(first: int, last: int) -> tuple[float, int, int, int]:
        """Minus the greatest distance from the line between two points, its place, and theirs."""
        share = ((time_s[first : last + 1] - time_s[first]) / (time_s[last] - time_s[first]))[:, None]
        line = points_m[first] + share * (points_m[last] - points_m[first])
        away = np.abs(points_m[first : last + 1] - line).max(axis=1)
        return -float(away.max()), first + int(away.argmax()), first, last

    if len(time_s) <= most:
        return list(range(len(time_s))), 0.0
    kept = [0, len(time_s) - 1]
    waiting = [missed(*kept)]
    while len(kept) < most and waiting[0][0] < 0.0:
        _, at, first, last = heappop(waiting)
        kept.append(at)
        heappush(waiting, missed(first, at))
        heappush(waiting, missed(at, last))
    return sorted(kept), -waiting[0][0]


def drive_from_film(
    tracks: Tracks, film: FilmTable, part: str, start_m: Floats, duration_s: float, height_m: float | None
) -> tuple[dict[str, Any], list[str]]:
    """The drive's motion from a body part of the same film, and what there is to say of it.

    Where the camera's origin is unknown, it follows from the magnets in the first 0.1 s, in which
    the robot must be in the scene's start pose.

    Args:
        tracks: What the tracking found.
        film: How it was filmed.
        part: The body part on the drive magnet.
        start_m: Places of the magnets in the start pose (M, 2) [m].
        duration_s: Duration of the experiment [s].
        height_m: Height of the drive [m]; None takes the tracked one.

    Raises:
        ProblemError: The drive was found in no frame, or no magnet at the start.
    """
    time_s = film.time_s(tracks.frames)
    seen = tracks.sure(part, film.least_likelihood)
    if not seen.any():
        raise ProblemError(f"{tracks.file}: {part!r} has no likelihood of at least {film.least_likelihood:g}")
    points = film.points_m(tracks.part(part)[seen, :2])
    if isinstance(film.origin, str):
        points = points + _start_offset(tracks, film, start_m)
    if height_m is not None:
        points[:, 1] = height_m
    return waypoints(tracks.file, time_s[seen], points, duration_s, len(points))


def _start_offset(tracks: Tracks, film: FilmTable, start_m: Floats) -> Floats:
    """Start pose minus tracks in the first 0.1 s (2,) [m]."""
    time_s = film.time_s(tracks.frames)
    begun = (time_s >= 0.0) & (time_s <= START_SPAN_S)
    found = np.concatenate(
        [
            start_m[magnet]
            - film.points_m(tracks.part(part)[begun & tracks.sure(part, film.least_likelihood), :2])
            for magnet, part in enumerate(film.magnets)
            if part
        ]
    )
    if not len(found):
        raise ProblemError(
            f"{tracks.file}: no magnet is seen in the first {START_SPAN_S:g} s, so the drive's place is "
            "unknown; allowed: a start_s at which the robot is seen at rest, or origin = [x_px, y_px]"
        )
    return np.asarray(np.median(found, axis=0))
