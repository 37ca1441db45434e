"""Options of a reset, read and checked before anything changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import numbers, shown, whole

if TYPE_CHECKING:
    from magworm_gym._magworm import Batch
    from magworm_gym.tasks import GoalOption

START_LIMITS = {"x_m": 10.0, "height_m": 10.0, "angle_deg": 360.0}
"""Fields of the option `start`, each with its largest magnitude: those of a scene but for the shape."""

START_LIMITS_IN_SPACE = {**START_LIMITS, "z_m": 10.0, "yaw_deg": 360.0}
"""The same for a scene in space."""


def start_limits(dimensions: int) -> dict[str, float]:
    """Fields of the option `start` in a scene of 2 or 3 dimensions, each with its largest magnitude."""
    return START_LIMITS if dimensions == 2 else START_LIMITS_IN_SPACE


def furthest_start(dimensions: int) -> float:
    """The largest magnitude of a number of a start that :func:`read_options` has checked [m, rad]."""
    limits = start_limits(dimensions).items()
    return max(float(np.deg2rad(limit)) if name.endswith("_deg") else limit for name, limit in limits)


@dataclass(frozen=True)
class ResetOptions:
    """Checked options for N environments with M magnets each.

    Attributes:
        mask: (N,) environments to reset.
        start: (N, 3) pose: x [m], height [m], angle [rad]; in space (N, 5), with z [m], yaw [rad];
            None for the scene's.
        present: (N, M) False where a magnet is taken out; None for the scene's robot.
        factors: Factors (N,) of the scene's value, by name of the parameter.
        goal: (N, goal) goals of the task; None to draw them.
    """

    mask: NDArray[np.bool_]
    start: NDArray[np.float64] | None
    present: NDArray[np.bool_] | None
    factors: dict[str, NDArray[np.float64]]
    goal: NDArray[np.float64] | None


def read_options(
    options: Mapping[str, Any] | None,
    *,
    num_envs: int,
    magnets: int,
    parameter_names: Sequence[str],
    dimensions: int = 2,
    goal_option: GoalOption | None = None,
) -> ResetOptions:
    """Reads `options` without changing it.

    Raises:
        ValueError: Names the field, its value and what is allowed.
    """
    names = ["start", "removed", "parameters", "reset_mask"]
    if goal_option is not None:
        names.append(goal_option.name)
    options = _mapping("options", {} if options is None else options, names)
    goal = options.get(goal_option.name) if goal_option is not None else None
    mask = options.get("reset_mask")
    start = options.get("start")
    removed = options.get("removed")
    parameters = options.get("parameters")
    return ResetOptions(
        mask=np.ones(num_envs, np.bool_) if mask is None else _mask(mask, num_envs),
        start=None if start is None else _start(start, num_envs, start_limits(dimensions)),
        present=None if removed is None else _present(removed, num_envs, magnets),
        factors={} if parameters is None else _factors(parameters, num_envs, parameter_names),
        goal=None if goal_option is None or goal is None else _goal(goal, num_envs, goal_option),
    )


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


def _present(value: Any, num_envs: int, magnets: int) -> NDArray[np.bool_]:
    rows = _removed_rows(value, num_envs)
    present = np.ones((num_envs, magnets), np.bool_)
    for row, removed in zip(present, rows, strict=True):
        for magnet in removed:
            # bool is an int to Python, but a list of flags is not a list of magnets.
            index = whole(magnet)
            if index is None or not 0 <= index < magnets:
                raise ValueError(
                    f'options["removed"] has the magnet {shown(magnet)}; allowed: 0 to {magnets - 1}'
                )
            row[index] = False
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


def _factors(value: Any, num_envs: int, names: Sequence[str]) -> dict[str, NDArray[np.float64]]:
    fields = _mapping('options["parameters"]', value, names)
    return {
        name: _numbers(f'options["parameters"]["{name}"]', factor, num_envs)
        for name, factor in fields.items()
    }


def _of_scenes(batch: Batch) -> NDArray[np.bool_]:
    """The magnets that the scene of each environment has (N, M)."""
    present = np.ones((len(batch.scenes), batch.scene.magnets), np.bool_)
    for row, scene in zip(present, batch.scenes, strict=True):
        row[list(scene.removed)] = False
    return present[batch.scene_indices]


@contextmanager
def equipped(batch: Batch, request: ResetOptions) -> Iterator[None]:
    """Gives the environments of a reset their robots; takes them back where the block is stopped or raises.

    Raises:
        ValueError: A robot that cannot be simulated.
    """
    mask = request.mask
    before = {name: batch.parameter(name) for name in batch.parameter_names}
    present_before = batch.magnets_present()
    wanted = _of_scenes(batch) if request.present is None else request.present
    try:
        for name, factors in before.items():
            batch.set_parameter(name, np.where(mask, request.factors.get(name, 1.0), factors))
        batch.set_magnets_present(np.where(mask[:, None], wanted, present_before))
        yield
    except BaseException:
        for name, factors in before.items():
            batch.set_parameter(name, factors)
        batch.set_magnets_present(present_before)
        raise
