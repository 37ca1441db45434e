"""A trained policy as a controller."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Batch
from magworm_gym.policy import load_policy


class LearnedController:
    """Acts with the mean action of a trained policy.

    Args:
        folder: Folder ``policy`` that a training has left.
    """

    def __init__(self, folder: Path) -> None:
        self._policy = load_policy(folder)

    def start(self, batch: Batch) -> None:
        """Nothing to prepare: the policy has no memory."""

    def act(self, batch: Batch) -> NDArray[np.float64]:
        """Actions (N, A) for what the batch shows now."""
        return self.answer(batch.observe())

    def answer(self, observations: NDArray[np.float32]) -> NDArray[np.float64]:
        """Actions (N, A) for observations (N, O), those of the task included."""
        return self._policy(observations).astype(np.float64)
