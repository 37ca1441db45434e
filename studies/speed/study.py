"""Environment steps per second, beside the errors of the steps they are taken with: ``docs/speed.md``."""

import argparse
from pathlib import Path

from studies.error.levels import Level
from studies.error.rows import Row
from studies.error.settings import Settings
from studies.error.study import DATA as ERROR_DATA
from studies.kit.data import read_json, read_rows, write_rows
from studies.kit.page import page, table
from studies.kit.study import Study
from studies.kit.words import thousands
from studies.needs import counts
from studies.speed.rates import CONTROL_STEPS, ENVIRONMENTS, TASKS, WAYS, Rate, rates

HERE = Path(__file__).parent
RATES = HERE / "data" / "rates.csv"
STEPS_MS = (5.0, 2.0, 1.0, 0.5)


def options(parser: argparse.ArgumentParser) -> None:
    """Of the measurement."""
    parser.add_argument("--repetitions", type=int, default=7, help="runs whose median is taken")
    parser.add_argument("--out", type=Path, default=RATES, help="CSV file to write; the page's by default")


def measure(arguments: argparse.Namespace) -> None:
    """Times the environments, prints a table and writes it."""
    found = list(rates(arguments.repetitions))
    print(rates_table(found))
    write_rows(arguments.out, Rate, found)


def rates_table(found: list[Rate]) -> str:
    """Environment steps per second of all ways, in the plane and in space."""
    cells = {(rate.way, rate.dimensions): rate_cells(rate) for rate in found}
    head = [cell for name in ("plane", "space") for cell in (name, "systems, trials")]
    lines = [[way.text(), *(cell for of in TASKS for cell in cells[way, of])] for way in WAYS]
    return table(["environment steps/s", *head], lines)


def rate_cells(rate: Rate) -> list[str]:
    """Speed with its range, and counted work."""
    speeds = [thousands(speed) for speed in (rate.median, rate.least, rate.most)]
    return [f"{speeds[0]} ({speeds[1]} to {speeds[2]})", f"{rate.systems:.2f}, {rate.trials:.2f}"]


def pages() -> dict[str, str]:
    """The page from the data of this study and of the error."""
    rows = read_rows(ERROR_DATA / "errors.csv", Row)
    along = [row for row in rows if row.part == "step"]
    text = page(
        HERE / "page.md",
        rates=rates_table(read_rows(RATES, Rate)),
        environments=ENVIRONMENTS,
        control_steps=CONTROL_STEPS,
        steps_ms=STEPS_MS,
        errors={
            (row.case, row.error.figure, step_ms): row.error
            for row in along
            for step_ms in STEPS_MS
            if row.settings == Settings(step_ms)
        },
        levels=read_json(ERROR_DATA / "accuracy.json", list[Level]),
        counts=counts.committed(),
    )
    return {"speed.md": text}


STUDY = Study(
    about="environment steps per second, and what a longer step costs in accuracy",
    options=options,
    measure=measure,
    pages=pages,
)
