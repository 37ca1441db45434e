"""Random numbers that a process draws for all: their seed, their states."""

import random
from typing import Any

import numpy as np
import torch

# The global generator is the one that libraries of learning draw from.
# ruff: noqa: NPY002


def seed_all(seed: int) -> None:
    """Seeds torch, NumPy's global generator and ``random``."""
    random.seed(seed)
    np.random.seed(seed)
    torch.manual_seed(seed)


def random_states() -> dict[str, Any]:
    """Their states, as plain values and arrays."""
    name, keys, *position = np.random.get_state()
    version, words, gauss = random.getstate()
    return {
        "torch": torch.get_rng_state(),
        "numpy": [name, keys, *position],
        "python": [version, list(words), gauss],
    }


def set_random_states(states: dict[str, Any]) -> None:
    """Goes on from such states."""
    version, words, gauss = states["python"]
    random.setstate((version, tuple(words), gauss))
    np.random.set_state(tuple(states["numpy"]))
    torch.set_rng_state(torch.from_numpy(states["torch"]))
