"""A peer's runs: the largest stable step for each mesh, shorter ones, and their wall times."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from studies.error.peers.cantilever import DURATION_S, LENGTH_M
from studies.kit.passes import MM, Floats
from studies.kit.timing import timed as timed_runs

Track = Floats
"""Places of what is followed, along and up, shape (instants, points, 2) [mm]."""
Release = Callable[[int, float], Callable[[], Track]]
"""Of a number of elements and a step [s]: builds the rod, and returns what runs it for a second."""

REPETITIONS = 3
LONGER = 1.1
"""Factor between two steps that are tried."""
MOST_TRIALS = 60
FARTHEST_MM = 2.0 * MM * LENGTH_M
SAME = 0.02
"""Beyond its limit an explicit step is wrong by lengths; within it, halving it changes less of the length."""


@dataclass(frozen=True)
class Measured:
    """A run: elements, step [s], what it gave [mm] and median wall time [s]."""

    elements: int
    step_s: float
    track_mm: Track
    wall_s: float


@dataclass(frozen=True)
class Series:
    """Runs of all meshes with one scheme, and what a mesh finer than theirs gives [mm]."""

    scheme: str
    runs: Sequence[Measured]
    finest_mm: Track


def apart(track_mm: Track, other_mm: Track) -> float:
    """Root mean square distance over points and instants, over the length."""
    squared = np.sum((track_mm - other_mm) ** 2, axis=-1)
    return float(np.sqrt(squared.mean())) / (MM * LENGTH_M)


def measured(release: Release, meshes: Mapping[int, float]) -> list[Measured]:
    """The largest stable step for each mesh, given with a step hardly longer [s], then half of it."""
    runs = []
    for elements, limit_s in meshes.items():
        longest_s = longest_step_s(release, elements, limit_s)
        for step_s in (longest_s, 0.5 * longest_s):
            runs.append(Measured(elements, step_s, *timed(release, elements, step_s)))
    return runs


def longest_step_s(
    release: Release, elements: int, limit_s: float, instants: int = 1, same: float = SAME
) -> float:
    """The largest stable step of a mesh, within a tenth [s].

    Args:
        release: Of the peer.
        elements: Of the mesh.
        limit_s: A step hardly longer than it allows [s].
        instants: At which the run is looked at; its steps are a multiple of them.
        same: How little, over the length, halving it may change.

    Raises:
        RuntimeError: Nothing is stable within 300 times as many steps.
    """
    first = steps = instants * math.ceil(DURATION_S / (limit_s * instants))
    for _ in range(MOST_TRIALS):
        found = track(release, elements, steps)
        if np.abs(found).max() < FARTHEST_MM and apart(found, track(release, elements, 2 * steps)) < same:
            return DURATION_S / steps
        steps = instants * math.ceil(LONGER * steps / instants)
    raise RuntimeError(f"no step is stable: tried {first} to {steps} steps a second")


def finest(release: Release, elements: int, limit_s: float, instants: int = 1) -> Track:
    """What a mesh gives at half its longest step, untimed."""
    return track(release, elements, instants * math.ceil(2.0 * DURATION_S / (limit_s * instants)))


def track(release: Release, elements: int, steps: int) -> Track:
    """What the second gives in so many steps."""
    return release(elements, DURATION_S / steps)()


def timed(release: Release, elements: int, step_s: float) -> tuple[Track, float]:
    """What a run gives, and the median wall time of its steps [s]. The search for the step has warmed up."""
    runs = [release(elements, step_s) for _ in range(REPETITIONS)]
    tracks_mm: list[Track] = []
    times = timed_runs(lambda: tracks_mm.append(runs[len(tracks_mm)]()), REPETITIONS)
    return tracks_mm[-1], times.median_s
