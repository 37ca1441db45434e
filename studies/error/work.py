"""What a run costs: wall time on one core, and counters that do not depend on the machine."""

from dataclasses import dataclass

import numpy as np

from magworm_gym import Batch
from studies.error.case import Case
from studies.error.settings import Settings
from studies.kit.timing import timed
from studies.kit.words import number, thousands

ENVIRONMENTS = 32
LANES = {"double": 8, "single": 16}
SPREAD = 0.02
"""Stiffness differs by this part at most between the environments, so that lanes do not do the same."""

COSTS = ["robot-s/s of a core", "systems a step", "trials", "wrenches"]


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

    def cells(self) -> list[str]:
        """As :data:`COSTS` name them."""
        counters = [number(self.systems), number(self.trials), thousands(self.wrenches)]
        return [thousands(1.0 / self.wall_s), *counters]


def work(case: Case, settings: Settings, repetitions: int) -> Work:
    """Measures a case."""
    scene = case.scene(len(case.scenes) // 2, settings)
    count = ENVIRONMENTS
    batch = Batch(scene, count, threads=1)
    batch.set_parameter("stiffness", np.linspace(1.0 - SPREAD, 1.0 + SPREAD, count))
    everywhere, seeds = np.ones(count, np.bool_), np.arange(count, dtype=np.uint64)
    times = timed(
        lambda: batch.advance(case.duration_s),
        repetitions,
        prepare=lambda: batch.reset(everywhere, seeds, np.zeros(count, np.uint64)),
    )
    counters = batch.counters()
    robot_s = count * case.duration_s
    return Work(
        wall_s=times.median_s / robot_s,
        steps=1e3 / settings.step_ms,
        systems=counters["factorisations"] / counters["steps"],
        trials=counters["trials"] / counters["steps"],
        wrenches=LANES[settings.precision] * counters["wrenches"] / (repetitions * robot_s),
    )
