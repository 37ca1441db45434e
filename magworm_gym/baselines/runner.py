"""Episodes of robots under a controller: what every measurement, search and recording runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym.recording import Recording
from magworm_gym.tasks import Task, TaskResult
from magworm_gym.vector_env import MagWormVectorEnv

Floats = NDArray[np.float64]


class Controller(Protocol):
    """Gives actions to robots whose drive is controlled.

    Actions (N, A) lie in [-1, 1]; ``batch.action_specification`` declares them. In the plane: target along
    the robot relative to its centre, in units of the stage's reach; target height between the lowest and the
    highest; travel speed from 0 to the limit. In space also the target to the side, and yaw.
    """

    def start(self, worms: Runner) -> None:
        """Called once where an episode begins."""

    def act(self, worms: Runner) -> Floats:
        """Actions (N, A) of the next control step."""


@runtime_checkable
class OpenLoop(Controller, Protocol):
    """A controller that is blind to what the robot does, so that its actions are known beforehand."""

    def plan(self, worms: Runner, steps: int) -> Floats:
        """Actions (T, N, A) of the next control steps; the same that as many calls of ``act`` give."""


class Runner:
    """N robots of one scene, from the start of an episode on.

    Args:
        scene: Their scene; its drive follows a controller, or moves by itself.
        num_envs: Number of robots N.
        removed: Magnets taken out, counted from 0 at the head; None for those that the scene lacks.
        task: What is asked of them; None where nothing but the motion counts.
    """

    def __init__(
        self, scene: Scene, num_envs: int, removed: Sequence[int] | None = None, task: Task | None = None
    ) -> None:
        self._worms = MagWormVectorEnv(num_envs, scene, task=task) if task else None
        self.batch = Batch(scene, num_envs) if self._worms is None else self._worms.batch
        if removed is not None:
            present = ~np.isin(np.arange(scene.magnets), removed)
            self.batch.set_magnets_present(np.tile(present, (num_envs, 1)))
        self.going = np.ones(num_envs, np.bool_)
        """Robots whose task is not over and that are not broken (N,)."""
        self.lost = np.zeros(num_envs, np.bool_)
        """Robots that broke, or whose task ended without success (N,)."""

    @property
    def scene(self) -> Scene:
        """The scene of every robot."""
        return self.batch.scene

    @property
    def num_envs(self) -> int:
        """Number of robots N."""
        return self.batch.num_envs

    @property
    def env(self) -> MagWormVectorEnv:
        """The environment whose task is done: it knows task and layout, its episodes are not these."""
        assert self._worms is not None, "a runner without a task has no environment"
        return self._worms

    @property
    def declarer(self) -> MagWormVectorEnv | Batch:
        """What says which parts observations and actions have."""
        return self.batch if self._worms is None else self._worms

    @property
    def observations(self) -> NDArray[np.float32]:
        """What a policy sees now (N, O)."""
        simulated = self.batch.observe()
        if self._worms is None or not self._worms.task.parts:
            return simulated
        return np.concatenate([simulated, self._worms.task.observe(self.batch).astype(np.float32)], axis=1)

    def begin(
        self,
        seeds: ArrayLike,
        controller: Controller | None = None,
        start: Floats | None = None,
        goals: Floats | None = None,
    ) -> None:
        """Puts every robot to its start.

        Args:
            seeds: Seeds of the starts (N,).
            controller: Drives the stage; None for a scene whose drive is not controlled.
            start: Start poses (N, 3), in space (N, 5), as :meth:`Batch.reset` takes them; None: the scene's.
            goals: Goals (N, …) as the option of the task takes them.

        Raises:
            ValueError: The scene needs a controller, or takes none.
        """
        if self.scene.controlled != (controller is not None):
            raise ValueError("a scene with a controlled drive needs a controller, any other takes none")
        everyone = np.ones(self.num_envs, np.bool_)
        episodes = np.zeros(self.num_envs, np.uint64)
        self.batch.reset(everyone, np.asarray(seeds, np.uint64), episodes, start)
        self.going, self.lost = everyone, ~everyone
        if self._worms is not None:
            task, wanted = self._worms.task, np.empty((self.num_envs, 0))
            if goals is not None:
                wanted = np.asarray(goals, np.float64).reshape(self.num_envs, -1)
            task.begin(self.batch, everyone, wanted, np.zeros((self.num_envs, task.draws)))
        self._controller = controller
        if controller is not None:
            controller.start(self)

    def forward(self, steps: int) -> None:
        """Goes on for a number of control steps."""
        controller = self._controller
        if controller is None:
            self.batch.advance(steps * self.scene.control_step_s)
        elif steps and self._worms is None and isinstance(controller, OpenLoop):
            self.batch.rollout(controller.plan(self, steps))
        else:
            for _ in range(steps):
                _, progress_m, status = self.batch.step(controller.act(self))
                if self._worms is not None:
                    self._end(self._worms.task.evaluate(self.batch, progress_m, self.going), status != 0)

    def instants(self, steps: int) -> Iterator[int]:
        """Stops at the start and after each control step, until the last one or until nobody goes on."""
        for step in range(steps + 1):
            if step:
                self.forward(1)
            yield step
            if not self.going.any():
                return

    def steps(self, duration_s: float) -> int:
        """The whole number of control steps next to a time [s]."""
        return round(duration_s / self.scene.control_step_s)

    def _end(self, result: TaskResult, broken: NDArray[np.bool_]) -> None:
        failed = result.terminated if result.success is None else result.terminated & ~result.success
        self.lost = self.lost | (self.going & (broken | failed))
        self.going = self.going & ~(broken | result.terminated)


def record(
    worms: Runner, duration_s: float, environment: int = 0, watch: Callable[[], object] | None = None
) -> Recording:
    """Runs robots that have begun and keeps one of them, a control step apart.

    Args:
        worms: The robots.
        duration_s: Time to record [s]; shorter where nobody goes on.
        environment: Which robot to keep.
        watch: Called at each instant.
    """
    batch, i, kept = worms.batch, environment, []
    for _ in worms.instants(worms.steps(duration_s)):
        kept.append((batch.node_positions()[i], batch.magnet_poses()[i], batch.drive_positions()[i]))
        if watch is not None:
            watch()
    nodes, poses, drives = (np.array(values) for values in zip(*kept, strict=True))
    time_s = np.arange(len(nodes), dtype=np.float64) * worms.scene.control_step_s
    return Recording(time_s, nodes, poses, batch.magnets_present()[i], drives)
