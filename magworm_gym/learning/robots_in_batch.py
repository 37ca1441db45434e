"""A batch of robots that stay different through every reset."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Scene
from magworm_gym.learning.damage import factors_for_each, removed_for_each
from magworm_gym.learning.settings import TrainingSettings
from magworm_gym.sb3 import MagWormSB3VecEnv
from magworm_gym.tasks import task_of

# The stage belongs to the rig, not to the robot.
STAGE_PARAMETERS = "drive_"

TERMS = ("horizontal_force", "vertical_force", "torque", "mutual")
"""Factors that switch terms of the magnetic force."""


class VariedRobots(MagWormSB3VecEnv):
    """Environments in which each has its own robot for good.

    A policy trained on many robots at once has to cope with each of them: one batch holds more
    robots than it could meet one after the other.

    Args:
        settings: Settings of the training; gives the share of damaged robots and the spread of
            parameters.
        scene: Scene of all environments.
        seed: Seed of the parameters.
        threads: Most threads of the simulator; None for all cores.
    """

    def __init__(
        self, settings: TrainingSettings, scene: Scene, seed: int, threads: int | None = None
    ) -> None:
        super().__init__(
            settings.num_envs,
            scene,
            max_episode_steps=settings.episode_steps,
            threads=threads,
            task=task_of(settings.task),
        )
        self._robots: dict[str, Any] = {}
        if settings.removed_share > 0.0:
            self._robots["removed"] = removed_for_each(
                scene.magnets, scene.removed, settings.num_envs, settings.removed_share
            )
        if settings.parameter_spread > 0.0:
            # Terms of the magnetic force are no tolerances of a robot.
            names = [name for name in self.worms.batch.parameter_names if name not in TERMS]
            robot_names = tuple(name for name in names if not name.startswith(STAGE_PARAMETERS))
            self._robots["parameters"] = factors_for_each(
                robot_names, settings.num_envs, settings.parameter_spread, seed
            )

    def reset(self) -> NDArray[np.float32]:
        """Starts new episodes with the same robots. Returns observations (N, O)."""
        self.set_options(self._robots)
        return super().reset()
