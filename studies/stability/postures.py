"""What becomes of bent bodies: how long a knotted rod stays so, and postures while bodies spring open."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, record_scenes
from studies.kit.passes import MM
from studies.stability.axes import STEP
from studies.stability.cases import SHORT_S, Case, bent_start
from studies.stability.knots import closed, determinant
from studies.stability.starts import places

Numbers = tuple[float, ...]

SHOWN = (
    ("rod", "folded over itself"),
    ("rod", "rolled up in three turns"),
    ("rod", "knotted"),
    ("robot", "folded twice"),
    ("robot", "rolled up in two turns"),
    ("robot", "bent and twisted"),
)
"""Bent starts of the figure."""
WATCHED_MS = (0.0, 10.0, 50.0, 200.0, 600.0)
"""When the figure shows a body."""
WATCH_S = 0.01
MAGNET_MM = 6.303
KNOT_SAMPLE_S = 2e-3
TREFOIL = 3


@dataclass(frozen=True)
class Untying:
    """How long a knotted rod stays so."""

    case: Case  # its scheme and step
    until_s: float  # when it was last a trefoil [s]
    at_end: int  # determinant of its line at the end; 1 where it is none


@dataclass(frozen=True)
class Posture:
    """A bent start at some time."""

    body: str  # rod or robot
    start: str  # how it was bent
    time_ms: float  # when [ms]
    magnets: tuple[int, ...]  # elements that magnets fill
    x_mm: Numbers  # places of the nodes (N,) from head to tail [mm]
    y_mm: Numbers  # the same upwards
    z_mm: Numbers  # the same to the left; 0 in the plane


def untyings() -> list[Untying]:
    """The knotted rod under every scheme.

    Raises:
        RuntimeError: Its line is no trefoil at the start.
    """
    cases = bent_start("rod", "knotted", 3)
    durations = [case.duration_s for case in cases]
    records = record_scenes([case.scene() for case in cases], durations, KNOT_SAMPLE_S)
    return [_untying(case, record) for case, record in zip(cases, records, strict=True)]


def _untying(case: Case, record: Recording) -> Untying:
    knots = np.array([determinant(closed(line)) for line in record.nodes])
    if knots[0] != TREFOIL or determinant(record.nodes[0]) != TREFOIL:
        raise RuntimeError(f"the start is no trefoil: its determinant is {knots[0]}")
    until_s = float(record.time_s[np.flatnonzero(knots == TREFOIL)[-1]])
    return Untying(case, until_s, int(knots[-1]))


def postures() -> Iterator[Posture]:
    """Bent starts of the figure under `newmark` with a short step, in the plane if they lie there."""
    for body, start in SHOWN:
        case = Case(body, min(places(body, start)), "newmark", STEP.title, MM * SHORT_S, start=start)
        record = record_scenes([case.scene()], max(WATCHED_MS) / MM, WATCH_S)[0]
        lines = MM * np.pad(record.nodes, ((0, 0), (0, 0), (0, 3 - case.dimensions)))
        magnets = filled(lines[0], record.magnet_poses.shape[1])
        for time_ms in WATCHED_MS:
            line = lines[np.abs(record.time_s - time_ms / MM).argmin()]
            x, y, z = (tuple(places_mm) for places_mm in line.T.tolist())
            yield Posture(body, start, time_ms, magnets, x, y, z)


def filled(line_mm: NDArray[np.float64], count: int) -> tuple[int, ...]:
    """The elements that magnets fill: those of their length.

    Raises:
        RuntimeError: There are not as many as magnets.
    """
    lengths_mm = np.linalg.norm(np.diff(line_mm, axis=0), axis=1)
    found = np.flatnonzero(np.abs(lengths_mm - MAGNET_MM) < 1e-6)
    if len(found) != count:
        raise RuntimeError(f"{len(found)} elements are as long as a magnet; the body has {count}")
    return tuple(found.tolist())
