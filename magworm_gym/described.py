"""What environments tell of themselves, single ones as many."""

from __future__ import annotations

from magworm_gym._magworm import Batch, Scene
from magworm_gym.spaces import AnyPart, layout
from magworm_gym.tasks import Task
from magworm_gym.worlds import Worlds


class Described:
    """Scene, task, limit and observations of environments, N or one."""

    _worlds: Worlds

    @property
    def batch(self) -> Batch:
        """The simulation itself, with arrays of leading length N, to read poses and times from.

        Change it through `reset` and `step` only.
        """
        return self._worlds.batch

    @property
    def scene(self) -> Scene:
        """The scene of every environment; the first of several, whose shape all have."""
        return self.batch.scene

    @property
    def task(self) -> Task:
        """What is asked of the worms."""
        return self._worlds.task

    @property
    def max_episode_steps(self) -> int:
        """Control steps until an episode is truncated."""
        return self._worlds.max_episode_steps

    @property
    def observation_specification(self) -> tuple[AnyPart, ...]:
        """Name, unit, size and bounds of each part of an observation: the simulator's, then the task's."""
        return (*self.batch.observation_specification, *self.task.parts)

    @property
    def observation_layout(self) -> dict[str, slice]:
        """Where each named part stands in an observation."""
        return layout(self.observation_specification)
