"""What each integrator does with stiff and extreme scenes: ``docs/stability.md`` and its figures.

Six minutes on two cores. ``--long`` runs every value in space as well, and every pair of axes.
"""

import argparse
from collections.abc import Sequence
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
DIGITS = 4


@dataclass(frozen=True)
class Explicit:
    """The longest step [s] of the explicit scheme for ``paper-3``, and how a longer one is refused."""

    preset_s: float
    refusal: str


@dataclass(frozen=True)
class Results:
    """All that is measured; ``pairs`` only by the long form."""

    explicit: Explicit
    limits: Sequence[Limit]
    swings: Sequence[Swing]
    single: Sequence[Outcome]
    crossed: Sequence[Outcome]
    bent: Sequence[Outcome]
    untied: Sequence[Untying]
    pairs: Sequence[Outcome] = ()


def options(parser: argparse.ArgumentParser) -> None:
    """Of the measurement."""
    parser.add_argument("--long", action="store_true", help="all values in space, and every pair of axes")


def measure(arguments: argparse.Namespace) -> None:
    """Runs limits, energies and all sweeps."""
    said = Stopwatch().said
    measure_explicit()
    said("limits")
    write_rows(DATA / "energy.csv", Swing, swings(), DIGITS)
    said("energies")
    axes = [(body, axis, of) for of in findings.WHERE for body in ALONE for axis in ALONE[body]]
    single = [case for place in axes for case in alone(*place, long=arguments.long)]
    write_rows(DATA / "alone.csv", Outcome, judge(single), DIGITS)
    said("alone")
    both = [case for body, pairs in CROSSED.items() for pair in pairs for case in crossed(body, pair)]
    write_rows(DATA / "crossed.csv", Outcome, judge(both), DIGITS)
    said("crossed")
    write_rows(DATA / "starts.csv", Outcome, judge(bent()), DIGITS)
    measure_postures()
    said("bent starts")
    if arguments.long:
        write_rows(DATA / "pairs.csv", Outcome, judge(list(every_pair()), accuracy=False), DIGITS)
        said("pairs")


def measure_explicit() -> None:
    """The largest steps of the explicit scheme."""
    write_rows(DATA / "limits.csv", Limit, limits())
    preset_s, _ = Scene.preset("paper-3").explicit_limit()
    write_json(DATA / "explicit.json", Explicit(preset_s, refusal()))


def measure_postures() -> None:
    """What becomes of the knot and of the starts that are drawn."""
    write_rows(DATA / "knots.csv", Untying, untyings())
    write_rows(DATA / "postures.csv", Posture, list(postures()), DIGITS)


def results() -> Results:
    """The data."""
    outcomes = {path.stem: read_rows(path, Outcome) for path in map(DATA.joinpath, OUTCOMES) if path.exists()}
    return Results(
        explicit=read_json(DATA / "explicit.json", Explicit),
        limits=read_rows(DATA / "limits.csv", Limit),
        swings=read_rows(DATA / "energy.csv", Swing),
        single=outcomes["alone"],
        crossed=outcomes["crossed"],
        bent=outcomes["starts"],
        untied=read_rows(DATA / "knots.csv", Untying),
        pairs=outcomes.get("pairs", ()),
    )


OUTCOMES = ("alone.csv", "crossed.csv", "starts.csv", "pairs.csv")


def pages() -> dict[str, str]:
    """The page from the data."""
    return {"stability.md": text(results())}


def text(of: Results) -> str:
    """The page."""
    return page(
        HERE / "page.md",
        of=of,
        every=[*of.single, *of.crossed, *of.bent],
        energies=list(findings.energies(of.swings)),
        moduli=sorted({swing.stiffness_pa for swing in of.swings}),
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
    both = read_rows(DATA / "crossed.csv", Outcome)
    return {
        "stability/rod.png": rod_map([outcome for outcome in both if outcome.case.body == "rod"]),
        "stability/robot.png": robot_map([outcome for outcome in both if outcome.case.body == "robot"]),
        "stability/starts.png": start_strip(read_rows(DATA / "postures.csv", Posture)),
    }


STUDY = Study(
    about="what each integrator does with stiff and extreme scenes",
    options=options,
    measure=measure,
    pages=pages,
    figures=figures,
)
