"""A peer's runs: the largest stable step for each mesh, shorter ones, and their wall times."""

import math
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from studies.error.peers.cantilever import DURATION_S, LENGTH_M, MM

Tip = tuple[float, float]
Release = Callable[[int, float], Callable[[], Tip]]
"""Of a number of elements and a step [s]: builds the rod, and returns what runs it and gives its tip [mm]."""

REFINEMENTS = (1, 2)
REPETITIONS = 3
LONGER = 1.1
"""Factor between two steps that are tried."""
MOST_TRIALS = 60
FARTHEST_MM = 2.0 * MM * LENGTH_M
SAME_MM = 0.02 * MM * LENGTH_M
"""Beyond its limit an explicit step is wrong by lengths; within it, halving it changes little."""


@dataclass(frozen=True)
class Measured:
    """A run: elements, step [s], tip [mm] and median wall time [s]."""

    elements: int
    step_s: float
    tip_mm: Tip
    wall_s: float


def measured(release: Release, meshes: dict[int, float]) -> list[Measured]:
    """The largest stable step for each mesh, then half of it.

    Args:
        release: Of the peer.
        meshes: Numbers of elements, each with a step hardly longer than it allows [s],
            where the search begins.
    """
    runs = []
    for elements, limit_s in meshes.items():
        fewest = fewest_steps(partial(tip, release, elements), math.ceil(DURATION_S / limit_s))
        for refinement in REFINEMENTS:
            step_s = DURATION_S / (refinement * fewest)
            runs.append(Measured(elements, step_s, *timed(release, elements, step_s)))
    return runs


def finest(release: Release, elements: int, limit_s: float) -> Tip:
    """Tip of a mesh at half its longest step [mm], untimed."""
    return tip(release, elements, math.ceil(2.0 * DURATION_S / limit_s))


def tip(release: Release, elements: int, steps: int) -> Tip:
    """Tip [mm] after the second in so many steps."""
    return release(elements, DURATION_S / steps)()


def fewest_steps(tip_mm: Callable[[int], Tip], first: int) -> int:
    """The fewest steps that are stable, within a tenth.

    Args:
        tip_mm: Tip after so many steps.
        first: Steps to begin with.

    Raises:
        RuntimeError: Nothing is stable within 300 times as many.
    """
    steps = first
    for _ in range(MOST_TRIALS):
        found = tip_mm(steps)
        if math.hypot(*found) < FARTHEST_MM and math.dist(found, tip_mm(2 * steps)) < SAME_MM:
            return steps
        steps = math.ceil(LONGER * steps)
    raise RuntimeError(f"no step is stable: tried {first} to {steps} steps a second")


def timed(release: Release, elements: int, step_s: float) -> tuple[Tip, float]:
    """Tip [mm], and the median wall time of the steps alone [s]. The search for the step has warmed up."""
    walls = []
    for _ in range(REPETITIONS):
        run = release(elements, step_s)
        start = time.perf_counter()
        tip_mm = run()
        walls.append(time.perf_counter() - start)
    return tip_mm, statistics.median(walls)
