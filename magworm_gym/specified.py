"""Specifications of environments that can be written as JSON."""

from __future__ import annotations

import sys
from copy import copy
from dataclasses import asdict
from enum import Enum
from os import PathLike, fspath
from typing import Any

import numpy as np
from gymnasium.envs.registration import EnvSpec

from magworm_gym.described import Described
from magworm_gym.randomise import Randomise
from magworm_gym.tasks import Task

UNLIMITED = sys.maxsize
"""Control steps of an episode without a limit."""


class Specified(Described):
    """Environments whose ``spec`` tells their limit, and arguments as JSON can hold them."""

    _spec: EnvSpec | None = None

    @property
    def spec(self) -> EnvSpec | None:
        """What Gymnasium made them with; None where it did not."""
        return self._spec

    @spec.setter
    def spec(self, spec: EnvSpec | None) -> None:
        if spec is not None:
            spec = copy(spec)
            limit = self.max_episode_steps
            spec.max_episode_steps = None if limit == UNLIMITED else limit
            arguments = dict(spec.kwargs)
            if isinstance(task := arguments.pop("task", None), Task):
                arguments |= task.arguments()
            spec.kwargs = {name: plain(value) for name, value in arguments.items()}
        self._spec = spec


def plain(value: Any) -> Any:
    """Paths as text, numbers and arrays of NumPy as Python's, modes as their values; all else as it is."""
    if isinstance(value, Randomise):
        return asdict(value)
    if isinstance(value, PathLike):
        return fspath(value)
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    return [plain(each) for each in value] if isinstance(value, (list, tuple)) else value
