"""What a run costs: wall time on one core, and counters that do not depend on the machine."""

import statistics
import time
from dataclasses import dataclass

import numpy as np

from magworm_gym import Batch
from studies.error.case import Case
from studies.error.settings import Settings

ENVIRONMENTS = 32
LANES = {"double": 8, "single": 16}
SPREAD = 0.02
"""Stiffness differs by this part at most between the environments, so that lanes do not do the same."""


@dataclass(frozen=True)
class Work:
    """Of one simulated robot-second.

    Attributes:
        wall_s: Wall time on one core [s], eight environments in the lanes of a vector, sixteen in single
            precision.
        steps: Solver steps.
        systems: Linear systems, each of all lanes at once, per step of a block.
        trials: Trials of the contact solve, likewise.
        wrenches: Wrenches of a drive magnet on a body magnet, and of body magnets on each other.
    """

    wall_s: float
    steps: float
    systems: float
    trials: float
    wrenches: float


def work(case: Case, settings: Settings, repetitions: int) -> Work:
    """Measures a case."""
    scene = case.scene(len(case.scenes) // 2, settings)
    count = ENVIRONMENTS
    batch = Batch(scene, count, threads=1)
    batch.set_parameter("stiffness", np.linspace(1.0 - SPREAD, 1.0 + SPREAD, count))
    everywhere, seeds = np.ones(count, np.bool_), np.arange(count, dtype=np.uint64)
    walls = []
    for _ in range(repetitions):
        batch.reset(everywhere, seeds, np.zeros(count, np.uint64))
        start = time.perf_counter()
        batch.advance(case.duration_s)
        walls.append(time.perf_counter() - start)
    counters = batch.counters()
    robot_s = count * case.duration_s
    return Work(
        wall_s=statistics.median(walls) / robot_s,
        steps=1e3 / settings.step_ms,
        systems=counters["factorisations"] / counters["steps"],
        trials=counters["trials"] / counters["steps"],
        wrenches=LANES[settings.precision] * counters["wrenches"] / (repetitions * robot_s),
    )
