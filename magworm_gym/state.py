"""The state of a vector environment: all of it as bytes, and back."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from magworm_gym import snapshot
from magworm_gym._magworm import Batch
from magworm_gym.arguments import SEED_LIMIT
from magworm_gym.bookkeeping import Bookkeeping
from magworm_gym.draws import generator_of
from magworm_gym.episodes import Episodes
from magworm_gym.reset_options import furthest_start
from magworm_gym.snapshot import COUNT, FINITE, Limits
from magworm_gym.tasks import Task

TASK = "task_"
"""Before the names of a task's state."""


@dataclass(frozen=True)
class State:
    """What changes in time of a vector environment.

    Attributes:
        batch: The simulation.
        episodes: Seeds, counts and what options ask for.
        task: What is asked of the worms.
        random: Draws first seeds.
        autoreset: Does not change, but decides what follows.
    """

    batch: Batch
    episodes: Episodes
    task: Task
    random: np.random.Generator
    autoreset: AutoresetMode

    def pack(self) -> bytes:
        """All of it."""
        return snapshot.pack(self.fields())

    def restore(self, state: bytes) -> None:
        """Takes over what :meth:`pack` returned.

        Raises:
            ValueError: The bytes are of something else; nothing is changed then.
        """
        fields = snapshot.unpack(state, self.fields(), self._limits())
        autoreset = fields["autoreset"].tobytes().decode(errors="replace")
        if autoreset != self.autoreset.value:
            raise ValueError(
                f"the state is of autoreset mode {autoreset!r}; this environment has {self.autoreset.value!r}"
            )
        random = generator_of(fields["random"].tobytes())
        with Bookkeeping() as books:
            self.batch.set_state(fields["batch"].tobytes())
            books.begin()  # nothing fails from here on
            self.random.bit_generator.state = random.bit_generator.state
            for name in self.episodes.arrays():
                setattr(self.episodes, name, fields[name])
            self.task.state = {name: fields[f"{TASK}{name}"] for name in self.task.state}

    def fields(self) -> dict[str, NDArray[Any]]:
        """All of it, by name."""
        random = json.dumps(self.random.bit_generator.state)
        return {
            **self.episodes.arrays(),
            **{f"{TASK}{name}": values for name, values in self.task.state.items()},
            "batch": np.frombuffer(self.batch.get_state(), np.uint8),
            "random": np.frombuffer(random.encode(), np.uint8),
            "autoreset": np.frombuffer(self.autoreset.value.encode(), np.uint8),
        }

    def _limits(self) -> dict[str, Limits]:
        """What numbers may be."""
        option, furthest = self.task.goal_option, furthest_start(self.batch.scene.dimensions)
        return {
            "seeds": Limits(0, SEED_LIMIT - 1),
            "numbers": Limits(-1, COUNT.high),
            "elapsed_steps": COUNT,
            "starts": Limits(-furthest, furthest, missing=True),
            "goals": Limits(-option.limit, option.limit, missing=True) if option else FINITE,
        }
