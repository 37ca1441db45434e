"""Soft actor-critic."""

from typing import Annotated, Literal

from msgspec import Meta
from stable_baselines3 import SAC

from magworm_gym.learning.sb3 import Rate, Sb3Learner, Sb3Options, Size, Weight


class SacOptions(Sb3Options, frozen=True, kw_only=True):
    """Arguments of ``stable_baselines3.SAC`` under their names."""

    buffer_size: Annotated[int, Meta(ge=1, le=10**8)] = 400_000
    learning_starts: Annotated[int, Meta(ge=0, le=10**8)] = 6_400
    batch_size: Size = 1024
    tau: Rate = 0.01
    train_freq: Annotated[int, Meta(ge=1, le=10**4)] = 1
    gradient_steps: Annotated[int, Meta(ge=1, le=10**4)] = 4
    ent_coef: Annotated[Literal["auto"] | Weight, Meta(description='"auto", or a number from 0 to 10^6')] = (
        "auto"
    )


class Sac(Sb3Learner):
    """SAC of Stable-Baselines3."""

    Options = SacOptions
    algorithm = SAC
