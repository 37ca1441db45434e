"""A trained policy as a controller."""

from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray

from magworm_gym import Batch
from magworm_gym.learning.checkpoints import MODEL, NORMALISATION
from magworm_gym.learning.training import ALGORITHM_CLASSES


class LearnedController:
    """Acts with the mean action of a trained policy.

    Args:
        folder: Folder ``policy`` that a training has left.
        algorithm: "ppo" or "sac".
    """

    def __init__(self, folder: Path, algorithm: str) -> None:
        torch.set_num_threads(1)
        self._model = ALGORITHM_CLASSES[algorithm].load(folder / MODEL, device="cpu")
        self._mean: NDArray[np.float64] | float = 0.0
        self._deviation: NDArray[np.float64] | float = 1.0
        self._clip = np.inf
        if (folder / NORMALISATION).exists():
            with np.load(folder / NORMALISATION) as kept:
                self._mean = kept["mean"]
                self._deviation = np.sqrt(kept["var"] + kept["epsilon"])
                self._clip = float(kept["clip"])

    def start(self, batch: Batch) -> None:
        """Nothing to prepare: the policy has no memory."""

    def act(self, batch: Batch) -> NDArray[np.float64]:
        """Actions (N, A) for what the batch shows now."""
        return self.answer(batch.observe())

    def answer(self, observations: NDArray[np.float32]) -> NDArray[np.float64]:
        """Actions (N, A) for observations (N, O), those of the task included."""
        observations = (observations - self._mean) / self._deviation
        observations = np.clip(observations, -self._clip, self._clip).astype(np.float32)
        actions, _ = self._model.predict(observations, deterministic=True)
        return np.asarray(actions, dtype=np.float64)
