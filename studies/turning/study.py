"""How far one pass of a drive magnet turns the robots, and when they tip over: ``docs/turning.md``.

Five minutes on two cores.
"""

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from studies.kit.data import read_rows, write_rows
from studies.kit.page import page
from studies.kit.study import Study
from studies.kit.timing import Stopwatch
from studies.turning import findings
from studies.turning.figures import per_pass, roll_against_offset, tipping_map
from studies.turning.passes import Tipping, outcomes
from studies.turning.plane import ASIDE_MM, Comparison, comparisons
from studies.turning.points import NEIGHBOURS_MM, Point, points
from studies.turning.sweeps import OFFSET_MM, ROBOTS, STEPS_MS, SWEEPS, TIPPING, TIPPING_OFFSETS_MM, UNIT_MM

HERE = Path(__file__).parent
DATA = HERE / "data"


def measure(_: argparse.Namespace) -> None:
    """Runs planar presets in space, averaged points of all sweeps, and single passes."""
    said = Stopwatch().said
    write_rows(DATA / "plane.csv", Comparison, comparisons())
    said("plane")
    found = []
    for name, drives in SWEEPS.items():
        found += points(name, drives)
        said(name)
    write_rows(DATA / "points.csv", Point, found)
    single = [Tipping(drive, each.rolls) for drive, each in zip(TIPPING, outcomes(TIPPING), strict=True)]
    write_rows(DATA / "tipping.csv", Tipping, single)
    said("tipping")


def sweeps() -> dict[str, list[Point]]:
    """The points of each sweep."""
    found: dict[str, list[Point]] = {name: [] for name in SWEEPS}
    for point in read_rows(DATA / "points.csv", Point):
        found[point.sweep].append(point)
    return found


def pages() -> dict[str, str]:
    """The page from the data."""
    single, plane = read_rows(DATA / "tipping.csv", Tipping), read_rows(DATA / "plane.csv", Comparison)
    return {"turning.md": text(sweeps(), single, plane)}


def text(
    points_of: Mapping[str, Sequence[Point]], single: Sequence[Tipping], plane: Sequence[Comparison]
) -> str:
    """The page."""
    return page(
        HERE / "page.md",
        sweeps=points_of,
        margins=findings.margins(single),
        shortened=findings.shortened(points_of["step"]),
        plane=plane,
        find=findings,
        robots=ROBOTS,
        neighbours_mm=NEIGHBOURS_MM,
        beside_mm=OFFSET_MM,
        steps_ms=STEPS_MS,
        least_mm=TIPPING_OFFSETS_MM[0],
        unit_mm=UNIT_MM,
        aside_mm=ASIDE_MM,
    )


def figures() -> dict[str, Any]:
    """The figures from the data."""
    found = sweeps()
    drawn = {
        "offset": per_pass(found["offset"], "offset_mm", "offset of the drive [mm]"),
        "yaw": per_pass(found["yaw"], "yaw_deg", "yaw of the drive [°]", (0.0, OFFSET_MM)),
        "height": per_pass(found["height"], "height_mm", "height of the drive [mm]"),
        "speed": per_pass(found["speed"], "speed_mm_s", "speed of the drive [mm/s]"),
        "roll": roll_against_offset(found["offset"]),
        "tipping": tipping_map(read_rows(DATA / "tipping.csv", Tipping)),
    }
    return {f"turning/{name}.png": figure for name, figure in drawn.items()}


STUDY = Study(
    about="how far one pass of a drive magnet turns the robots, and when they tip over",
    measure=measure,
    pages=pages,
    figures=figures,
)
