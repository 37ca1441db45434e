"""Learning algorithms on turning, each for the same processor time: ``docs/learners.md``."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from studies.kit.data import read_rows, write_rows
from studies.kit.page import page
from studies.kit.study import Study
from studies.kit.timing import Stopwatch
from studies.learners.runs import ALGORITHMS, MEASURE_S, SETTINGS, STARTS, Run, installed, run

HERE = Path(__file__).parent
RUNS = HERE / "data" / "runs.csv"


def options(parser: argparse.ArgumentParser) -> None:
    """Of the measurement."""
    add = parser.add_argument
    add("--seconds", type=float, default=60.0, help="processor time of each training (default: %(default)s)")
    add("--seeds", type=int, nargs="+", default=[0, 1], help="seeds of each (default: 0 1)")
    add("--algorithms", nargs="+", choices=ALGORITHMS, default=ALGORITHMS, help="default: all")


def measure(arguments: argparse.Namespace) -> None:
    """Trains and measures each algorithm that is installed."""
    said, found = Stopwatch().said, []
    for name in filter(installed, arguments.algorithms):
        for seed in arguments.seeds:
            found.append(run(name, seed, arguments.seconds))
            said(f"{name}, seed {seed}")
    write_rows(RUNS, Run, found)


def pages() -> dict[str, str]:
    """The page from the data."""
    return {"learners.md": text(read_rows(RUNS, Run))}


def text(runs: Sequence[Run]) -> str:
    """The page."""
    missing = [name for name in ALGORITHMS if name not in {run.algorithm for run in runs}]
    return page(
        HERE / "page.md",
        runs=runs,
        missing=missing,
        environment=SETTINGS["default"]["environment_id"],
        starts=STARTS,
        measure_s=MEASURE_S,
    )


STUDY = Study(
    about="learning algorithms on turning at equal processor time",
    options=options,
    measure=measure,
    pages=pages,
)
