"""One training for a processor time, and what its mean action then does."""

import importlib
import importlib.util
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines import Runner, fly
from magworm_gym.learning.compare.contest import FIRST_SEED
from magworm_gym.learning.learner import Learner
from magworm_gym.learning.sb3 import Sb3Learner
from magworm_gym.learning.settings import TrainingSettings, checked, merged, read_toml
from magworm_gym.learning.training import new_learner, place_of

GOALS_DEG = np.array([30.0, -30.0, 90.0, -90.0])
STARTS = 4
MEASURE_S = 10.0
LAST = 0.1
"""Part of the time at whose end exploration is measured."""
SETTINGS = read_toml(Path(__file__).parent / "settings.toml")
ALGORITHMS = [name for name in SETTINGS if name != "default"]
CONTRIBUTED = ("TQC", "CrossQ")


@dataclass(frozen=True)
class Run:
    """One training."""

    algorithm: str  # a name in the settings
    seed: int
    seconds: float  # processor time of the training [s]
    environments: int  # environments in the batch
    steps: int  # environment steps of all of them
    exploring_deg_s: float  # mean reward a second in the last tenth of the time, exploration included [°/s]
    turned_deg: float  # how far the mean action came towards its goals, mean of all [°]
    turned_share: float  # the same over the size of the goal
    lost: float  # part of the episodes in which the robot tipped over or broke


class MeanAction:
    """A learner as a controller that does not explore, whatever its actor is made of."""

    def __init__(self, learner: Sb3Learner) -> None:
        self._learner = learner

    def start(self, worms: Runner) -> None:
        """Nothing to prepare."""

    def act(self, worms: Runner) -> NDArray[np.float64]:
        """Actions (N, A)."""
        seen: Any = worms.observations
        if self._learner.normalisation is not None:
            seen = self._learner.normalisation.normalize_obs(seen)
        return np.asarray(self._learner.model.predict(seen, deterministic=True)[0], np.float64)


def installed(algorithm: str) -> bool:
    """Whether an algorithm can be run."""
    return algorithm not in CONTRIBUTED or importlib.util.find_spec("sb3_contrib") is not None


def settings_of(algorithm: str) -> TrainingSettings:
    """The settings of an algorithm; its learner is known from then on."""
    if algorithm in CONTRIBUTED:
        importlib.import_module("studies.learners.contributed")
    return checked(merged(SETTINGS["default"], SETTINGS[algorithm]), TrainingSettings)


def run(algorithm: str, seed: int, seconds: float) -> Run:
    """Trains one policy for a processor time and measures its mean action."""
    settings = settings_of(algorithm)
    place = place_of(settings, (), seed, threads=1)
    worms = place.native()
    with TemporaryDirectory() as folder:
        learner = new_learner(settings, place, Path(folder))
        steps, reward = train(learner, seconds)
    assert isinstance(learner, Sb3Learner), "all of them are"
    goals = np.repeat(GOALS_DEG, STARTS)
    flown = Runner(worms.scene, len(goals), task=worms.task)
    flight = fly(flown, MeanAction(learner), goals, FIRST_SEED + np.arange(len(goals)), MEASURE_S)
    turned = np.abs(goals) - np.abs(flight.left[-1])
    return Run(
        algorithm,
        seed,
        seconds,
        settings.num_envs,
        steps,
        exploring_deg_s=reward / worms.scene.control_step_s,
        turned_deg=float(turned.mean()),
        turned_share=float((turned / np.abs(goals)).mean()),
        lost=float(flight.lost.mean()),
    )


def train(learner: Learner, seconds: float) -> tuple[int, float]:
    """Rounds until the processor time is over [s]. Returns all steps, and the last reward of a step."""
    began, steps = time.process_time(), learner.begin()
    last_steps, last_reward, elapsed = 0, 0.0, 0.0
    while elapsed < seconds:
        done = learner.advance()
        steps, elapsed = steps + done.steps, time.process_time() - began
        if elapsed > (1.0 - LAST) * seconds:
            last_steps, last_reward = last_steps + done.steps, last_reward + done.reward
    return steps, last_reward / last_steps
