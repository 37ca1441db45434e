"""Crawl ahead, as far as possible."""

import numpy as np

from magworm_gym.tasks.task import MM_PER_M, Flags, Floats, Simulation, Task, TaskResult


class Crawl(Task):
    """Reward: progress of the robot's centre towards its head within the control step [mm].

    There is no goal and no end: nothing terminates. In the plane or in space.
    """

    name = "crawl"
    default_scene = "paper-3"

    def evaluate(self, simulation: Simulation, progress_m: Floats, mask: Flags) -> TaskResult:
        """See the class."""
        return TaskResult(MM_PER_M * progress_m, np.zeros(len(mask), np.bool_))
