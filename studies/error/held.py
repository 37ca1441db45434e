"""Wrenches that act for several steps: what that saves and costs, in words."""

from collections.abc import Sequence

from studies.error.case import Case
from studies.error.front import front_of, ranked_of
from studies.error.measured import Row
from studies.error.settings import Settings
from studies.needs.counts import committed

PERCENT = 100.0
MAGNETS, BELT_MAGNETS = 3, 16
PRESET = Settings(2.0)
"""What the presets run with."""

TEXT = """## How often a wrench is computed

`solver.wrench_interval` lets force and torque of a wrench act for n steps, which divide a control step: what
acts is (n − 1)/2 steps old on the average, and the error is of first order in that age. Wrenches of body
magnets on each other are computed in every step all the same. The drive's three wrenches of a step are
{plane:.1f} % of its instructions in the plane and {space:.1f} % in space ([needs.md](needs.md)), and
{belt:.0f} % over a belt of 16 magnets: holding them saves less than that.
"""


def held(cases: Sequence[Case], rows: Sequence[Row]) -> str:
    """What wrenches that act for several steps save and cost."""
    counted = committed()
    of_step = {
        dimension: MAGNETS * counted[f"wrench-{dimension}"] / counted[f"step-{dimension}"]
        for dimension in ("plane", "space")
    }
    belt = BELT_MAGNETS * MAGNETS * counted["wrench-plane"] / counted["belt-16-plane"]
    parts = [
        TEXT.format(plane=PERCENT * of_step["plane"], space=PERCENT * of_step["space"], belt=PERCENT * belt)
    ]
    found = [held_in(case, [row for row in rows if row.case == case.name]) for case in cases]
    return "\n".join([*parts, *(text for text in found if text)]) + "\n"


def held_in(case: Case, rows: Sequence[Row]) -> str:
    """The same in a case; nothing where it is not varied."""
    poses = [row for row in rows if row.figure == "pose"]
    aged = [row for row in poses if row.part == "axis interval" and row.settings.interval > 1]
    if not aged:
        return ""
    per_ms = [row.error / age_ms(row.settings) for row in aged]
    own = next(row for row in poses if row.part == "axis step" and row.settings == PRESET)
    fronts = [
        f"by the {figure} {held_of(front_of(rows, figure))}" for figure in (ranked_of(case, rows), "pose")
    ]
    return (
        f"- *{case.title}*: each millisecond of age moves the pose by {min(per_ms):.3f} to"
        f" {max(per_ms):.3f} mm, a step of {PRESET.step_ms:g} ms itself by {own.error:.3f} mm. On the front"
        f" {' and '.join(fronts)} hold wrenches."
    )


def held_of(front: Sequence[Row]) -> str:
    """How many settings of a front hold wrenches."""
    return f"{sum(row.settings.interval > 1 for row in front)} of {len(front)} settings"


def age_ms(settings: Settings) -> float:
    """Mean age of the wrenches that act [ms]."""
    return 0.5 * (settings.interval - 1) * settings.step_ms
