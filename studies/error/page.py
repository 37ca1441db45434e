"""The page ``docs/performance.md``: everything on it follows from the data."""

import statistics
from collections.abc import Callable, Mapping, Sequence

from magworm_gym import Scene
from studies.error.case import Case
from studies.error.distance import Distance
from studies.error.errors import Figure
from studies.error.front import front_of, ranked_of
from studies.error.held import held
from studies.error.levels import Level
from studies.error.measured import Row
from studies.error.peers.cantilever import LENGTH_M
from studies.error.pictures import PERCENT
from studies.error.work import Work

IMAGES = "images/performance"
INTRODUCTION = """# Error against run time

Written by `make study-error`; do not edit. How far from converged a step, a mesh, a quadrature and wrenches
that act for several steps are, and what they cost.

**Errors** are those of the mean over all runs of a case, with the standard error over the runs after ±, as
parts of the figure's size; *pose* is the root mean square distance of all followed points from where they
should be, over points, time and runs. Along an axis one value is varied and the reference differs in that
value alone; for the *front* the reference is converged in every value, and the line *reference* says by how
much a coarser one differs from it, which bounds its own error.

**Cost** is of one robot-second: wall time on one core with eight environments in the lanes of a vector
(sixteen in single precision), 32 environments whose stiffness differs by up to 2 %, and counters that no
machine changes: systems and trials of a solver step of all lanes, wrenches of a drive magnet on a body
magnet and of body magnets on each other. Settings that no other beats in both error and wall time are on the
front; some owe it to errors of step, mesh and interval that cancel, which the pose tells. Hollow points of a
figure are settings whose wrenches act for several steps, squares are single precision.

Data: `studies/error/errors.csv`, `peers.csv`.
"""
LEVEL_TEXT = """## Accuracy

`solver.accuracy` stands for values of a scene, which it writes:
`Scene.preset("paper-3").with_values({"solver.accuracy": "fast"})`, or `accuracy = "fast"` under `[solver]`
of a file that leaves them out. Errors are against the converged reference of the case; environment steps of
20 ms are of 256 environments with random actions on all cores, median of several runs with their range. In
space, friction that falls as a foot slides makes passes branch (README, Speed): errors there are with an
even friction, speeds with the presets'.
"""

DISTANCE_TEXT = """## Single precision

`solver.precision = "single"` computes a step in 24 bits, sixteen robots in a vector instead of eight; errors
against double precision with the same step are in the tables *along the precision*. Places are kept as
coordinates, so they are rounded more the further a robot is from the origin, and most where a step moves
little. The passes of the first case again, from further away: error of the stride against double precision
with the same step. A step below 0.5 ms is refused.
"""
COST_HEAD = ["robot-s/s of a core", "systems a step", "trials", "wrenches"]
LEFT_OUT = """## What is not varied

- *The explicit scheme on the robot.* Its largest stable step for `paper-3` is {limit_us:.2f} µs: beyond
  it {what} grows ([stability.md](stability.md)). `make validate` compares a pass with the implicit one.
  It moves with the velocity at the end of a step, so where nothing damps it is symplectic Euler; there
  is no other symplectic scheme.
"""

LENGTH_MM = 1e3 * LENGTH_M
PEER_TABLES: Mapping[str, tuple[str, str, Callable[[float], str]]] = {
    "cantilever": (
        "Other codes on the same cantilever (`python -m studies.error.peers`, extra `rivals`), at their"
        " largest stable step and half of it, clamped at the middle of the first element; distances of the"
        f" tip are parts of the length, {LENGTH_MM:g} mm. They differ by their models as well:"
        " PyElastica shears and thins as it stretches, MuJoCo's cable cannot stretch. So the distance from"
        " the same code's finest mesh stands beside it.",
        "distance of the tip",
        lambda part: f"{PERCENT * part:.2f} %",
    ),
    "magnets": (
        "PyElastica with the wrenches of magpylib's `getFT` on the same rod (`python -m studies.error.peers`,"
        " extra `rivals`), one robot at its largest stable step on one thread; a magnet is cut into 4 × 1 × 4"
        " cells. At every step, wrenches take most of the time; so they are also computed every 10, 20 or 40"
        " steps, and between taken from the line through the last two. PyElastica's rod shears and its"
        " magnets give a little, MagWorm's do not: with shear ten times as stiff it comes closer, for a"
        " shorter step. The distance is the pose of the tables above, the wall time that of a robot-second.",
        "distance of the magnets",
        lambda part: f"{LENGTH_MM * part:.3f} mm",
    ),
}
"""What is said above a case's table of other codes, what their distances are, and how they are written."""


def page(
    cases: Sequence[Case],
    rows: Sequence[Row],
    levels: Mapping[str, Sequence[Level]],
    peers: Sequence[Mapping[str, str]],
    far: Sequence[Distance],
) -> str:
    """The whole page."""
    parts = [INTRODUCTION, LEVEL_TEXT, *(level_table(name, found) for name, found in levels.items())]
    for case in cases:
        parts.append(section(case, [row for row in rows if row.case == case.name]))
        others = [peer for peer in peers if peer["case"] == case.name]
        if others:
            parts.append(peer_table(case.name, others))
    parts += [held(cases, rows), distance_section(far), left_out()]
    return "\n".join(parts)


def left_out() -> str:
    """Axes that are not varied, with what they could give."""
    limit_s, what = Scene.preset("paper-3").explicit_limit()
    return LEFT_OUT.format(limit_us=1e6 * limit_s, what=what)


def percent(error: float, uncertainty: float) -> str:
    """An error with what it leaves open."""
    text = f"{PERCENT * error:+.2f}"
    return f"{text} ± {PERCENT * uncertainty:.2f} %" if uncertainty else f"{text} %"


def of_figure(figure: Figure) -> str:
    """The same of a figure."""
    return percent(figure.mean, figure.uncertainty)


def table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows) + "\n"


def distance_section(far: Sequence[Distance]) -> str:
    """What single precision loses with the distance from the origin."""
    places = list(dict.fromkeys(one.place_m for one in far))
    lines = []
    for step_ms in dict.fromkeys(one.step_ms for one in far):
        found = {one.place_m: one for one in far if one.step_ms == step_ms}
        cells = [of_figure(found[place].errors.figures["stride"]) for place in places]
        lines.append([f"{step_ms:g} ms", *cells])
    return DISTANCE_TEXT + "\n" + table(["step", *(f"{place:g} m" for place in places)], lines)


def level_table(case: str, levels: Sequence[Level]) -> str:
    """What the words mean for a case."""
    names = list(levels[0].errors.figures)
    lines = [
        [
            f"`{level.name}`",
            level.settings.text(),
            *(of_figure(level.errors.figures[name]) for name in names),
            f"{level.errors.pose_mm:.3f} mm",
            f"{statistics.median(level.steps_per_second):,.0f}"
            f" ({min(level.steps_per_second):,.0f} to {max(level.steps_per_second):,.0f})",
        ]
        for level in levels
    ]
    where = {"crawl": "In the plane, `paper-3`:", "turn": "In space, `turn-3`:"}[case]
    return f"{where}\n\n" + table(["", "stands for", *names, "pose", "environment steps/s"], lines)


def section(case: Case, rows: Sequence[Row]) -> str:
    """A case: figure, reference, tables."""
    check = [row for row in rows if row.part == "check"]
    bounds = ", ".join(f"{row.figure} {error_text(row)}" for row in check)
    return "\n".join(
        [
            f"## {case.title}\n",
            f"{case.text}\n",
            f"Reference: {case.reference.text()}; {case.check.text()} differs by: {bounds}.\n",
            f"![{case.title}]({IMAGES}/{case.name}.png)\n",
            *(axis_table(name, rows) for name in dict.fromkeys(axis.name for axis in case.axes)),
            front_table(case, rows),
        ]
    )


def error_text(row: Row) -> str:
    """The error of a row."""
    return f"{row.error:.3f} mm" if row.figure == "pose" else percent(row.error, row.uncertainty)


def axis_table(name: str, rows: Sequence[Row]) -> str:
    """Errors along an axis, with costs where they are known."""
    chosen = [row for row in rows if row.part == f"axis {name}"]
    figures = list(dict.fromkeys(row.figure for row in chosen if row.figure != "broken"))
    works = {row.settings: row.work for row in chosen if row.work is not None}
    lines = []
    for settings in dict.fromkeys(row.settings for row in chosen):
        found = {row.figure: error_text(row) for row in chosen if row.settings == settings}
        costs = cost_cells(works.get(settings)) if works else []
        lines.append([settings.text(), *(found.get(figure, "broke down") for figure in figures), *costs])
    head = ["settings", *figures, *(COST_HEAD if works else [])]
    return f"Along the {name}:\n\n" + table(head, lines)


def cost_cells(work: Work | None) -> list[str]:
    """Costs of a robot-second."""
    if work is None:
        return ["–"] * len(COST_HEAD)
    return [
        f"{1.0 / work.wall_s:,.0f}",
        f"{work.systems:.2f}",
        f"{work.trials:.2f}",
        f"{work.wrenches:,.0f}",
    ]


def front_table(case: Case, rows: Sequence[Row]) -> str:
    """The front, with costs."""
    front = [row for row in rows if row.part == "front" and row.work is not None]
    figures = list(dict.fromkeys(row.figure for row in front))
    lines = []
    ranked = ranked_of(case, rows)
    for chosen in front_of(rows, ranked):
        found = {row.figure: error_text(row) for row in front if row.settings == chosen.settings}
        errors = [found[figure] for figure in figures]
        lines.append([chosen.settings.text(), *errors, *cost_cells(chosen.work)])
    head = ["settings", *figures, *COST_HEAD]
    return f"On the front, by the error of the {ranked}:\n\n" + table(head, lines)


def peer_table(case: str, peers: Sequence[Mapping[str, str]]) -> str:
    """Other codes on a case."""
    words, distance, of_distance = PEER_TABLES[case]
    lines = [
        [
            peer["name"],
            peer["version"],
            peer["elements"],
            f"{1e3 * float(peer['step_s']):.3g} ms",
            of_distance(float(peer["error"])),
            of_distance(float(peer["own_error"])),
            f"{float(peer['wall_s']):.2f} s",
        ]
        for peer in peers
    ]
    head = ["code", "version", "elements", "step", distance, "from its own finer mesh", "wall time"]
    return f"{words}\n\n" + table(head, lines)
