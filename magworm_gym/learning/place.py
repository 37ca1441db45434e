"""Where a learner acts: an environment of Gymnasium's registry, in a batch."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

import gymnasium
from gymnasium.vector import AutoresetMode

from magworm_gym import MagWormVectorEnv
from magworm_gym.learning.command_line import UsageError
from magworm_gym.registration import arguments_of

if TYPE_CHECKING:
    from magworm_gym.sb3 import MagWormSB3VecEnv

# Seeds of environments follow each other, so those of two trainings must lie far apart.
SEED_STRIDE = 1_000_003
OWN = ("environment_id", "num_envs", "task", "threads", "autoreset_mode", "render_mode", "render_envs")
"""Arguments of an environment that a training sets, or that mean nothing to it."""

Made = TypeVar("Made")


@dataclass(frozen=True)
class Place:
    """An environment's identifier, and how to make a batch of it.

    Attributes:
        environment_id: Identifier in Gymnasium's registry.
        num_envs: Environments N in the batch.
        seed: Seed of the training.
        arguments: Arguments of the environment.
        threads: Most threads of the simulator; None for all cores. It does not change the results.
    """

    environment_id: str
    num_envs: int
    seed: int
    arguments: dict[str, Any] = field(default_factory=dict)
    threads: int | None = None

    @property
    def first_seed(self) -> int:
        """Seed of the first environment; those of the others follow."""
        return self.seed * SEED_STRIDE

    def native(self) -> MagWormVectorEnv:
        """The batch as a vector environment of Gymnasium, which resets in the step that ends an episode.

        Raises:
            UsageError: There is no such environment, or it does not take the arguments.
            SceneError: The scene cannot be simulated.
        """
        return self._made(MagWormVectorEnv, autoreset_mode=AutoresetMode.SAME_STEP)

    def for_stable_baselines(self) -> "MagWormSB3VecEnv":
        """The batch for Stable-Baselines3, seeded. Raises as :meth:`native` does."""
        from magworm_gym.sb3 import MagWormSB3VecEnv

        robots = self._made(MagWormSB3VecEnv)
        robots.worms.reset(seed=self.first_seed)  # the batch's own generator too: it is part of the state
        return robots

    def _made(self, kind: Callable[..., Made], **arguments: Any) -> Made:
        registered = gymnasium.registry.get(self.environment_id)
        if registered is None or not str(registered.vector_entry_point).startswith("magworm_gym."):
            known = [name for name in gymnasium.registry if name.startswith("MagWorm/")]
            raise UsageError(f"environment is {self.environment_id!r}; allowed: {', '.join(known)}")
        for name in self.arguments.keys() & set(OWN):
            raise UsageError(f"[environment] has {name!r}, which is not a setting of a training")
        try:
            given = arguments_of(self.environment_id, **self.arguments, **arguments)
            return kind(num_envs=self.num_envs, threads=self.threads, **given)
        except (ValueError, OSError, MemoryError) as error:
            raise UsageError(f"[environment] cannot be used: {error}") from None
