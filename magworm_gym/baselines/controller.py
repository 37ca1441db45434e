"""What a controller is, and the two simplest ones."""

from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch

Floats = NDArray[np.float64]


class Controller(Protocol):
    """Gives actions to a batch whose drive is controlled.

    Actions (N, A) lie in [-1, 1]; ``batch.action_specification`` declares them. In the plane:
    target along the robot relative to its centre, in units of the stage's reach; target
    height between the lowest and the highest; travel speed from 0 to the limit.
    """

    def start(self, batch: Batch) -> None:
        """Called once after each reset of the whole batch."""

    def act(self, batch: Batch) -> Floats:
        """Actions (N, A) of the next control step."""


@runtime_checkable
class OpenLoop(Controller, Protocol):
    """A controller that is blind to what the robot does, so that its actions are known beforehand."""

    def plan(self, batch: Batch, steps: int) -> Floats:
        """Actions (T, N, A) of the next control steps; the same that as many calls of ``act`` give."""


class Still:
    """Parks the drive far below the robot: what is left is what the robot does by itself."""

    def start(self, batch: Batch) -> None:
        """Nothing to prepare."""

    def act(self, batch: Batch) -> Floats:
        """Actions (N, A): centred, lowest, full speed."""
        parked = {"height": -1.0, "speed": 1.0}
        row = [parked.get(part.name, 0.0) for part in batch.action_specification]
        return np.tile(row, (batch.num_envs, 1))


class UniformlyRandom:
    """Draws every action uniformly from [-1, 1].

    Args:
        seed: Seed of the draws.
    """

    def __init__(self, seed: int) -> None:
        self._generator = np.random.default_rng(seed)

    def start(self, batch: Batch) -> None:
        """Nothing to prepare; the draws go on."""

    def act(self, batch: Batch) -> Floats:
        """Actions (N, A)."""
        size = sum(part.size for part in batch.action_specification)
        return self._generator.uniform(-1.0, 1.0, size=(batch.num_envs, size))
