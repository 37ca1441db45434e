"""Proximal policy optimisation."""

from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta
from stable_baselines3 import PPO

from magworm_gym.learning.demonstration import family_of, teach
from magworm_gym.learning.learner import Share
from magworm_gym.learning.place import Place
from magworm_gym.learning.sb3 import Rate, Sb3Learner, Sb3Options, Size, Weight


class PpoOptions(Sb3Options, frozen=True, kw_only=True):
    """Arguments of ``stable_baselines3.PPO`` under their names, and a teacher.

    Attributes:
        teacher: Family of cycles of which the policy begins as a copy, see ``demonstration``; None for none.
    """

    teacher: Annotated[str | None, Meta(description="the name of a family of cycles")] = None
    n_steps: Size = 32
    batch_size: Annotated[int, Meta(ge=2, le=10**6)] = 2048
    n_epochs: Annotated[int, Meta(ge=1, le=1000)] = 5
    gae_lambda: Share = 0.95
    clip_range: Rate = 0.2
    target_kl: Rate | None = None
    ent_coef: Weight = 0.0
    vf_coef: Weight = 0.5
    max_grad_norm: Annotated[float, Meta(gt=0.0, le=1e6, description="a number above 0, up to 10^6")] = 0.5


class Ppo(Sb3Learner):
    """PPO of Stable-Baselines3."""

    Options = PpoOptions
    algorithm = PPO

    def __init__(self, place: Place, options: PpoOptions, steps: int, folder: Path) -> None:
        super().__init__(place, options, steps, folder)
        if options.teacher is not None:
            family_of(self)  # refuses what goes with no teacher, before anything has begun

    def begin(self) -> int:
        """Learns from the teacher, if there is one."""
        return super().begin() if self.options.teacher is None else teach(self)

    def _arguments(self) -> dict[str, Any]:
        arguments = super()._arguments()
        del arguments["teacher"]
        # A batch cannot be larger than what one rollout brings.
        rollout = self.options.n_steps * self.place.num_envs
        return {**arguments, "batch_size": min(self.options.batch_size, rollout)}
