"""The acting part of a model of Stable-Baselines3 as a policy without it."""

from __future__ import annotations

from typing import Any

import numpy as np
import torch
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.running_mean_std import RunningMeanStd
from stable_baselines3.common.vec_env import VecNormalize

from magworm_gym.policy import Layer, Network, Normaliser, Policy, PolicyError
from magworm_gym.policy.fit import parts_of
from magworm_gym.vector_env import MagWormVectorEnv

ACTIVATIONS = {torch.nn.Tanh: "tanh", torch.nn.ReLU: "relu"}


def policy_of(
    model: BaseAlgorithm,
    normalisation: VecNormalize | None,
    worms: MagWormVectorEnv,
    *,
    environment_id: str,
    arguments: dict[str, Any],
    sentence: str,
    provenance: dict[str, Any],
) -> Policy:
    """What a model does without exploring.

    Args:
        model: PPO, SAC or another one with ``"MlpPolicy"`` and such an actor; with or without gSDE.
        normalisation: Running statistics of the observations that it was trained with; None without any.
        worms: The environments that it was trained in.
        environment_id: See :class:`~magworm_gym.policy.Policy`, as for what follows.
        arguments: Plain values.
        sentence: What it does.
        provenance: Plain values.

    Raises:
        PolicyError: The actor is no multilayer perceptron with tanh or relu.
    """
    observed = worms.observation_specification
    return Policy(
        network=network_of(model),
        normaliser=_normaliser(normalisation, sum(part.size for part in observed)),
        observation=parts_of(observed),
        action=parts_of(worms.batch.action_specification),
        stage_limits=worms.scene.stage_limits or {},
        environment_id=environment_id,
        arguments=arguments,
        scene=worms.scene,
        sentence=sentence,
        provenance=provenance,
    )


def network_of(model: BaseAlgorithm) -> Network:
    """The layers from observation to mean action. Raises PolicyError."""
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


def _normaliser(normalisation: VecNormalize | None, size: int) -> Normaliser:
    if normalisation is None:
        return Normaliser.none(size)
    statistics = normalisation.obs_rms
    assert isinstance(statistics, RunningMeanStd), "observations are one array"
    return Normaliser(
        statistics.mean.copy(), statistics.var.copy(), normalisation.epsilon, normalisation.clip_obs
    )
