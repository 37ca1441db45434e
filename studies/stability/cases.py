"""Cases of the sweeps and what became of them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from magworm_gym import Recording, Scene, SceneError, record_scenes
from studies.kit.passes import MM
from studies.kit.words import plain
from studies.stability.axes import ALONE, AXES, INSIDE, LONGER, STEP, Axis, Changes, base_scene
from studies.stability.starts import STARTS, places, starting

INTEGRATORS = ("newmark", "euler", "explicit")
STEP_S = {"newmark": 2e-3, "euler": 2e-3, "explicit": 4e-6}
"""Where it is not what is swept: that of the presets, and one that the explicit scheme can take."""
SHORT_S = 2e-4
"""Ours: a step for what springs open fast."""
EXPLICIT_S = {("rod", 2): 4e-6, ("rod", 3): 4e-6, ("robot", 2): 4e-6, ("robot", 3): 5e-7}
"""Ours: steps of bent bodies, below their limits."""
DURATION_S = {("rod", "explicit"): 0.1, ("robot", "explicit"): 0.05}
"""Ours: how long explicit cases run; their steps are hundreds of times shorter."""
LONG_S = 0.6
"""Ours: how long the others run; a robot dropped from 1 m has then landed."""
SAMPLE_S = 0.05
FINER = 8
"""A step this many times shorter tells what is accurate."""
SHORTEST_S = {"newmark": 1e-5, "euler": 1e-5, "explicit": 2.5e-7}
"""The shortest step that tells it: that of the implicit schemes is their shortest, the other is ours."""
TOLERANCE = 0.02
"""Ours: greatest distance of any node from where the shorter step has it, over the body's length."""
VERDICTS = ("accurate", "stable", "refused", "broken")


@dataclass(frozen=True)
class Case:
    """A scene of a sweep."""

    body: str  # rod or robot
    dimensions: int  # 2 or 3
    integrator: str  # which scheme
    axis: str  # title of the axis that is set
    value: float  # its value
    second_axis: str = ""  # title of another that is set; empty where there is none
    second_value: float | None = None  # its value
    start: str = ""  # how the body is bent at the start; empty where it is straight

    def scene(self, finer: int = 1) -> Scene:
        """The scene.

        Args:
            finer: By how much the step is shorter.

        Raises:
            SceneError: A scene that cannot be simulated.
        """
        changes: Changes = {"solver.step_s": STEP_S[self.integrator], "solver.integrator": self.integrator}
        changes |= starting(self.body, self.start) | AXES[self.axis].changes(self.value)
        if self.second_value is not None:
            changes |= AXES[self.second_axis].changes(self.second_value)
        if finer > 1:
            changes["solver.step_s"] = max(SHORTEST_S[self.integrator], changes["solver.step_s"] / finer)
        return base_scene(self.body, self.dimensions).with_values(changes)

    @property
    def duration_s(self) -> float:
        """For how long it runs [s]."""
        return DURATION_S.get((self.body, self.integrator), LONG_S)

    @property
    def setting(self) -> str:
        """The value in words."""
        return plain(self.value)

    @property
    def scheme(self) -> str:
        """Scheme and step, for bent starts."""
        unit = f"{self.value:g} ms" if self.value >= 0.1 else f"{MM * self.value:g} µs"
        return f"{self.integrator} {unit}"

    @property
    def shortest(self) -> bool:
        """Whether it has an implicit step that cannot be shortened."""
        set_ms = self.value if self.axis == STEP.title else MM * STEP_S[self.integrator]
        return self.integrator != "explicit" and set_ms <= MM * SHORTEST_S[self.integrator]


@dataclass(frozen=True)
class Outcome:
    """What became of a case. Its error is not a number where there is no shorter step to compare with."""

    case: Case
    verdict: str  # one of VERDICTS
    error: float  # greatest distance from the run with a shorter step, over the body's length
    sentence: str = ""  # why it was refused or broke; empty otherwise


def alone(body: str, axis: Axis, dimensions: int, *, long: bool = False) -> list[Case]:
    """An axis by itself: in the plane all values under every scheme, in space as many only where `long`."""
    everything = long or dimensions == 2
    integrators = INTEGRATORS if everything else ("newmark", "explicit")
    values = axis.values if everything else axis.ends
    return [Case(body, dimensions, scheme, axis.title, value) for scheme in integrators for value in values]


def crossed(body: str, pair: tuple[Axis, Axis]) -> list[Case]:
    """Two axes together, in the plane; a robot under the default scheme alone."""
    first, second = pair
    integrators = INTEGRATORS if body == "rod" else ("newmark",)
    return [
        Case(body, 2, integrator, first.title, a, second.title, b)
        for integrator, a, b in product(integrators, first.values, second.values)
    ]


def every_pair() -> Iterator[Case]:
    """Every pair of axes at both ends and in the middle of each, in the plane and in space."""
    for body, axes in ALONE.items():
        kept = [LONGER if axis is STEP else axis for axis in axes if axis is not INSIDE]
        for (first, second), integrator in product(combinations(kept, 2), INTEGRATORS):
            for dimensions, a, b in product((2, 3), first.ends, second.ends):
                yield Case(body, dimensions, integrator, first.title, a, second.title, b)


def bent() -> list[Case]:
    """Every bent start under every scheme, in the plane where it lies there, and in space."""
    return [
        case
        for body, named in STARTS.items()
        for start in named
        for dimensions in places(body, start)
        for case in bent_start(body, start, dimensions)
    ]


def bent_start(body: str, start: str, dimensions: int) -> list[Case]:
    """A bent start under every scheme, the default one with two steps."""
    steps_s = (
        ("newmark", STEP_S["newmark"]),
        ("newmark", SHORT_S),
        ("euler", STEP_S["euler"]),
        ("explicit", EXPLICIT_S[body, dimensions]),
    )
    return [
        Case(body, dimensions, scheme, STEP.title, MM * step_s, start=start) for scheme, step_s in steps_s
    ]


def judge(cases: Sequence[Case], *, accuracy: bool = True) -> list[Outcome]:
    """Runs cases and the same with a shorter step, side by side.

    Args:
        cases: What to run.
        accuracy: Whether the shorter step is run; without it no case is more than stable.

    Raises:
        RuntimeError: A number that is not finite left the simulator, whatever the case's status.
    """
    found = _runs(cases, 1)
    finer = _runs(cases, FINER) if accuracy else [""] * len(cases)
    return [_outcome(*each) for each in zip(cases, found, finer, strict=True)]


def _runs(cases: Sequence[Case], finer: int) -> list[Recording | str]:
    """Recordings of the cases that run, and the sentences of those that are refused."""
    made = [_made(case, finer) for case in cases]
    run = [(scene, case) for scene, case in zip(made, cases, strict=True) if isinstance(scene, Scene)]
    records = record_scenes([scene for scene, _ in run], [case.duration_s for _, case in run], SAMPLE_S)
    for record, (_, case) in zip(records, run, strict=True):
        if not (np.isfinite(record.nodes).all() and np.isfinite(record.magnet_poses).all()):
            raise RuntimeError(f"a number that is not finite left the simulator: {case}")
    left = iter(records)
    return [next(left) if isinstance(scene, Scene) else scene for scene in made]


def _made(case: Case, finer: int) -> Scene | str:
    try:
        return case.scene(finer)
    except SceneError as error:
        return str(error)


def _outcome(case: Case, found: Recording | str, finer: Recording | str) -> Outcome:
    if isinstance(found, str):
        return Outcome(case, "refused", np.nan, found)
    if found.broken is not None:
        return Outcome(case, "broken", np.nan, found.broken)
    if isinstance(finer, str) or finer.broken is not None or case.shortest:
        return Outcome(case, "stable", np.nan)
    apart_m = np.linalg.norm(found.nodes - finer.nodes, axis=-1).max()
    rest_m = np.linalg.norm(np.diff(found.nodes[0], axis=0), axis=-1).sum()
    error = float(apart_m / rest_m)
    return Outcome(case, "accurate" if error <= TOLERANCE else "stable", error)
