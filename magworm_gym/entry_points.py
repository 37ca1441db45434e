"""What Gymnasium calls to make the environments of an ID."""

from __future__ import annotations

import sys
from typing import Any, Generic, TypeVar

import gymnasium
from gymnasium import logger
from gymnasium.envs.registration import EnvSpec

from magworm_gym._magworm import Scene
from magworm_gym.env import MagWormEnv
from magworm_gym.registration import with_task
from magworm_gym.scene import episode_steps
from magworm_gym.specified import UNLIMITED
from magworm_gym.vector_env import MagWormVectorEnv

AnyEnv = TypeVar("AnyEnv", bound=MagWormEnv | MagWormVectorEnv)

NO_LIMIT = -1
"""What ``gymnasium.make`` is given for episodes without a limit."""

_warnings: set[str] = set()


class EntryPoint(Generic[AnyEnv]):
    """Makes environments of one kind with the task and the limit of an ID.

    Args:
        kind: Their class.
    """

    def __init__(self, kind: type[AnyEnv]) -> None:
        self._kind = kind
        self.metadata = kind.metadata

    def __call__(self, task_class: str | None = None, **arguments: Any) -> AnyEnv:
        """Makes them.

        Args:
            task_class: See :func:`with_task`.
            arguments: Arguments of the class and settings of the task.

        Raises:
            SceneError: The scene cannot be simulated.
            ValueError: An argument is unknown or out of range.
        """
        spec, given = _call_of_make()
        limit = given if given is not None else spec and spec.max_episode_steps
        if limit is not None:
            arguments["max_episode_steps"] = UNLIMITED if limit == NO_LIMIT else limit
        env = self._kind(**with_task(self._kind, task_class, arguments))
        # A specification of one's own, as read from JSON, has the limit that was meant.
        if spec and spec is gymnasium.registry.get(spec.id) and given is None:
            _warn_of_another_limit(env.scene, spec)
        return env


single = EntryPoint(MagWormEnv)
vector = EntryPoint(MagWormVectorEnv)


def _call_of_make() -> tuple[EnvSpec | None, int | None]:
    """Specification and ``max_episode_steps`` that ``gymnasium.make`` was called with.

    It tells the limit its wrapper alone. An environment that knows it ends the episode itself, in the same
    step, so that the last info says so; ``make_vec`` hands the limit on as an argument.
    """
    caller = sys._getframe(2)
    if caller.f_code is not gymnasium.make.__code__:
        return None, None
    return caller.f_locals["env_spec"], caller.f_locals["max_episode_steps"]


def _warn_of_another_limit(scene: Scene, spec: EnvSpec) -> None:
    """Says once that the limit of an ID counts, where the scene has another."""
    of_scene = episode_steps(scene)
    text = (
        f"{spec.id} ends episodes after {spec.max_episode_steps} control steps, scene {scene.name!r} after "
        f"{of_scene}: give max_episode_steps to say which you mean."
    )
    if spec.max_episode_steps not in (None, of_scene) and text not in _warnings:
        _warnings.add(text)
        logger.warn(text)
