"""The environment's share of the wall time of PPO, beside the trainer's own ceiling.

Trains a few rollouts of Stable-Baselines3's PPO with 256 environments and the settings of
``training/configs/ppo.toml``, through the adapter :mod:`magworm_gym.sb3`; the time in the environment's steps
is taken apart. The ceiling is an environment with the same spaces that does nothing.
"""

import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Batch, Scene
from magworm_gym.learning.place import Place
from magworm_gym.learning.settings import read_settings
from magworm_gym.learning.training import new_learner
from magworm_gym.sb3 import MagWormSB3VecEnv
from magworm_gym.tasks import TaskName
from studies.kit.study import ROOT

SETTINGS = ROOT / "training" / "configs" / "ppo.toml"
ENVIRONMENTS = 256
ROLLOUTS = 6
AIM = 0.1
"""Largest share that is wanted."""


class Timed(MagWormSB3VecEnv):
    """Adds up the wall time of its steps."""

    seconds = 0.0

    def step_wait(self) -> Any:
        """See the base class."""
        start = time.perf_counter()
        answer = super().step_wait()
        self.seconds += time.perf_counter() - start
        return answer


class Idle(Timed):
    """The same spaces, and nothing else: what is left is the trainer."""

    def reset(self) -> NDArray[np.float32]:
        """See the base class."""
        self._first = super().reset()
        return self._first

    def step_wait(self) -> Any:
        """Zeros."""
        count = self.num_envs
        nothing: list[dict[str, Any]] = [{} for _ in range(count)]
        observations = np.zeros_like(self._first)
        return observations, np.zeros(count, np.float32), np.zeros(count, np.bool_), nothing


@dataclass(frozen=True)
class TimedPlace(Place):
    """A place of environments that are timed."""

    kind: type[Timed] = Timed

    def for_stable_baselines(self) -> Timed:
        """See the base class."""
        return self._made(self.kind)


class Replayed:
    """A batch whose steps take no time: each gives the answer of the first."""

    def __init__(self, batch: Batch) -> None:
        size = sum(part.size for part in batch.action_specification)
        self._batch, self._answer = batch, batch.step(np.zeros((batch.num_envs, size)))

    def step(self, actions: NDArray[np.float64]) -> Any:
        """The answer."""
        return self._answer

    def __getattr__(self, name: str) -> Any:
        return getattr(self._batch, name)


@dataclass(frozen=True)
class Case:
    """A task, the solver's step [ms] and precision."""

    task: TaskName
    step_ms: float
    precision: str = "double"

    @property
    def environment_id(self) -> str:
        """In Gymnasium's registry."""
        return {"crawl": "MagWorm/Crawl-v0", "turn": "MagWorm/Turn-v1"}[self.task]

    @property
    def scene(self) -> Scene:
        """The preset of the task with them."""
        values = {"solver.step_s": self.step_ms / 1e3, "solver.precision": self.precision}
        return Scene.preset({"crawl": "paper-3", "turn": "turn-3"}[self.task]).with_values(values)


CASES = (
    Case("crawl", 2.0),
    Case("crawl", 5.0),
    Case("crawl", 5.0, "single"),
    Case("turn", 2.0),
    Case("turn", 2.0, "single"),
)


@dataclass(frozen=True)
class Share:
    """What a training took.

    Attributes:
        case: The environment.
        per_second: Environment steps per second of the training.
        environment: Environment steps per second of the environment alone, within the training.
        share: Part of the wall time within the environment's steps.
        ceiling: Environment steps per second of the training with an environment that does nothing.
        python_s: Time of adapter and vector environment around the simulator in a step of all [s].
    """

    case: Case
    per_second: float
    environment: float
    share: float
    ceiling: float
    python_s: float


def share(case: Case) -> Share:
    """Trains with the environment and with one that does nothing."""
    steps, wall_s, inside_s = trained(Timed, case)
    idle_steps, idle_s, _ = trained(Idle, case)
    ceiling = idle_steps / idle_s
    return Share(case, steps / wall_s, steps / inside_s, inside_s / wall_s, ceiling, around_s(case))


def trained(kind: type[Timed], case: Case) -> tuple[int, float, float]:
    """Environment steps, wall time and the part of it within steps [s], after a rollout to warm up."""
    settings = read_settings(SETTINGS, "MagWorm/Crawl-v0", {})
    arguments = {**settings.environment, "scene": case.scene}
    place = TimedPlace(case.environment_id, ENVIRONMENTS, 0, arguments, kind=kind)
    with TemporaryDirectory() as folder:
        learner: Any = new_learner(settings, place, Path(folder))
        learner.advance()
        learner.robots.seconds, start = 0.0, time.perf_counter()
        steps = sum(learner.advance().steps for _ in range(ROLLOUTS))
        return steps, time.perf_counter() - start, learner.robots.seconds


def around_s(case: Case) -> float:
    """Median time of a step in which no episode ends, less that of the simulator [s]."""
    environments = Timed(ENVIRONMENTS, case.scene, task=case.task)
    environments.reset()
    environments.worms._worlds.batch = Replayed(environments.worms.batch)  # type: ignore[assignment]
    actions = np.zeros_like(environments.worms.action_space.sample())
    times = []
    for _ in range(environments.worms.max_episode_steps - 1):
        environments.seconds = 0.0
        environments.step(actions)
        times.append(environments.seconds)
    return float(np.median(times))
