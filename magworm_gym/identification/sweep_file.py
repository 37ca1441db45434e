"""Sweeps as they stand in a problem file."""

from itertools import pairwise
from math import ceil
from typing import Annotated, Any, Literal

from msgspec import Meta, field

from magworm_gym._magworm import Batch, Scene
from magworm_gym.documents import Table
from magworm_gym.identification.experiment import edited_scene
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.paths import scene_paths
from magworm_gym.identification.sweep import Passes, Sweep

SPEEDS = "a list of speeds from 0.001 to 10, each greater than the one before"
BELT_REACH_M = 0.3
"""Distance up to which the magnets of a belt are simulated on both sides of a robot [m]."""

Length = Annotated[float, Meta(ge=0.0, le=1.0)]


class SweepTable(Table, frozen=True):
    """A sweep, or one for each of its ``robots``; the attributes are those of :class:`Sweep`."""

    name: Annotated[str, Meta(pattern=r"^[^./*]+$", description="a name without a dot, slash or asterisk")]
    speeds_m_s: Annotated[
        tuple[Annotated[float, Meta(ge=1e-3, le=10.0)], ...], Meta(min_length=1, description=SPEEDS)
    ]
    values: dict[str, Any] = field(default_factory=dict)
    robots: Annotated[
        tuple[dict[str, Any], ...], Meta(min_length=1, description="a list of tables of values")
    ] = ({},)
    factors: dict[str, Any] = field(default_factory=dict)
    direction: Literal["forward", "backward"] = "forward"
    ahead_m: Length = 0.05
    beyond_m: Length = 0.05
    settle_s: Annotated[float, Meta(ge=0.0, le=60.0)] = 0.25
    height_m: Annotated[float, Meta(ge=-1.0, le=1.0)] = -0.022
    belt: Passes | None = None

    def __post_init__(self) -> None:
        """Refuses speeds that do not rise."""
        if any(one >= other for one, other in pairwise(self.speeds_m_s)):
            raise ValueError(f"speeds_m_s is {list(self.speeds_m_s)}; allowed: {SPEEDS}")


def read_sweeps(table: SweepTable, where: str, base: Scene) -> list[Sweep]:
    """A sweep of each of the robots of a table that stands at a place of the file.

    Raises:
        ProblemError: A value that is not allowed.
    """
    shared = scene_paths(table.values, base)
    alone = table.robots == ({},)
    return [
        _sweep(
            table,
            where,
            table.name if alone else f"{table.name}-{at}",
            base,
            {**shared, **scene_paths(robot, base)},
        )
        for at, robot in enumerate(table.robots, start=1)
    ]


def _sweep(table: SweepTable, where: str, name: str, base: Scene, values: dict[str, Any]) -> Sweep:
    drive: dict[str, Any] = {
        "drive.motion": {"kind": "constant", "x_m": 0.0, "y_m": table.height_m, "speed_m_s": 0.0},
        "reset.vary": [],
    }
    if table.belt is not None:
        count = 2 * ceil(BELT_REACH_M / table.belt.pitch_m) + 1
        drive["drive.arrangement"] = {"kind": "belt", "pitch_m": table.belt.pitch_m, "count": count}
    scene = edited_scene(base, {**values, **drive}, f"{where}.values")
    if not scene.magnets:
        raise ProblemError(f"{where}: the scene has no body magnets; allowed: a scene with some")
    return Sweep(
        name,
        scene,
        table.speeds_m_s,
        _conditions(table.factors, f"{where}.factors", scene),
        table.direction == "backward",
        table.ahead_m,
        table.beyond_m,
        table.settle_s,
        table.belt,
        known=frozenset(values),
    )


def _conditions(factors: dict[str, Any], where: str, scene: Scene) -> tuple[dict[str, float], ...]:
    """Condition k has the k-th factor of each list; a number is the factor of all of them."""
    lists = {name: each if isinstance(each, list) else [each] for name, each in factors.items()}
    count = max(map(len, lists.values()), default=1)
    batch = Batch(scene, count, threads=1)
    for name, each in lists.items():
        if not each or not all(isinstance(factor, int | float) for factor in each):
            raise ProblemError(f"{where}.{name} is {each!r}; allowed: a factor or a list of factors")
        if len(each) not in (1, count):
            raise ProblemError(
                f"{where}.{name} has {len(each)} factors; allowed: 1, or {count} as another has"
            )
        if name not in batch.parameter_names:
            raise ProblemError(f"{where} is {name!r}; allowed: factors of {', '.join(batch.parameter_names)}")
        try:
            batch.set_parameter(name, [float(each[at % len(each)]) for at in range(count)])
        except ValueError as error:
            raise ProblemError(f"{where}: {error}") from error
    return tuple({name: float(each[at % len(each)]) for name, each in lists.items()} for at in range(count))
