"""Cases of the sweeps and what became of them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product

import numpy as np

from magworm_gym import Recording, Scene, SceneError, record_scenes
from studies.stability.axes import ALONE, INSIDE, LONGER, STEP, Axis, Changes, base_scene

INTEGRATORS = ("newmark", "euler", "explicit")
STEP_S = {"newmark": 2e-3, "euler": 2e-3, "explicit": 4e-6}
"""Where it is not what is swept: that of the presets, and one that the explicit scheme can take."""
DURATION_S = {("rod", "explicit"): 0.1, ("robot", "explicit"): 0.05}
"""Ours: how long explicit cases run; their steps are hundreds of times shorter."""
LONG_S = 0.6
"""Ours: how long the others run; a robot dropped from 1 m has then landed."""
SAMPLE_S = 0.05
FINER = 8
"""A step this many times shorter tells what is accurate."""
SHORTEST_S = 1e-5
"""The shortest step that the implicit schemes may take."""
TOLERANCE = 0.02
"""Ours: greatest distance of any node from where the shorter step has it, over the body's length."""
VERDICTS = ("accurate", "stable", "refused", "broken")


@dataclass(frozen=True)
class Case:
    """A scene of a sweep.

    Attributes:
        body: Rod or robot.
        dimensions: 2 or 3.
        integrator: Which scheme.
        settings: The axes that are set, with their values.
        finer: By how much the step is shorter than asked for.
    """

    body: str
    dimensions: int
    integrator: str
    settings: tuple[tuple[Axis, float], ...]
    finer: int = 1

    def scene(self) -> Scene:
        """The scene.

        Raises:
            SceneError: A scene that cannot be simulated.
        """
        step_s = STEP_S[self.integrator]
        changes: Changes = {"solver.step_s": step_s, "solver.integrator": self.integrator}
        for axis, value in self.settings:
            changes |= axis.changes(value)
        changes["solver.step_s"] /= self.finer
        if self.finer > 1 and self.integrator != "explicit":
            changes["solver.step_s"] = max(SHORTEST_S, changes["solver.step_s"])
        return base_scene(self.body, self.dimensions).with_values(changes)

    @property
    def duration_s(self) -> float:
        """For how long it runs [s]."""
        return DURATION_S.get((self.body, self.integrator), LONG_S)


@dataclass(frozen=True)
class Outcome:
    """What became of a case.

    Attributes:
        case: The case.
        verdict: One of VERDICTS.
        error: Greatest distance from the run with the shorter step over the body's length; not a number
            where there is none.
        sentence: Why it was refused or broke; empty otherwise.
    """

    case: Case
    verdict: str
    error: float
    sentence: str


def alone(body: str, axis: Axis, dimensions: int, *, long: bool = False) -> list[Case]:
    """An axis by itself: in the plane all values under every scheme, in space as many only where `long`."""
    everything = long or dimensions == 2
    integrators = INTEGRATORS if everything else ("newmark", "explicit")
    values = axis.values if everything else axis.ends
    return [Case(body, dimensions, scheme, ((axis, value),)) for scheme in integrators for value in values]


def crossed(body: str, pair: tuple[Axis, Axis]) -> list[Case]:
    """Two axes together, in the plane; a robot under the default scheme alone."""
    first, second = pair
    integrators = INTEGRATORS if body == "rod" else ("newmark",)
    return [
        Case(body, 2, integrator, ((first, a), (second, b)))
        for integrator, a, b in product(integrators, first.values, second.values)
    ]


def every_pair() -> list[Case]:
    """Every pair of axes at both ends and in the middle of each, in the plane and in space."""
    cases = []
    for body, axes in ALONE.items():
        kept = [LONGER if axis is STEP else axis for axis in axes if axis is not INSIDE]
        for (first, second), integrator in product(combinations(kept, 2), INTEGRATORS):
            for dimensions, a, b in product((2, 3), first.ends, second.ends):
                cases.append(Case(body, dimensions, integrator, ((first, a), (second, b))))
    return cases


def judge(cases: Sequence[Case], *, accuracy: bool = True) -> list[Outcome]:
    """Runs cases and the same with a shorter step, side by side.

    Args:
        cases: What to run.
        accuracy: Whether the shorter step is run; without it no case is more than stable.

    Raises:
        RuntimeError: A number that is not finite left the simulator, whatever the case's status.
    """
    plain, refusals = _runs(cases)
    finer, _ = _runs([replace(case, finer=FINER) for case in cases] if accuracy else [])
    return [_outcome(case, plain.get(i), finer.get(i), refusals.get(i, "")) for i, case in enumerate(cases)]


def _runs(cases: Sequence[Case]) -> tuple[dict[int, Recording], dict[int, str]]:
    """Recordings of the cases that run, and the sentences of those that are refused, by their place."""
    scenes, refusals = {}, {}
    for i, case in enumerate(cases):
        try:
            scenes[i] = case.scene()
        except SceneError as error:
            refusals[i] = str(error)
    durations = [cases[i].duration_s for i in scenes]
    found = record_scenes(list(scenes.values()), durations, SAMPLE_S)
    for i, record in zip(scenes, found, strict=True):
        if not (np.isfinite(record.nodes).all() and np.isfinite(record.magnet_poses).all()):
            raise RuntimeError(f"a number that is not finite left the simulator: {cases[i]}")
    return dict(zip(scenes, found, strict=True)), refusals


def _outcome(case: Case, plain: Recording | None, finer: Recording | None, refusal: str) -> Outcome:
    if plain is None:
        return Outcome(case, "refused", np.nan, refusal)
    if plain.broken is not None:
        return Outcome(case, "broken", np.nan, plain.broken)
    if finer is None or finer.broken is not None or _step_ms(case) <= 1e3 * SHORTEST_S:
        return Outcome(case, "stable", np.nan, "")
    apart_m = np.linalg.norm(plain.nodes - finer.nodes, axis=-1).max()
    rest_m = np.linalg.norm(np.diff(plain.nodes[0], axis=0), axis=-1).sum()
    error = float(apart_m / rest_m)
    return Outcome(case, "accurate" if error <= TOLERANCE else "stable", error, "")


def _step_ms(case: Case) -> float:
    """The step of an implicit case [ms]; explicit ones have no shortest, so infinite."""
    if case.integrator == "explicit":
        return np.inf
    return next((value for axis, value in case.settings if axis is STEP), 1e3 * STEP_S[case.integrator])
