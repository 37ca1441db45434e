"""Error against run time: ``docs/performance.md`` and its figures.

Five minutes on two cores. ``--cases`` runs some of the cases and leaves the rows of the others as they are;
``--peers`` runs other codes instead, those that are installed.
"""

import argparse
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from magworm_gym import Scene
from studies.error.case import Case
from studies.error.cases import CASES
from studies.error.distance import PLACES_M, STEPS_MS, Distance, distances
from studies.error.errors import BROKEN
from studies.error.levels import Level, levels
from studies.error.peers.cantilever import LENGTH_M
from studies.error.peers.runs import PEERS, PeerRun, runs_of, why_missing
from studies.error.pictures import figure_of
from studies.error.rows import Row, measure, pareto, priced
from studies.error.settings import Settings
from studies.error.work import COSTS
from studies.kit.data import read_json, read_rows, write_json, write_rows
from studies.kit.page import page, table
from studies.kit.passes import MM
from studies.kit.study import Study
from studies.kit.timing import Stopwatch
from studies.needs import counts

HERE = Path(__file__).parent
DATA = HERE / "data"
PRESET = Settings(2.0)
"""What the presets run with."""


@dataclass(frozen=True)
class Limit:
    """Largest stable step of the explicit scheme [s], and what grows beyond it."""

    step_s: float
    grows: str


def options(parser: argparse.ArgumentParser) -> None:
    """Of the measurement."""
    parser.add_argument("--cases", nargs="+", choices=[*CASES], default=[*CASES], help="which to run")
    parser.add_argument("--repetitions", type=int, default=3, help="runs whose median time is taken")
    parser.add_argument("--peers", action="store_true", help="run other codes instead: the extra `rivals`")


def run(arguments: argparse.Namespace) -> None:
    """Runs the cases, or the peers, and writes the data."""
    if arguments.peers:
        return run_peers()
    said = Stopwatch().said
    fresh = {}
    for name in arguments.cases:
        fresh[name] = list(measure(CASES[name], arguments.repetitions))
        said(name)
    keep(DATA / "errors.csv", Row, "case", CASES, fresh, digits=4)
    write_json(DATA / "accuracy.json", list(levels(arguments.repetitions)))
    said("accuracy")
    write_rows(DATA / "distance.csv", Distance, list(distances()), digits=4)
    write_json(DATA / "limit.json", Limit(*Scene.preset("paper-3").explicit_limit()))
    said("single precision")


def run_peers() -> None:
    """Runs the other codes that are installed, and says which are not."""
    fresh = {}
    for peer in PEERS:
        absent = why_missing(peer)
        print(absent or f"{peer.name} ...", flush=True)
        if absent is None:
            fresh[peer.name] = runs_of(peer)
    keep(DATA / "peers.csv", PeerRun, "peer", [peer.name for peer in PEERS], fresh)


def keep(
    path: Path,
    kind: type[Any],
    key: str,
    names: Iterable[str],
    fresh: Mapping[str, list[Any]],
    digits: int = 6,
) -> None:
    """Writes fresh rows, and of the names that have none those that were kept."""
    kept = read_rows(path, kind) if path.exists() else []
    of_name = {name: [row for row in kept if getattr(row, key) == name] for name in names}
    write_rows(path, kind, [row for name in of_name for row in fresh.get(name, of_name[name])], digits)


@dataclass(frozen=True)
class Found:
    """A case and its rows, as the page asks for them."""

    case: Case
    rows: Sequence[Row]

    @property
    def axes(self) -> list[str]:
        """Names of what is varied."""
        return list(dict.fromkeys(axis.name for axis in self.case.axes))

    @property
    def check(self) -> str:
        """By how much the coarser settings differ from the reference."""
        found = [row.error for row in self.rows if row.part == "check"]
        return ", ".join(f"{error.figure} {error.text()}" for error in found)

    def along(self, axis: str) -> str:
        """Table of errors along an axis, with costs where they are known."""
        return tabled([row for row in self.rows if row.part == axis])

    def on_front(self) -> str:
        """Table of the settings on the front."""
        best = [row.settings for row in self.front(self.case.ranked)]
        rows = [row for row in self.rows if row.part == "front" and row.settings in best]
        return tabled(sorted(rows, key=lambda row: best.index(row.settings)))

    def front(self, figure: str) -> list[Row]:
        """Rows on the front by the error of a figure."""
        return pareto(priced(self.rows, figure))

    def held_on_front(self, figure: str) -> str:
        """How many settings on the front hold wrenches."""
        found = self.front(figure)
        return f"{sum(row.settings.interval > 1 for row in found)} of {len(found)} settings"

    @property
    def pose_of_preset(self) -> float:
        """Error of the pose with the presets' step [mm]."""
        poses = (row for row in self.rows if (row.part, row.error.figure) == ("step", "pose"))
        return next(row.error.mean for row in poses if row.settings == PRESET)

    @property
    def pose_per_ms(self) -> list[float]:
        """Error of the pose by the mean age of the wrenches that act [mm/ms]."""
        poses = (row for row in self.rows if (row.part, row.error.figure) == ("interval", "pose"))
        return [row.error.mean / row.settings.age_ms for row in poses if row.settings.interval > 1]


def tabled(rows: Sequence[Row]) -> str:
    """Errors of all figures, a line for each setting, and costs where some are known."""
    figures = list(dict.fromkeys(row.error.figure for row in rows if row.error != BROKEN))
    works = {row.settings: row.work for row in rows if row.work is not None}
    lines = []
    for settings in dict.fromkeys(row.settings for row in rows):
        found = {row.error.figure: row.error.text() for row in rows if row.settings == settings}
        cells = [found.get(figure, "broke down") for figure in figures]
        work = works.get(settings)
        costs = work.cells() if work else ["–"] * len(COSTS)
        lines.append([settings.text(), *cells, *(costs if works else [])])
    return table(["settings", *figures, *(COSTS if works else [])], lines)


def pages() -> dict[str, str]:
    """The page from the data."""
    return {"performance.md": text(found_cases())}


def figures() -> dict[str, Any]:
    """A figure of each case in which errors are set against cost."""
    return {
        f"performance/{name}.png": figure_of(found.case, found.rows)
        for name, found in found_cases().items()
        if found.case.front
    }


def found_cases() -> dict[str, Found]:
    """All cases with their rows."""
    rows = read_rows(DATA / "errors.csv", Row)
    return {name: Found(case, [row for row in rows if row.case == name]) for name, case in CASES.items()}


def text(cases: Mapping[str, Found]) -> str:
    """The page with these cases."""
    far = read_rows(DATA / "distance.csv", Distance)
    return page(
        HERE / "page.md",
        cases=cases,
        levels=read_json(DATA / "accuracy.json", list[Level]),
        peers=read_rows(DATA / "peers.csv", PeerRun),
        length_mm=MM * LENGTH_M,
        counts=counts.committed(),
        far={(one.step_ms, one.place_m): one.error for one in far if one.error.figure == "stride"},
        steps_ms=STEPS_MS,
        places_m=PLACES_M,
        limit=read_json(DATA / "limit.json", Limit),
    )


STUDY = Study(
    about="how far from converged settings are, and what they cost",
    options=options,
    measure=run,
    pages=pages,
    figures=figures,
)
