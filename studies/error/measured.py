"""All that the study computes, as rows that are written to a file and read back."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from studies.error.case import Case, Outcome
from studies.error.errors import Errors, errors
from studies.error.settings import Settings
from studies.error.work import Work, work


@dataclass(frozen=True)
class Row:
    """One line of the data: a figure's error under some settings.

    Attributes:
        case: Its name.
        part: "axis step", "axis elements", "axis order", "axis interval", "front" or "check".
        settings: Under which.
        figure: Which; "pose" in millimetres, all others relative.
        error: Of the mean over the runs; not a number where the simulation broke down.
        uncertainty: Its standard error over the runs.
        median: Of the absolute errors of single runs.
        work: What it costs; none along most axes.
    """

    case: str
    part: str
    settings: Settings
    figure: str
    error: float
    uncertainty: float
    median: float
    work: Work | None = None


COLUMNS = (
    *("case", "part", "integrator", "step_ms", "elements", "order", "interval", "precision", "figure"),
    *("error", "uncertainty", "median", "wall_s", "steps", "systems", "trials", "wrenches"),
)


def measure(case: Case, repetitions: int) -> list[Row]:
    """Runs a case with all its settings."""
    found: dict[Settings, Outcome] = {}
    for settings in case.all_settings():
        found[settings] = case.run(settings)
    rows = []
    for axis in case.axes:
        for settings in axis.values:
            of = errors(found[settings], found[axis.reference], {})
            cost = work(case, settings, repetitions) if axis.costs and of is not None else None
            rows += _rows(case, f"axis {axis.name}", settings, of, cost)
    reference = found[case.reference]
    rows += _rows(case, "check", case.check, errors(found[case.check], reference, {}), None)
    for settings in case.front:
        of = errors(found[settings], reference, case.exact)
        cost = None if of is None else work(case, settings, repetitions)
        rows += _rows(case, "front", settings, of, cost)
    return rows


def _rows(case: Case, part: str, settings: Settings, found: Errors | None, cost: Work | None) -> list[Row]:
    if found is None:
        nan = float("nan")
        return [Row(case.name, part, settings, "broken", nan, nan, nan)]
    rows = [
        Row(case.name, part, settings, name, figure.mean, figure.uncertainty, figure.median, cost)
        for name, figure in found.figures.items()
    ]
    if found.pose_mm is not None:
        rows.append(Row(case.name, part, settings, "pose", found.pose_mm, 0.0, found.pose_mm, cost))
    return rows


def write(rows: Sequence[Row], path: Path) -> None:
    """Writes rows as comma-separated values."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in rows:
            s, w = row.settings, row.work
            costs = [] if w is None else [w.wall_s, w.steps, w.systems, w.trials, w.wrenches]
            of = [s.integrator, s.step_ms, s.elements, s.order, s.interval, s.precision]
            head = [row.case, row.part, *of, row.figure]
            numbers = [row.error, row.uncertainty, row.median, *costs]
            writer.writerow([*head, *(f"{number:.4g}" for number in numbers)])


def read(path: Path) -> list[Row]:
    """Reads what [`write`] wrote."""
    with path.open(newline="", encoding="utf-8") as file:
        return [_row(values) for values in csv.DictReader(file)]


def _row(values: Mapping[str, str]) -> Row:
    settings = Settings(
        float(values["step_ms"]),
        int(values["elements"]),
        int(values["order"]),
        values["integrator"],
        int(values["interval"]),
        values["precision"],
    )
    costs = [values[name] for name in ("wall_s", "steps", "systems", "trials", "wrenches")]
    return Row(
        case=values["case"],
        part=values["part"],
        settings=settings,
        figure=values["figure"],
        error=float(values["error"]),
        uncertainty=float(values["uncertainty"]),
        median=float(values["median"]),
        work=Work(*map(float, costs)) if costs[0] else None,
    )
