"""Options of a reset, read and checked before anything changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import numbers, shown, whole

if TYPE_CHECKING:
    from magworm_gym._magworm import Batch
    from magworm_gym.tasks import GoalOption, Task

AnyOptions: TypeAlias = Mapping[str, Any] | Sequence[Mapping[str, Any] | None] | None
"""Options of a reset for all environments, or a mapping for each."""

MASK = "reset_mask"
"""The option that chooses the environments to reset."""

START_LIMITS = {"x_m": 10.0, "height_m": 10.0, "angle_deg": 360.0}
"""Fields of the option `start`, each with its largest magnitude: those of a scene but for the shape."""

START_LIMITS_IN_SPACE = {**START_LIMITS, "z_m": 10.0, "yaw_deg": 360.0}
"""The same for a scene in space."""


def start_limits(dimensions: int) -> dict[str, float]:
    """Fields of the option `start` in a scene of 2 or 3 dimensions, each with its largest magnitude."""
    return START_LIMITS if dimensions == 2 else START_LIMITS_IN_SPACE


def furthest_start(dimensions: int) -> float:
    """The largest magnitude of a number of a start that :meth:`Allowed.read` has checked [m, rad]."""
    limits = start_limits(dimensions).items()
    return max(float(np.deg2rad(limit)) if name.endswith("_deg") else limit for name, limit in limits)


@dataclass(frozen=True)
class ResetOptions:
    """Checked options for N environments with M magnets each; NaN where an option says nothing.

    Attributes:
        mask: (N,) environments to reset.
        start: (N, 3) pose: x [m], height [m], angle [rad]; in space (N, 5), with z [m], yaw [rad].
        present: (N, M) 1 where a magnet is in place, 0 where it is taken out.
        factors: (N, P) factors of the scene's values, in the order of ``parameter_names``.
        goal: (N, goal) goals of the task.
    """

    mask: NDArray[np.bool_]
    start: NDArray[np.float64]
    present: NDArray[np.float64]
    factors: NDArray[np.float64]
    goal: NDArray[np.float64]


@dataclass(frozen=True)
class Allowed:
    """What options of an environment may say.

    Attributes:
        magnets: Number of body magnets M, those that the scene lacks included.
        parameter_names: Names of the parameters.
        start: Fields of a start, each with its largest magnitude.
        goal: The option that sets a goal; None for a task without one.
    """

    magnets: int
    parameter_names: tuple[str, ...]
    start: Mapping[str, float]
    goal: GoalOption | None

    @classmethod
    def of(cls, batch: Batch, task: Task) -> Allowed:
        """Those of the environments of a batch."""
        scene = batch.scene
        return cls(scene.magnets, batch.parameter_names, start_limits(scene.dimensions), task.goal_option)

    @property
    def sizes(self) -> dict[str, int]:
        """How many numbers there are for an environment, by attribute of :class:`ResetOptions`."""
        return {
            "start": len(self.start),
            "present": self.magnets,
            "factors": len(self.parameter_names),
            "goal": 0 if self.goal is None else self.goal.size,
        }

    def read(self, options: AnyOptions, num_envs: int) -> ResetOptions:
        """Reads options for N environments, or one mapping for each of them, without changing them.

        Raises:
            ValueError: Names the field, its value and what is allowed.
        """
        if not isinstance(options, (list, tuple)):
            return self._read({} if options is None else options, num_envs, (MASK,))
        if len(options) != num_envs:
            raise ValueError(
                f"options is {shown(options)}; it must be a mapping, or one for each environment ({num_envs})"
            )
        each = [self._read({} if one is None else one, 1, ()) for one in options]
        rows = {f.name: np.concatenate([getattr(one, f.name) for one in each]) for f in fields(ResetOptions)}
        return ResetOptions(**rows)

    def _read(self, options: Any, num_envs: int, more: tuple[str, ...]) -> ResetOptions:
        goal_names = () if self.goal is None else (self.goal.name,)
        given = _mapping("options", options, ("start", "removed", "parameters", *more, *goal_names))
        asked = {name: value for name, value in given.items() if value is not None}
        rows = {name: np.full((num_envs, size), np.nan) for name, size in self.sizes.items()}
        if "start" in asked:
            rows["start"] = _start(asked["start"], num_envs, self.start)
        if "removed" in asked:
            rows["present"] = _present(asked["removed"], num_envs, self.magnets)
        if "parameters" in asked:
            rows["factors"] = _factors(asked["parameters"], num_envs, self.parameter_names)
        if self.goal is not None and self.goal.name in asked:
            rows["goal"] = _goal(asked[self.goal.name], num_envs, self.goal)
        mask = _mask(asked[MASK], num_envs) if MASK in asked else np.ones(num_envs, np.bool_)
        return ResetOptions(mask=mask, **rows)


def _mapping(field: str, value: Any, allowed: Sequence[str]) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise ValueError(
            f"{field} is {shown(value)}; it must be a mapping with keys among {', '.join(allowed)}"
        )
    for key in value:
        if key not in allowed:
            raise ValueError(f"{field} has the key {shown(key)}; allowed: {', '.join(allowed)}")
    return value


def _numbers(field: str, value: Any, num_envs: int, each: tuple[int, ...] = ()) -> NDArray[np.float64]:
    """Finite numbers of shape `each` per environment, from one of them or an array (N, *each)."""
    given = numbers(value)
    shape = (num_envs, *each)
    if given is None or given.shape not in (each, shape) or not np.isfinite(given).all():
        one = f"an array of shape {each} of finite numbers" if each else "a finite number"
        raise ValueError(f"{field} is {shown(value)}; it must be {one} or an array of shape {shape} of them")
    return np.broadcast_to(given, shape)


def _goal(value: Any, num_envs: int, option: GoalOption) -> NDArray[np.float64]:
    field = f'options["{option.name}"]'
    goals = _numbers(field, value, num_envs, option.shape)
    if (np.abs(goals) > option.limit).any():
        raise ValueError(f"{field} is {shown(value)}; allowed: -{option.limit:g} to {option.limit:g}")
    return goals.reshape(num_envs, option.size)


def _mask(value: Any, num_envs: int) -> NDArray[np.bool_]:
    if not isinstance(value, np.ndarray) or value.shape != (num_envs,) or value.dtype != np.bool_:
        raise ValueError(
            f'options["reset_mask"] is {shown(value)}; it must be a bool array of shape ({num_envs},)'
        )
    if not value.any():
        raise ValueError(
            'options["reset_mask"] is False everywhere; it must be True for one environment at least'
        )
    return value.copy()


def _start(value: Any, num_envs: int, limits: Mapping[str, float]) -> NDArray[np.float64]:
    fields = _mapping('options["start"]', value, tuple(limits))
    start = np.zeros((num_envs, len(limits)))
    for column, (name, limit) in enumerate(limits.items()):
        field = f'options["start"]["{name}"]'
        start[:, column] = _numbers(field, fields.get(name, 0.0), num_envs)
        if (np.abs(start[:, column]) > limit).any():
            raise ValueError(f"{field} is {shown(fields[name])}; allowed: -{limit:g} to {limit:g}")
        if name.endswith("_deg"):
            start[:, column] = np.deg2rad(start[:, column])
    return start


def _present(value: Any, num_envs: int, magnets: int) -> NDArray[np.float64]:
    rows = _removed_rows(value, num_envs)
    present = np.ones((num_envs, magnets))
    for row, removed in zip(present, rows, strict=True):
        for magnet in removed:
            # bool is an int to Python, but a list of flags is not a list of magnets.
            index = whole(magnet)
            if index is None or not 0 <= index < magnets:
                raise ValueError(
                    f'options["removed"] has the magnet {shown(magnet)}; allowed: 0 to {magnets - 1}'
                )
            row[index] = 0.0
    return present


def _removed_rows(value: Any, num_envs: int) -> list[Sequence[Any]]:
    """The magnets taken out of each environment: one sequence for all, or one per environment."""
    sequence = (list, tuple, np.ndarray)
    nested = isinstance(value, sequence) and [isinstance(part, sequence) for part in value]
    if nested is False or (any(nested) and not (all(nested) and len(value) == num_envs)):
        raise ValueError(
            f'options["removed"] is {shown(value)}; it must be a sequence of magnets, '
            f"or {num_envs} such sequences, one per environment"
        )
    return list(value) if any(nested) else [value] * num_envs


def _factors(value: Any, num_envs: int, names: Sequence[str]) -> NDArray[np.float64]:
    given = _mapping('options["parameters"]', value, names)
    factors = np.full((num_envs, len(names)), np.nan)
    for column, name in enumerate(names):
        if name in given:
            factors[:, column] = _numbers(f'options["parameters"]["{name}"]', given[name], num_envs)
    return factors
