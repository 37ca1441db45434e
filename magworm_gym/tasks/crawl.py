"""Crawl ahead, as far as possible."""

from dataclasses import dataclass

import numpy as np

from magworm_gym.tasks.task import MM_PER_M, Flags, Floats, Simulation, Task, TaskResult


@dataclass
class Crawl(Task):
    """Crawl ahead, in the plane or in space.

    **Start**: the robot lies straight and at rest, its head towards −x, at the scene's start or that of the
    option ``start``; the stage stands anywhere within its limits about it, at random.

    **Reward**: progress of the robot's centre towards its head within the control step [mm].

    **Terminated**: never; there is no goal.
    """

    reward_unit = "mm"

    def evaluate(self, simulation: Simulation, progress_m: Floats, mask: Flags) -> TaskResult:
        """Rewards progress."""
        return TaskResult(MM_PER_M * progress_m, np.zeros(len(mask), np.bool_))
