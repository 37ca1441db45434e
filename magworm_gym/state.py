"""The state of a vector environment: all of it as bytes, and back."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import snapshot
from magworm_gym.arguments import SEED_LIMIT
from magworm_gym.bookkeeping import Bookkeeping
from magworm_gym.draws import generator_of
from magworm_gym.reset_options import furthest_start
from magworm_gym.snapshot import COUNT, FINITE, Limits
from magworm_gym.worlds import Worlds

TASK = "task_"
"""Before the names of a task's state."""


def pack(worlds: Worlds, random: np.random.Generator) -> bytes:
    """All that changes in time; `random` draws first seeds."""
    return snapshot.pack(fields(worlds, random))


def restore(worlds: Worlds, random: np.random.Generator, state: bytes) -> None:
    """Takes over what :func:`pack` returned.

    Raises:
        ValueError: The bytes are of something else; nothing is changed then.
    """
    given = snapshot.unpack(state, fields(worlds, random), _limits(worlds))
    autoreset = given["autoreset"].tobytes().decode(errors="replace")
    if autoreset != worlds.autoreset.value:
        raise ValueError(
            f"the state is of autoreset mode {autoreset!r}; this environment has {worlds.autoreset.value!r}"
        )
    generator = generator_of(given["random"].tobytes())
    with Bookkeeping() as books:
        worlds.batch.set_state(given["batch"].tobytes())
        books.begin()  # nothing fails from here on
        random.bit_generator.state = generator.bit_generator.state
        for name in worlds.episodes.arrays():
            setattr(worlds.episodes, name, given[name])
        worlds.task.state = {name: given[f"{TASK}{name}"] for name in worlds.task.state}


def fields(worlds: Worlds, random: np.random.Generator) -> dict[str, NDArray[Any]]:
    """All of it, by name; the mode of autoreset does not change, but decides what follows."""
    generator = json.dumps(random.bit_generator.state)
    return {
        **worlds.episodes.arrays(),
        **{f"{TASK}{name}": values for name, values in worlds.task.state.items()},
        "batch": np.frombuffer(worlds.batch.get_state(), np.uint8),
        "random": np.frombuffer(generator.encode(), np.uint8),
        "autoreset": np.frombuffer(worlds.autoreset.value.encode(), np.uint8),
    }


def _limits(worlds: Worlds) -> dict[str, Limits]:
    """What numbers may be."""
    option, furthest = worlds.task.goal_option, furthest_start(worlds.batch.scene.dimensions)
    return {
        "seeds": Limits(0, SEED_LIMIT - 1),
        "numbers": Limits(-1, COUNT.high),
        "elapsed_steps": COUNT,
        "starts": Limits(-furthest, furthest, missing=True),
        "goals": Limits(-option.limit, option.limit, missing=True) if option else FINITE,
    }
