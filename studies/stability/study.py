"""What each integrator does with stiff and extreme scenes: ``docs/stability.md`` and its figures.

Six minutes on two cores. ``--long`` runs every value in space as well, and every pair of axes.
"""

import argparse
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from magworm_gym import Scene
from studies.kit.data import read_json, read_rows, write_json, write_rows
from studies.kit.page import page
from studies.kit.study import Study
from studies.kit.timing import Stopwatch
from studies.stability import cases, findings
from studies.stability.axes import ALONE, CROSSED
from studies.stability.cases import Outcome, alone, bent, crossed, every_pair, judge
from studies.stability.energy import BAND, Swing, swings
from studies.stability.figures import robot_map, rod_map, start_strip
from studies.stability.limits import Limit, limits, refusal
from studies.stability.postures import WATCHED_MS, Posture, Untying, postures, untyings
from studies.stability.starts import STARTS

HERE = Path(__file__).parent
DATA = HERE / "data"


@dataclass(frozen=True)
class Explicit:
    """The longest step [s] of the explicit scheme for ``paper-3``, and how a longer one is refused."""

    preset_s: float
    refusal: str


ROWS: dict[str, type[Any]] = {
    "limits": Limit,
    "swings": Swing,
    "alone": Outcome,
    "crossed": Outcome,
    "bent": Outcome,
    "knots": Untying,
    "postures": Posture,
    "pairs": Outcome,
}
"""Tables, and what their rows are; only ``--long`` fills the last."""


def options(parser: argparse.ArgumentParser) -> None:
    """Of the measurement."""
    parser.add_argument("--long", action="store_true", help="all values in space, and every pair of axes")


def measure(arguments: argparse.Namespace) -> None:
    """Runs limits, energies and all sweeps."""
    said = Stopwatch().said

    def keep(name: str, rows: Iterable[Any], digits: int = 4) -> None:
        write_rows(DATA / f"{name}.csv", ROWS[name], list(rows), digits)
        said(name)

    preset_s, _ = Scene.preset("paper-3").explicit_limit()
    write_json(DATA / "explicit.json", Explicit(preset_s, refusal()))
    keep("limits", limits(), digits=6)
    keep("swings", swings())
    axes = [(body, axis, of) for of in findings.WHERE for body in ALONE for axis in ALONE[body]]
    keep("alone", judge([case for place in axes for case in alone(*place, long=arguments.long)]))
    both = [(body, pair) for body, pairs in CROSSED.items() for pair in pairs]
    keep("crossed", judge([case for place in both for case in crossed(*place)]))
    keep("bent", judge(bent()))
    keep("knots", untyings())
    keep("postures", postures())
    if arguments.long:
        keep("pairs", judge(list(every_pair()), accuracy=False))


def rows(name: str) -> list[Any]:
    """A table; without rows where it was not measured."""
    path = DATA / f"{name}.csv"
    return read_rows(path, ROWS[name]) if path.exists() else []


def pages() -> dict[str, str]:
    """The page from the data."""
    explicit = read_json(DATA / "explicit.json", Explicit)
    return {"stability.md": text(explicit, {name: rows(name) for name in ROWS})}


def text(explicit: Explicit, tables: Mapping[str, Sequence[Any]]) -> str:
    """The page, from tables named as in ROWS."""
    return page(
        HERE / "page.md",
        explicit=explicit,
        of=tables,
        every=[*tables["alone"], *tables["crossed"], *tables["bent"]],
        moduli=sorted({swing.stiffness_pa for swing in tables["swings"]}),
        find=findings,
        cases=cases,
        axes=ALONE,
        drawn=sum(map(len, CROSSED.values())),
        band=BAND,
        starts=STARTS,
        watched_ms=WATCHED_MS,
    )


def figures() -> dict[str, Any]:
    """The figures from the data."""
    drawn = {
        "rod": rod_map(rows("crossed")),
        "robot": robot_map(rows("crossed")),
        "starts": start_strip(rows("postures")),
    }
    return {f"stability/{name}.png": figure for name, figure in drawn.items()}


STUDY = Study(
    about="what each integrator does with stiff and extreme scenes",
    options=options,
    measure=measure,
    pages=pages,
    figures=figures,
)
