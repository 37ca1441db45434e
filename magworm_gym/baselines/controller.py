"""The two simplest controllers."""

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines.runner import Runner

Floats = NDArray[np.float64]


class Still:
    """Parks the drive far below the robot: what is left is what the robot does by itself."""

    def start(self, worms: Runner) -> None:
        """Nothing to prepare."""

    def act(self, worms: Runner) -> Floats:
        """Actions (N, A): centred, lowest, full speed."""
        parked = {"height": -1.0, "speed": 1.0}
        row = [parked.get(part.name, 0.0) for part in worms.batch.action_specification]
        return np.tile(row, (worms.num_envs, 1))


class UniformlyRandom:
    """Draws every action uniformly from [-1, 1].

    Args:
        seed: Seed of the draws.
    """

    def __init__(self, seed: int) -> None:
        self._generator = np.random.default_rng(seed)

    def start(self, worms: Runner) -> None:
        """Nothing to prepare; the draws go on."""

    def act(self, worms: Runner) -> Floats:
        """Actions (N, A)."""
        size = sum(part.size for part in worms.batch.action_specification)
        return self._generator.uniform(-1.0, 1.0, size=(worms.num_envs, size))
