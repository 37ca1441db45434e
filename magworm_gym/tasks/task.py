"""What a task is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from copy import copy
from dataclasses import Field, dataclass, field, fields, is_dataclass
from numbers import Real
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene, Specification
from magworm_gym.arguments import shown
from magworm_gym.scene import AnyScene
from magworm_gym.spaces import Part

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

AnyTask = TypeVar("AnyTask", bound="Task")

MM_PER_M = 1000.0


@dataclass(frozen=True)
class GoalOption:
    """The option of a reset that sets a goal in place of a drawn one.

    Attributes:
        name: Key among the options.
        shape: Shape of one goal: () for a number, (2,) for a pair.
        limit: Largest magnitude of each number.
    """

    name: str
    shape: tuple[int, ...]
    limit: float

    @property
    def size(self) -> int:
        """How many numbers a goal has."""
        return int(np.prod(self.shape))


@dataclass(frozen=True)
class Goal:
    """A goal in the world, to be drawn: a heading [rad] or a point x, z [m] with its radius [m]."""

    heading_rad: float | None = None
    point_m: tuple[float, float] | None = None
    radius_m: float = 0.0


@dataclass(frozen=True)
class TaskResult:
    """What a task makes of one control step of N environments.

    Attributes:
        rewards: (N,).
        terminated: (N,) whether the task is over.
        success: (N,) whether an episode that ends here has reached its goal; None for tasks without one.
        infos: Arrays (N, …) that the infos get, by key.
    """

    rewards: Floats
    terminated: Flags
    success: Flags | None = None
    infos: dict[str, NDArray[Any]] = field(default_factory=dict)

    def check(self, num_envs: int) -> None:
        """Raises ValueError where an array is not one of N environments: NumPy would stretch some of them."""
        for name in ("rewards", "terminated", "success", *self.infos):
            values = self.infos[name] if name in self.infos else getattr(self, name)
            shape = np.shape(values)[:1] if name in self.infos else np.shape(values)
            if values is not None and shape != (num_envs,):
                raise ValueError(f"{name} of a task have shape {np.shape(values)}; allowed: ({num_envs},)")


class Simulation(Protocol):
    """What a task sees of its environments: a batch, or an instant of a rollout of one."""

    @property
    def num_envs(self) -> int:
        """Number of environments N."""

    def robot_poses(self) -> Floats:
        """As :meth:`Batch.robot_poses`."""

    def magnet_poses(self) -> Floats:
        """As :meth:`Batch.magnet_poses`."""

    def magnets_present(self) -> Flags:
        """As :meth:`Batch.magnets_present`."""


DEFINED: dict[str, type[Task]] = {}
"""Every class of tasks by its path, the latest where one was defined again, as in a notebook.

A path may come from a file that somebody else wrote, so it is looked up, and nothing is imported for it.
"""


def setting(default: float, low: float, high: float) -> Any:
    """A field of a task: a number that lies from `low` to `high`, as :class:`Task` checks."""
    return field(default=default, metadata={"low": low, "high": high})


class Task(ABC):
    """What is asked of N environments of a scene: goals, what is told of them, rewards and ends.

    A task is a dataclass whose fields are its settings, such as ``Turn(near_reward=0.2)``. Environments
    work on a copy of their own, which :meth:`prepare` has made ready for them. A subclass needs
    :meth:`evaluate`; one with goals or memory also :meth:`prepare`, :meth:`begin` and :meth:`observe`.

    Whatever changes in time stands in :attr:`state`, so that environments are saved and copied
    with it. Environments that the simulator broke are no concern of a task. NumPy's sines may differ in
    the last bit between strided and contiguous arrays: a task takes them of contiguous ones, so that an
    environment does the same whatever their number.

    Raises:
        ValueError: A :func:`setting` is out of range.
    """

    name: ClassVar[str]
    """Of the class, in small letters."""
    path: ClassVar[str]
    """Name of the class among all: ``"module:Class"``."""
    default_scene: ClassVar[AnyScene] = "paper-3"
    """Preset, path of a TOML file, or scene of environments that name none."""
    reward_unit: ClassVar[str] = "1"
    """What a reward is measured in."""
    needs_space: ClassVar[bool] = False
    """Whether scenes in the plane are refused."""
    goal_option: ClassVar[GoalOption | None] = None
    draws: ClassVar[int] = 0
    """How many random numbers a goal takes."""
    uses_magnet_poses: ClassVar[bool] = False
    """Whether it looks at the poses of single magnets."""

    parts: tuple[Part, ...] = ()
    """What the task appends to an observation."""
    state: dict[str, Floats]
    """What changes in time, by name; arrays (N, …)."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.name, cls.path = cls.__name__.lower(), f"{cls.__module__}:{cls.__qualname__}"
        DEFINED[cls.path] = cls

    def __post_init__(self) -> None:
        for one in self.settings():
            name, given = f"{one.name} of {type(self).__name__}", getattr(self, one.name)
            if one.metadata:
                setattr(self, one.name, _number(name, given, **one.metadata))

    @classmethod
    def settings(cls) -> tuple[Field[Any], ...]:
        """The fields of its dataclass."""
        return fields(cls) if is_dataclass(cls) else ()

    def arguments(self) -> dict[str, Any]:
        """What makes it again: the :attr:`path` of its class, and its settings by name."""
        return {"task_class": self.path, **{one.name: getattr(self, one.name) for one in self.settings()}}

    def prepared(self: AnyTask, scene: Scene, observed: Sequence[Specification], num_envs: int) -> AnyTask:
        """A copy for N environments of a scene, see :meth:`prepare`."""
        if self.needs_space and scene.dimensions != 3:
            raise ValueError(
                f"{type(self).__name__} needs a scene in space (dimensions = 3); {scene.name!r} is in the "
                "plane"
            )
        task = copy(self)
        task.state = {}
        task.prepare(scene, observed, num_envs)
        return task

    def prepare(self, scene: Scene, observed: Sequence[Specification], num_envs: int) -> None:  # noqa: B027
        """Sets :attr:`state`, and :attr:`parts` where they depend on the scene.

        Args:
            scene: The scene of every environment.
            observed: What the simulator puts into an observation.
            num_envs: Number of environments N.

        Raises:
            ValueError: The task cannot be done in this scene.
        """

    def begin(self, simulation: Simulation, mask: Flags, requested_goal: Floats, uniform: Floats) -> None:  # noqa: B027
        """Sets goals where episodes start, after the simulator has reset them.

        Args:
            simulation: The environments.
            mask: Those that start (N,).
            requested_goal: Goals given as option (N, goal), NaN for those to draw.
            uniform: Random numbers (N, draws), uniform in [0, 1).
        """

    @abstractmethod
    def evaluate(self, simulation: Simulation, progress_m: Floats, mask: Flags) -> TaskResult:
        """Rewards and ends of the control step just done.

        Args:
            simulation: The environments.
            progress_m: Progress towards the head in the step (N,) [m].
            mask: The environments that stepped (N,): the others keep their state, their result is not used.
        """

    def observe(self, simulation: Simulation) -> Floats:
        """What the task appends to the observations (N, size of :attr:`parts`)."""
        return np.zeros((simulation.num_envs, 0))

    def reset_infos(self) -> dict[str, NDArray[Any]]:
        """Arrays (N, …) that the infos of a reset get, by key."""
        return {}

    def copies(self: AnyTask, environments: NDArray[np.int64]) -> AnyTask:
        """A task of its own whose environment k is a copy of ``environments[k]`` (K,) of this one."""
        task = copy(self)
        task.state = {name: values[environments] for name, values in self.state.items()}
        return task

    def goal(self, i: int) -> Goal | None:
        """The goal of environment i, to be drawn; None without one."""
        return None


def _number(name: str, value: Any, low: float, high: float) -> float:
    number = float(value) if isinstance(value, Real) and not isinstance(value, bool) else np.nan
    if not low <= number <= high:
        raise ValueError(f"{name} is {shown(value)}; allowed: {low:g} to {high:g}")
    return number


def metres(part: Specification) -> float:
    """The unit of a length [m] that the simulator declares, such as "0.02 m"."""
    number, _, unit = part.unit.rpartition(" ")
    if unit != "m":
        raise ValueError(f"{part.name} is in {part.unit}, not a length")
    return float(number)


def named(parts: Sequence[Specification], name: str) -> Specification:
    """The part of that name."""
    return next(part for part in parts if part.name == name)
