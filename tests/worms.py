"""Worms that tests play with, and what they return."""

import pickle
from typing import Any

import numpy as np

from magworm_gym import MagWormVectorEnv


def crawl(num_envs: int = 3, **kwargs: Any) -> MagWormVectorEnv:
    """Environments of short episodes."""
    return MagWormVectorEnv(num_envs, **{"max_episode_steps": 5, "threads": 1, **kwargs})


def random_actions(env: Any, steps: int, seed: int = 0) -> np.ndarray:
    """Actions (steps, …)."""
    shape = (steps, *env.action_space.shape)
    return np.random.default_rng(seed).uniform(-1, 1, shape).astype(np.float32)


def play(env: Any, actions: np.ndarray) -> list[Any]:
    """What each step returns."""
    return [env.step(rows) for rows in actions]


def play_randomly(env: Any, steps: int, seed: int = 0) -> list[Any]:
    return play(env, random_actions(env, steps, seed))


def out_of_band(env: Any) -> Any:
    """As dask and joblib send it: arrays beside the pickle, in memory that nobody may write into."""
    buffers: list[pickle.PickleBuffer] = []
    pickled = pickle.dumps(env, protocol=5, buffer_callback=buffers.append)
    assert buffers
    return pickle.loads(pickled, buffers=[bytes(buffer.raw()) for buffer in buffers])


def told(infos: dict[str, Any]) -> dict[str, Any]:
    """Infos without the keys that hold for no environment: Gymnasium leaves these out."""
    kept = {key: values for key, values in infos.items() if np.any(infos[f"_{key.lstrip('_')}"])}
    return {key: told(values) if isinstance(values, dict) else values for key, values in kept.items()}
