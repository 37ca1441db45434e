"""Crawl ahead, as far as possible."""

import numpy as np

from magworm_gym.tasks.task import MM_PER_M, Flags, Floats, Seen, Task, Verdict


class Crawl(Task):
    """Reward: progress of the robot's centre towards its head within the control step [mm].

    There is no goal and no end: nothing terminates. In the plane or in space.
    """

    name = "crawl"
    default_scene = "paper-3"

    def judge(self, batch: Seen, progress_m: Floats, mask: Flags) -> Verdict:
        """See the class."""
        return Verdict(MM_PER_M * progress_m, np.zeros(len(mask), np.bool_))
