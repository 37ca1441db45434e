"""What the episodes of N environments are at, beside the simulation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

Flags = NDArray[np.bool_]


@dataclass
class Episodes:
    """Episodes of N environments; all of it changes in time.

    Arrays are replaced, never written into: they may come out of a pickle that made them read-only.

    Attributes:
        seeds: (N,).
        numbers: (N,) -1: never reset.
        elapsed_steps: Control steps (N,).
        ended: Whether the episode has ended (N,).
        starts: Poses that an option asks for (N, columns); NaN: the scene's.
        goals: Goals that an option asks for (N, goal); NaN: drawn.
        own_factors: Whether an option has set the factor of a parameter (N, parameters).
        own_magnets: Whether an option has said which magnets are missing (N,).
    """

    seeds: NDArray[np.int64]
    numbers: NDArray[np.int64]
    elapsed_steps: NDArray[np.int64]
    ended: Flags
    starts: NDArray[np.float64]
    goals: NDArray[np.float64]
    own_factors: Flags
    own_magnets: Flags

    @classmethod
    def before_the_first(cls, num_envs: int, sizes: Mapping[str, int]) -> Episodes:
        """Those of environments that were never reset; `sizes` are those of the options of a reset."""
        return cls(
            seeds=np.zeros(num_envs, np.int64),
            numbers=np.full(num_envs, -1, np.int64),
            elapsed_steps=np.zeros(num_envs, np.int64),
            ended=np.zeros(num_envs, np.bool_),
            starts=np.full((num_envs, sizes["start"]), np.nan),
            goals=np.full((num_envs, sizes["goal"]), np.nan),
            own_factors=np.zeros((num_envs, sizes["factors"]), np.bool_),
            own_magnets=np.zeros(num_envs, np.bool_),
        )

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All of it, by name."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def take(self, mask: Flags, **given: NDArray[Any]) -> None:
        """Replaces the rows of mask in the arrays of these names."""
        for name, values in given.items():
            before = getattr(self, name)
            setattr(self, name, np.where(mask.reshape(-1, *(1,) * (before.ndim - 1)), values, before))

    def begin(self, mask: Flags, numbers: NDArray[np.int64]) -> None:
        """Starts episodes of these numbers (N,) in the environments of mask."""
        self.take(mask, numbers=numbers)
        self.elapsed_steps = np.where(mask, 0, self.elapsed_steps)
        self.ended = self.ended & ~mask

    def due_to_reset(self, autoreset: AutoresetMode) -> Flags:
        """The environments whose next step is a reset.

        Raises:
            ResetNeeded: One was never reset, or with ``DISABLED`` not since its episode ended.
        """
        never = np.flatnonzero(self.numbers < 0)
        if never.size:
            raise ResetNeeded(f"environment {never[0]} was never reset: call reset() before step()")
        if autoreset is AutoresetMode.DISABLED and self.ended.any():
            raise ResetNeeded(
                f"the episode of environment {np.flatnonzero(self.ended)[0]} has ended and autoreset is "
                "disabled: call reset(options={'reset_mask': terminated | truncated}) before step()"
            )
        return self.ended
