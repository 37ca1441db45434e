"""Algorithms of Stable-Baselines3 as learners."""

from __future__ import annotations

from collections import deque
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
import torch
from msgspec import Meta, structs
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import configure
from stable_baselines3.common.off_policy_algorithm import OffPolicyAlgorithm
from stable_baselines3.common.running_mean_std import RunningMeanStd
from stable_baselines3.common.vec_env import VecEnv, VecNormalize

from magworm_gym.documents import Table
from magworm_gym.learning.actor import network_of, normaliser_of
from magworm_gym.learning.checkpoints import Tree
from magworm_gym.learning.command_line import UsageError
from magworm_gym.learning.learner import Learner, Round, Share
from magworm_gym.learning.place import Place
from magworm_gym.policy import Network, Normaliser

ACTIVATIONS = {"tanh": torch.nn.Tanh, "relu": torch.nn.ReLU}

Weight = Annotated[float, Meta(ge=0.0, le=1e6)]
Size = Annotated[int, Meta(ge=1, le=10**6)]
Rate = Annotated[float, Meta(gt=0.0, le=1.0, description="a number above 0, up to 1")]
Layers = Annotated[
    tuple[Annotated[int, Meta(ge=1, le=4096)], ...],
    Meta(min_length=1, max_length=8, description="one to eight whole numbers from 1 to 4096"),
]


class LearningRate(Table, frozen=True):
    """A learning rate that falls linearly over the training, from ``start`` to ``end``."""

    start: Rate = 1e-3
    end: Rate = 1e-4


class Sb3Options(Table, frozen=True, kw_only=True):
    """Settings of every algorithm; a subclass adds arguments of its own, under their names.

    Attributes:
        hidden: Sizes of hidden layers.
        activation: What follows each of them.
        log_std_init: Logarithm of the first exploration noise; None for the library's choice.
        normalise: Whether running statistics scale observations and rewards.
        learning_rate: Learning rate.
        gamma: Discount of a control step.
        use_sde: Whether noise depends on the state and lasts for several steps.
        sde_sample_freq: Control steps between two draws of such noise; -1 draws once in a rollout.
    """

    hidden: Layers = (64, 64)
    activation: Literal["tanh", "relu"] = "tanh"
    log_std_init: Annotated[float, Meta(ge=-20.0, le=2.0)] | None = None
    normalise: bool = False
    learning_rate: LearningRate = LearningRate()
    gamma: Share = 0.99
    use_sde: bool = False
    sde_sample_freq: Annotated[int, Meta(ge=-1, le=10**6)] = -1


class Sb3Learner(Learner):
    """A learner around an algorithm of Stable-Baselines3; a subclass names it and its options.

    A round is one call of ``learn``, a rollout and its update: between two of them everything that
    changes stands in the model, its environments and their statistics, and nothing in a loop.
    """

    Options = Sb3Options
    algorithm: ClassVar[type[BaseAlgorithm]]

    def __init__(self, place: Place, options: Any, steps: int, folder: Path) -> None:
        # The networks are small: a second thread costs more in waiting than it computes.
        torch.set_num_threads(1)
        self.place, self.options, self._steps = place, options, steps
        self.robots = place.for_stable_baselines()
        self.normalisation = VecNormalize(self.robots, gamma=options.gamma) if options.normalise else None
        self._folder = folder
        self._rewards = _Rewards()
        self.model: Any = None
        try:
            self.model = self._model(self.normalisation or self.robots)
        except (AssertionError, ValueError, MemoryError) as error:
            raise UsageError(f"[learner] cannot be used: {' '.join(str(error).split())}") from None
        self.model.action_space.seed(place.seed)

    def advance(self) -> Round:
        """A rollout and what is learned from it."""
        if not self.model._custom_logger:  # made late: it makes a folder
            self.model.set_logger(configure(str(self._folder), ["tensorboard"]))
        before, self._rewards.total = self.model.num_timesteps, 0.0
        try:
            self.model.learn(1, self._rewards, reset_num_timesteps=False)
        except ValueError as error:
            if "invalid values" not in str(error):
                raise
            raise UsageError(
                f"the training of seed {self.place.seed} diverged after {before} steps, its actions are not "
                "finite: a smaller learning_rate may help"
            ) from None
        return Round(self.model.num_timesteps - before, self._rewards.total)

    def actor(self) -> tuple[Network, Normaliser]:
        """The mean action."""
        size = sum(part.size for part in self.robots.worms.observation_specification)
        return network_of(self.model), normaliser_of(self.normalisation, size)

    def state(self) -> Tree:
        """Model with optimisers, statistics, environments with their episodes, generators, replay buffer."""
        model = self.model
        _, variables = model._get_torch_save_params()
        state: Tree = {
            "attributes": {name: getattr(model, name) for name in ATTRIBUTES},
            "parameters": model.get_parameters(),
            "variables": {name: getattr(model, name).detach() for name in variables},
            "actions": model.action_space.np_random.bit_generator.state,
            "episodes": [{"r": one["r"], "l": one["l"]} for one in model.ep_info_buffer],
            "successes": [*map(bool, model.ep_success_buffer)],
            "robots": self.robots.get_state(),
        }
        if self.normalisation is not None:
            state["normalisation"] = [vars(one) for one in statistics(self.normalisation)]
            state["returns"] = self.normalisation.returns
        if isinstance(model, OffPolicyAlgorithm):
            state["replay"] = _replay(model.replay_buffer)
        return state

    def restore(self, state: Tree) -> None:
        """See the base class."""
        model, buffer = self.model, getattr(self.model, "replay_buffer", None)
        self.robots.set_state(state["robots"])
        for name, value in state["attributes"].items():
            setattr(model, name, value)
        model.set_parameters({name: _parameters(kept) for name, kept in state["parameters"].items()})
        for name, value in _tensors(state["variables"]).items():
            getattr(model, name).data = value
        model.action_space.np_random.bit_generator.state = state["actions"]
        model.ep_info_buffer = deque(state["episodes"], model._stats_window_size)
        model.ep_success_buffer = deque(state["successes"], model._stats_window_size)
        if self.normalisation is not None:
            for one, kept in zip(statistics(self.normalisation), state["normalisation"], strict=True):
                vars(one).update(kept)
            self.normalisation.returns = state["returns"]
        if buffer is not None:
            _restore_replay(buffer, state["replay"])

    def _model(self, environments: VecEnv) -> BaseAlgorithm:
        activation, log_std = ACTIVATIONS[self.options.activation], self.options.log_std_init
        network: dict[str, Any] = {"net_arch": list(self.options.hidden), "activation_fn": activation}
        network |= {} if log_std is None else {"log_std_init": log_std}
        given = {"policy_kwargs": network, "device": "cpu", **self._arguments()}
        return self.algorithm("MlpPolicy", environments, learning_rate=lambda _: self._rate(), **given)

    def _arguments(self) -> dict[str, Any]:
        """Arguments of the algorithm."""
        own = structs.asdict(self.options)
        return {name: own[name] for name in own if name not in OWN}

    def _rate(self) -> float:
        """The learning rate now. That of ``learn`` would fall within each round."""
        done = min(self.model.num_timesteps / self._steps, 1.0) if self.model else 0.0
        rate = self.options.learning_rate
        return float(rate.start + done * (rate.end - rate.start))


OWN = ("hidden", "activation", "log_std_init", "normalise", "learning_rate")
"""Settings that are no arguments of an algorithm."""
ATTRIBUTES = (
    *("num_timesteps", "_n_updates", "_episode_num"),
    *("_last_obs", "_last_episode_starts", "_last_original_obs"),
)
"""What of a model changes with time, beside what is kept for itself."""


def statistics(normalisation: VecNormalize) -> tuple[RunningMeanStd, RunningMeanStd]:
    """Statistics of observations and of returns."""
    observations = normalisation.obs_rms
    assert isinstance(observations, RunningMeanStd), "observations are one array"
    return observations, normalisation.ret_rms


class _Rewards(BaseCallback):
    """Adds up rewards as the task gives them."""

    total = 0.0

    def _on_step(self) -> bool:
        environments: Any = self.training_env
        normalised = isinstance(environments, VecNormalize)
        rewards = environments.get_original_reward() if normalised else self.locals["rewards"]
        self.total += float(np.sum(rewards))
        return True


def _replay(buffer: Any) -> Tree:
    """The filled part of a replay buffer."""
    arrays = {name: value for name, value in vars(buffer).items() if isinstance(value, np.ndarray)}
    size = buffer.size()
    return {"full": buffer.full, "pos": buffer.pos, **{name: value[:size] for name, value in arrays.items()}}


def _restore_replay(buffer: Any, kept: Tree) -> None:
    for name, value in kept.items():
        if isinstance(value, np.ndarray):
            getattr(buffer, name)[: len(value)] = value
        else:
            setattr(buffer, name, value)


def _parameters(kept: Tree) -> Tree:
    """State of a module or an optimiser; JSON has made text of the numbers of an optimiser's parameters."""
    kept = _tensors(kept)
    if "param_groups" in kept:
        kept["state"] = {int(number): values for number, values in kept["state"].items()}
    return kept


def _tensors(tree: Any) -> Any:
    """A tree with tensors in place of arrays."""
    if isinstance(tree, dict):
        return {key: _tensors(value) for key, value in tree.items()}
    return torch.from_numpy(tree) if isinstance(tree, np.ndarray) else tree
