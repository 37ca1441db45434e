"""Which robot each environment of a batch has: set by an option of a reset, drawn, or the scene's."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch
from magworm_gym.episodes import Episodes, Flags
from magworm_gym.randomise import Randomise
from magworm_gym.reset_options import ResetOptions


class Robots:
    """The robots of a batch, in force from the next reset of their environments on.

    Args:
        batch: The environments.
        randomise: How robots are drawn.
    """

    def __init__(self, batch: Batch, randomise: Randomise) -> None:
        self._batch = batch
        self._randomise = randomise
        magnets = np.arange(batch.scene.magnets)
        scenes = np.array([~np.isin(magnets, scene.removed) for scene in batch.scenes])
        self._whole = scenes[batch.scene_indices]

    @contextmanager
    def put_back(self) -> Iterator[None]:
        """Where the block is stopped or raises, the robots are put back as they were before it."""
        factors = {name: self._batch.parameter(name) for name in self._batch.parameter_names}
        present = self._batch.magnets_present()
        try:
            yield
        except BaseException:
            for name, values in factors.items():
                self._batch.set_parameter(name, values)
            self._batch.set_magnets_present(present)
            raise

    def ask(self, request: ResetOptions, episodes: Episodes) -> None:
        """Sets what the options of a reset ask for, until the next one; what they leave out is the scene's.

        Raises:
            ValueError: A robot that cannot be simulated.
        """
        mask, batch = request.mask, self._batch
        magnets = np.any(request.present >= 0.0, axis=1)
        episodes.take(mask, own_factors=~np.isnan(request.factors), own_magnets=magnets)
        for name, factors in zip(batch.parameter_names, request.factors.T, strict=True):
            wanted = np.where(np.isnan(factors), 1.0, factors)
            batch.set_parameter(name, np.where(mask, wanted, batch.parameter(name)))
        present = np.where(magnets[:, None], request.present == 1.0, self._whole)
        batch.set_magnets_present(np.where(mask[:, None], present, batch.magnets_present()))

    def draw(
        self, mask: Flags, seeds: NDArray[np.int64], numbers: NDArray[np.int64], episodes: Episodes
    ) -> None:
        """Draws robots for the environments of mask (N,), in the episodes (N,) of seeds (N,)."""
        batch, starting = self._batch, np.flatnonzero(mask)
        seeds, numbers = seeds[starting], numbers[starting]
        for name, drawn in self._randomise.factors(seeds, numbers).items():
            own = episodes.own_factors[starting, batch.parameter_names.index(name)]
            factors = batch.parameter(name)
            factors[starting] = np.where(own, factors[starting], drawn)
            batch.set_parameter(name, factors)
        if self._randomise.removed > 0.0:
            own, present = episodes.own_magnets[starting], batch.magnets_present()
            drawn_magnets = self._randomise.present(self._whole[starting], seeds, numbers)
            present[starting] = np.where(own[:, None], present[starting], drawn_magnets)
            batch.set_magnets_present(present)
