"""Starts that are bent: folded, inverted, rolled up, twisted, knotted, and inside the ground.

The *rod* is that of the preset ``cantilever``, 3 mm wide and thick and free, on the ground. The *robot* is
that of the other sweeps.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.stability.axes import Changes, base_scene
from studies.stability.cases import SHORTEST_S, STEP_S, Case, Outcome, judge
from studies.stability.knots import closed, determinant

ROD: Changes = {
    "body.clamp": "none",
    "body.width_m": 0.003,
    "body.thickness_m": 0.003,
    "body.elements": 27,
    "ground": {"static_friction": 0.8, "dynamic_friction": 0.6},
}
KNOT: Changes = {
    "start.yaw_deg": 90,
    "start.bends_deg": [10, -90, -90, -50, -50, -90, -90, 10],
    "start.bends_aside_deg": [70, 20, 60, 80, -80, -60, -20, -70],
}
"""Ours: an overhand knot, found by a random search for one whose line stays away from itself."""
INSIDE: Changes = {"start.bends_deg": [-90, 180], "start.height_m": -1e-3}

STARTS: Mapping[str, Mapping[str, Changes]] = {
    "rod": {
        "folded over itself": {"start.bends_deg": [0, 0, 0, 0, 180, 0, 0, 0, 0]},
        "rolled up in three turns": {"start.bends_deg": [1080]},
        "rolled up in five turns, dropped": {"start.bends_deg": [1800], "start.height_m": 0.05},
        "inside the ground": INSIDE,
        "twisted by five turns": {"start.bends_deg": [10], "start.twists_deg": [1800]},
        "coiled": {"start.bends_aside_deg": [1440], "start.twists_deg": [500]},
        "knotted": KNOT,
    },
    "robot": {
        "folded over itself": {"start.bends_deg": [0, 0, 90, 90, 0, 0, 0, 0, 0]},
        "folded twice": {"start.bends_deg": [0, 0, 90, 90, 0, -90, -90, 0, 0]},
        "upside down": {"start.angle_deg": 180},
        "upside down and bent": {"start.angle_deg": 180, "start.bends_deg": [60]},
        "rolled up in two turns": {"start.bends_deg": [720]},
        "inside the ground": INSIDE,
        "bent aside by a turn": {"start.bends_aside_deg": [360]},
        "twisted by two turns": {"start.twists_deg": [720]},
        "bent and twisted": {
            "start.bends_deg": [200, -100],
            "start.bends_aside_deg": [180],
            "start.twists_deg": [-180, 360],
        },
    },
}
"""Ours. What bends aside or twists starts in space alone."""

SHORT_S = 2e-4
EXPLICIT_S = {("rod", 2): 4e-6, ("rod", 3): 4e-6, ("robot", 2): 4e-6, ("robot", 3): 5e-7}
"""Ours: below the limits of these bodies."""
SHORTEST_EXPLICIT_S = 2.5e-7
"""Ours: the shortest that tells what is accurate."""
WATCHED_MS = (0, 10, 50, 200, 600)
"""When the picture shows a body."""
KNOT_SAMPLE_S = 2e-3
TREFOIL = 3


@dataclass(frozen=True)
class StartCase(Case):
    """A body that starts bent.

    Attributes:
        start: A key of STARTS of its body.
        step_s: Step where it is not shorter [s].
    """

    start: str = ""
    step_s: float = 0.0

    def scene(self) -> Scene:
        """The scene.

        Raises:
            SceneError: A scene that cannot be simulated.
        """
        shortest_s = SHORTEST_EXPLICIT_S if self.integrator == "explicit" else SHORTEST_S
        changes: Changes = {
            "solver.integrator": self.integrator,
            "solver.step_s": max(shortest_s, self.step_s / self.finer),
        }
        changes |= ROD if self.body == "rod" else {}
        return base_scene(self.body, self.dimensions).with_values(changes | STARTS[self.body][self.start])


@dataclass(frozen=True)
class Untying:
    """How long a knotted rod stays so.

    Attributes:
        integrator: Which scheme.
        step_s: Its step [s].
        until_s: When it was last a trefoil [s].
        at_end: Determinant of its line at the end; 1 where it is none.
    """

    integrator: str
    step_s: float
    until_s: float
    at_end: int


def schemes(body: str, dimensions: int) -> list[tuple[str, float]]:
    """Schemes and steps [s] that a body starts under."""
    return [
        ("newmark", STEP_S["newmark"]),
        ("newmark", SHORT_S),
        ("euler", STEP_S["euler"]),
        ("explicit", EXPLICIT_S[body, dimensions]),
    ]


def start_cases() -> list[StartCase]:
    """Every start under every scheme, in the plane where it lies there, and in space."""
    return [
        StartCase(body, dimensions, integrator, (), start=name, step_s=step_s)
        for body, named in STARTS.items()
        for name in named
        for dimensions in (2, 3)
        if dimensions == 3 or lies_in_the_plane(body, name)
        for integrator, step_s in schemes(body, dimensions)
    ]


def starts() -> list[Outcome]:
    """What becomes of every start."""
    return judge(start_cases())


def lies_in_the_plane(body: str, name: str) -> bool:
    """Whether a start neither bends aside nor twists."""
    return not {"start.bends_aside_deg", "start.twists_deg"} & set(STARTS[body][name])


def untyings() -> list[Untying]:
    """The knotted rod under every scheme.

    Raises:
        RuntimeError: Its line is no trefoil at the start.
    """
    cases = [
        StartCase("rod", 3, integrator, (), start="knotted", step_s=step_s)
        for integrator, step_s in schemes("rod", 3)
    ]
    durations = [case.duration_s for case in cases]
    records = record_scenes([case.scene() for case in cases], durations, KNOT_SAMPLE_S)
    return [_untying(case, record) for case, record in zip(cases, records, strict=True)]


def _untying(case: StartCase, record: Recording) -> Untying:
    knots = np.array([determinant(closed(line)) for line in record.nodes])
    if knots[0] != TREFOIL or determinant(record.nodes[0]) != TREFOIL:
        raise RuntimeError(f"the start is no trefoil: its determinant is {knots[0]}")
    until_s = float(record.time_s[np.flatnonzero(knots == TREFOIL)[-1]])
    return Untying(case.integrator, case.step_s, until_s, int(knots[-1]))


def watched(body: str, name: str) -> Recording:
    """A start under `newmark` with the shorter step, in the plane where it lies there."""
    dimensions = 2 if lies_in_the_plane(body, name) else 3
    case = StartCase(body, dimensions, "newmark", (), start=name, step_s=SHORT_S)
    return record_scenes([case.scene()], max(WATCHED_MS) / 1e3, 0.01)[0]
