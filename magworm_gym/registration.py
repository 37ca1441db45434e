"""Entries of Gymnasium's registry: an ID chooses the task, and its limit of time counts."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from inspect import signature
from typing import Any

import gymnasium

from magworm_gym.arguments import choice, positive, shown
from magworm_gym.scene import AnyScene, episode_steps, load_scene
from magworm_gym.specified import plain
from magworm_gym.tasks import Crawl, Reach, Task, Turn
from magworm_gym.tasks.task import DEFINED
from magworm_gym.vector_env import MagWormVectorEnv

CRAWL_ID = "MagWorm/Crawl-v0"
"""Identifier of the crawling task."""
TURN_ID = "MagWorm/Turn-v1"
"""Identifier of the task of turning to a heading, in space, over two drive magnets."""
REACH_ID = "MagWorm/Reach-v1"
"""Identifier of the task of crawling to a point, in space, over two drive magnets."""
CUSTOM_ID = "MagWorm/Custom-v0"
"""Identifier that takes a task of one's own: ``make(CUSTOM_ID, task=MyTask(), scene="my.toml")``."""

EPISODE_STEPS = 500
"""Control steps of an episode, as the presets say; reading them would slow down every import."""

SINGLE, VECTOR = "magworm_gym.entry_points:single", "magworm_gym.entry_points:vector"


def register_environments() -> None:
    """Registers the environments of this package, once.

    Entry points are strings, so that a specification can be written as JSON and
    ``"magworm_gym:MagWorm/Crawl-v0"`` works in a process that has not imported the package.
    """
    if CUSTOM_ID in gymnasium.registry:
        return
    gymnasium.register(CUSTOM_ID, entry_point=SINGLE, vector_entry_point=VECTOR)
    register_task(CRAWL_ID, Crawl, max_episode_steps=EPISODE_STEPS)
    register_task(TURN_ID, Turn, max_episode_steps=EPISODE_STEPS)
    register_task(REACH_ID, Reach, max_episode_steps=EPISODE_STEPS)
    # The first versions had one drive magnet, over which a robot hardly turns.
    register_task("MagWorm/Turn-v0", Turn, scene="turn-3", max_episode_steps=EPISODE_STEPS)
    register_task("MagWorm/Reach-v0", Reach, scene="turn-3", max_episode_steps=EPISODE_STEPS)


def register_task(
    environment_id: str,
    task: type[Task],
    *,
    scene: AnyScene | None = None,
    max_episode_steps: int | None = None,
    **settings: Any,
) -> None:
    """Gives environments with a task of one's own an ID, for ``make``, ``make_vec`` and training.

    >>> register_task("Own/Turn-v0", Turn, near_reward=0.5)
    >>> worms = gymnasium.make_vec("Own/Turn-v0", num_envs=64, near_reward=1.0)

    Args:
        environment_id: ``"Name-v0"`` or ``"Namespace/Name-v0"``; one that is there is replaced.
        task: Class of the task, at the top of a module: its fields are arguments of the environments.
        scene: Preset, path of a TOML file, or scene; None takes the task's ``default_scene``.
        max_episode_steps: Control steps until truncation; None takes the scene's.
        settings: Settings of the task and arguments of the environments that differ from the defaults.

    Raises:
        ValueError: The task is no such class, or a setting is unknown or out of range.
        SceneError: The scene cannot be found or simulated.
    """
    if not (isinstance(task, type) and issubclass(task, Task)) or "<locals>" in task.__qualname__:
        raise ValueError(f"task is {shown(task)}; allowed: a class of tasks at the top of a module")
    settings = {name: plain(value) for name, value in settings.items()}
    with_task(MagWormVectorEnv, task.path, settings)
    own_scene = {} if scene is None else {"scene": plain(scene)}
    if max_episode_steps is None:
        max_episode_steps = episode_steps(load_scene(task.default_scene if scene is None else scene))
    gymnasium.registry.pop(environment_id, None)
    gymnasium.register(
        environment_id,
        entry_point=SINGLE,
        vector_entry_point=VECTOR,
        max_episode_steps=positive("max_episode_steps", max_episode_steps),
        kwargs={"task_class": task.path, **own_scene, **settings},
    )


def arguments_of(environment_id: str, **arguments: Any) -> dict[str, Any]:
    """Arguments of :class:`MagWormVectorEnv`, and of the Stable-Baselines3 adapter, that an ID stands for.

    >>> MagWormSB3VecEnv(64, **arguments_of("own_task:Own/Stop-v0", distance_m=0.01))

    Args:
        environment_id: As ``make`` takes it: of ``"module:ID"`` the module is imported first, to register it.
        arguments: Those of the ID, of its task and of the environments, that differ.

    Raises:
        ValueError: The module cannot be imported, or an argument is not allowed.
        gymnasium.error.Error: There is no such ID.
    """
    module, _, name = environment_id.rpartition(":")
    try:
        if module:
            import_module(module)
    except ModuleNotFoundError as error:
        raise ValueError(
            f"{environment_id!r} names the module {module!r}, which cannot be imported: {error}; "
            "allowed: one in a folder of PYTHONPATH"
        ) from error
    spec = gymnasium.spec(name)
    limit = {} if spec.max_episode_steps is None else {"max_episode_steps": spec.max_episode_steps}
    given = {**limit, **spec.kwargs, **arguments}
    return with_task(MagWormVectorEnv, given.pop("task_class", None), given)


def with_task(kind: type, task_class: str | None, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of a class of environments from those of an ID: the task with its settings, and the rest.

    Args:
        kind: The class.
        task_class: :attr:`Task.path`; None where ``task`` is among the arguments.
        arguments: Those of the class and, by name, the settings of the task.

    Raises:
        ValueError: An unknown class or argument, a task where the ID chooses it, none where it does not, or a
            setting out of range.
    """
    given, allowed = dict(arguments), set(signature(kind).parameters)
    if task_class is None:
        if not isinstance(given.get("task"), Task):
            raise ValueError(f"task is {shown(given.get('task'))}; allowed: a Task, such as tasks.Turn()")
    elif "task" in given:
        raise ValueError(
            f"task is {shown(given['task'])}; the ID chooses the task: {CUSTOM_ID} takes one of your own"
        )
    else:
        task = DEFINED[choice("task_class", task_class, tuple(DEFINED))]
        settings = {one.name for one in task.settings()}
        given["task"] = task(**{name: given.pop(name) for name in settings & given.keys()})
        allowed |= settings
    if unknown := given.keys() - allowed:
        names = ", ".join(sorted(allowed - {"task"}))
        raise ValueError(f"{min(unknown)} is no argument of this environment; allowed: {names}")
    return given
