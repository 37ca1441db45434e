"""Policies of random numbers."""

import itertools
from typing import Any

import numpy as np

from magworm_gym import MagWormVectorEnv, Policy
from magworm_gym.policy import Layer, Network, Normaliser

HIDDEN = (16, 16)


def drawn(worms: MagWormVectorEnv, **network: Any) -> Policy:
    """A policy of random numbers."""
    generator = np.random.default_rng(0)
    observed, acted = worms.single_observation_space.shape[0], worms.single_action_space.shape[0]
    sizes = (observed, *HIDDEN, acted)
    layers = [
        Layer(
            generator.normal(0.0, 0.5, (after, before)).astype(np.float32),
            generator.normal(0.0, 0.5, after).astype(np.float32),
        )
        for before, after in itertools.pairwise(sizes)
    ]
    mean, variance = generator.normal(size=observed), generator.uniform(0.5, 2.0, observed)
    return Policy.trained_in(
        worms,
        Network(layers, **network),
        Normaliser(mean, variance, 1e-8, 10.0),
        environment_id="MagWorm/Crawl-v0",
        arguments={"max_episode_steps": 7},
        sentence="Moves at random.",
        provenance={"trained": "not at all"},
    )
