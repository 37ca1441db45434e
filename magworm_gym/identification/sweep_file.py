"""Sweeps as they stand in a problem file."""

from collections.abc import Mapping
from itertools import pairwise
from math import ceil
from typing import Any

from magworm_gym._magworm import Batch, Scene
from magworm_gym.identification.experiment import edited_scene
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.paths import scene_paths
from magworm_gym.identification.sweep import Passes, Sweep
from magworm_gym.identification.table import Table

SLOWEST_M_S, FASTEST_M_S = 1e-3, 10.0
BELT_REACH_M = 0.3
"""Distance up to which the magnets of a belt are simulated on both sides of a robot [m]."""


def read_sweeps(table: Table, base: Scene) -> list[Sweep]:
    """Reads one ``[[sweep]]``: a sweep, or one for each of its ``robots``.

    Args:
        table: Its table.
        base: The base scene.

    Raises:
        ProblemError: A value that is not allowed.
    """
    name = table.text("name")
    if not set(name).isdisjoint("./*"):
        raise table.refusal("name", name, "a name without a dot, slash or asterisk")
    shared = table.mapping("values")
    robots = table.take("robots", [{}])
    if not isinstance(robots, list) or not robots or not all(isinstance(robot, Mapping) for robot in robots):
        raise table.refusal("robots", robots, "a list of tables of values")
    names = [name] if robots == [{}] else [f"{name}-{at + 1}" for at in range(len(robots))]
    setting = _setting(table)
    sweeps = [
        _sweep(table, each, base, {**scene_paths(shared, base), **scene_paths(robot, base)}, setting)
        for each, robot in zip(names, robots, strict=True)
    ]
    table.done()
    return sweeps


def _setting(table: Table) -> dict[str, Any]:
    """What all robots of a sweep share."""
    return {
        "speeds_m_s": _speeds(table),
        "conditions": _conditions(table),
        "backward": table.choice("direction", "forward", ("forward", "backward")) == "backward",
        "ahead_m": table.number("ahead_m", 0.05, low=0.0, high=1.0),
        "beyond_m": table.number("beyond_m", 0.05, low=0.0, high=1.0),
        "settle_s": table.number("settle_s", 0.25, low=0.0, high=60.0),
        "height_m": table.number("height_m", -0.022, low=-1.0, high=1.0),
        "belt": _belt(table),
    }


def _speeds(table: Table) -> tuple[float, ...]:
    speeds = table.take("speeds_m_s")
    rising = isinstance(speeds, list) and len(speeds) > 0 and all(_speed(speed) for speed in speeds)
    if not rising or any(one >= other for one, other in pairwise(speeds)):
        allowed = (
            f"a list of speeds from {SLOWEST_M_S:g} to {FASTEST_M_S:g}, each greater than the one before"
        )
        raise table.refusal("speeds_m_s", speeds, allowed)
    return tuple(float(speed) for speed in speeds)


def _speed(value: object) -> bool:
    return (
        isinstance(value, int | float) and not isinstance(value, bool) and SLOWEST_M_S <= value <= FASTEST_M_S
    )


def _conditions(table: Table) -> tuple[dict[str, float], ...]:
    """Condition k has the k-th factor of each list; a number is the factor of all of them."""
    place = table.place("factors")
    factors = {
        name: each if isinstance(each, list) else [each] for name, each in table.mapping("factors").items()
    }
    for name, each in factors.items():
        if not each or not all(isinstance(factor, int | float) for factor in each):
            raise ProblemError(f"{place}.{name} is {each!r}; allowed: a factor or a list of factors")
    count = max((len(each) for each in factors.values()), default=1)
    for name, each in factors.items():
        if len(each) not in (1, count):
            raise ProblemError(
                f"{place}.{name} has {len(each)} factors; allowed: 1, or {count} as another has"
            )
    return tuple({name: float(each[at % len(each)]) for name, each in factors.items()} for at in range(count))


def _belt(table: Table) -> Passes | None:
    if not table.has("belt"):
        return None
    belt = Table(table.take("belt"), table.place("belt"))
    passes = Passes(
        pitch_m=belt.number("pitch_m", low=0.01, high=10.0),
        first=belt.whole("first_passes", 0, low=0, high=1000),
        count=belt.whole("passes", 1, low=1, high=1000),
    )
    belt.done()
    return passes


def _sweep(table: Table, name: str, base: Scene, values: dict[str, Any], setting: dict[str, Any]) -> Sweep:
    setting = dict(setting)
    height_m, belt = setting.pop("height_m"), setting["belt"]
    drive: dict[str, Any] = {
        "drive.motion": {"kind": "constant", "x_m": 0.0, "y_m": height_m, "speed_m_s": 0.0},
        "reset.vary": [],
    }
    if belt is not None:
        count = 2 * ceil(BELT_REACH_M / belt.pitch_m) + 1
        drive["drive.arrangement"] = {"kind": "belt", "pitch_m": belt.pitch_m, "count": count}
    scene = edited_scene(base, {**values, **drive}, table.place("values"))
    if not scene.magnets:
        raise ProblemError(f"{table.where}: the scene has no body magnets; allowed: a scene with some")
    _check_factors(table, scene, setting["conditions"])
    return Sweep(name=name, scene=scene, known=frozenset(values), **setting)


def _check_factors(table: Table, scene: Scene, conditions: tuple[dict[str, float], ...]) -> None:
    batch = Batch(scene, len(conditions), threads=1)
    for name in conditions[0]:
        if name not in batch.parameter_names:
            allowed = f"factors of {', '.join(batch.parameter_names)}"
            raise table.refusal("factors", name, allowed)
        try:
            batch.set_parameter(name, [condition[name] for condition in conditions])
        except ValueError as error:
            raise ProblemError(f"{table.place('factors')}: {error}") from error
