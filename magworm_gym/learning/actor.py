"""The acting part of a model of Stable-Baselines3, in numbers that need no such library."""

from __future__ import annotations

from typing import Any

import numpy as np
import torch
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.running_mean_std import RunningMeanStd
from stable_baselines3.common.vec_env import VecNormalize

from magworm_gym.policy import Layer, Network, Normaliser, PolicyError

ACTIVATIONS = {torch.nn.Tanh: "tanh", torch.nn.ReLU: "relu"}


def network_of(model: BaseAlgorithm) -> Network:
    """The layers from observation to mean action.

    Args:
        model: PPO, SAC or another one with ``"MlpPolicy"`` and such an actor; with or without gSDE.

    Raises:
        PolicyError: The actor is no multilayer perceptron with tanh or relu.
    """
    modules = actor_modules(model)
    squashed = hasattr(model.policy, "actor") or model.policy.squash_output
    # An actor of SAC with gSDE cuts its last layer before the tanh.
    limit = modules.pop().max_val if isinstance(modules[-1], torch.nn.Hardtanh) else np.inf
    linear, between = modules[::2], modules[1::2]
    kinds = {type(module) for module in between}
    if (
        len(kinds) > 1
        or not kinds <= ACTIVATIONS.keys()
        or {type(one) for one in linear} != {torch.nn.Linear}
    ):
        raise PolicyError(
            f"the actor is {', '.join(type(module).__name__ for module in modules)}; allowed: linear layers "
            f"with {' or '.join(ACTIVATIONS.values())} between them"
        )
    activation = ACTIVATIONS[kinds.pop()] if kinds else "tanh"
    return Network([_layer(module) for module in linear], activation, squashed, limit)


def normaliser_of(normalisation: VecNormalize | None, size: int) -> Normaliser:
    """The running statistics of observations of a size O as they are now; None for a model without any."""
    if normalisation is None:
        return Normaliser.none(size)
    seen = normalisation.obs_rms
    assert isinstance(seen, RunningMeanStd), "observations are one array"
    return Normaliser(seen.mean.copy(), seen.var.copy(), normalisation.epsilon, normalisation.clip_obs)


def actor_modules(model: BaseAlgorithm) -> list[Any]:
    """The parts of an actor that compute, from observation to mean action."""
    policy: Any = model.policy
    if hasattr(policy, "actor"):
        trunk, head = policy.actor.latent_pi, policy.actor.mu
    else:
        trunk, head = policy.mlp_extractor.policy_net, policy.action_net
    chain = torch.nn.Sequential
    return [module for module in chain(trunk, head).modules() if not isinstance(module, chain)]


def _layer(module: Any) -> Layer:
    weight, bias = (values.detach().cpu().numpy().copy() for values in (module.weight, module.bias))
    return Layer(weight, bias)
