"""MagWorm: a batched simulator of soft worms that a moving magnet drives, as Gymnasium environments.

Importing this package needs numpy and Gymnasium only, and registers ``MagWorm/Crawl-v0``,
``MagWorm/Turn-v1``, ``MagWorm/Reach-v1`` and, for tasks of one's own, ``MagWorm/Custom-v0``:

>>> import gymnasium, magworm_gym
>>> worms = gymnasium.make_vec("MagWorm/Crawl-v0", num_envs=64)

The Stable-Baselines3 adapter is :mod:`magworm_gym.sb3`, the checker for vector environments
:mod:`magworm_gym.testing`, fields and wrenches of magnets :mod:`magworm_gym.magnet`.
"""

from magworm_gym._magworm import PRESETS, Batch, Scene, SceneError, __version__
from magworm_gym.env import MagWormEnv
from magworm_gym.policy import Policy, PolicyError, load_policy, policies, save_policy
from magworm_gym.randomise import Randomise
from magworm_gym.recording import Recording, record_scenes
from magworm_gym.registration import (
    CRAWL_ID,
    CUSTOM_ID,
    REACH_ID,
    TURN_ID,
    arguments_of,
    register_environments,
    register_task,
)
from magworm_gym.rollout import Rollout
from magworm_gym.scene import load_scene
from magworm_gym.tasks import Task
from magworm_gym.vector_env import MagWormVectorEnv

__all__ = [
    "CRAWL_ID",
    "CUSTOM_ID",
    "PRESETS",
    "REACH_ID",
    "TURN_ID",
    "Batch",
    "MagWormEnv",
    "MagWormVectorEnv",
    "Policy",
    "PolicyError",
    "Randomise",
    "Recording",
    "Rollout",
    "Scene",
    "SceneError",
    "Task",
    "__version__",
    "arguments_of",
    "load_policy",
    "load_scene",
    "policies",
    "record_scenes",
    "register_task",
    "save_policy",
]

register_environments()
