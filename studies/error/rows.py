"""What is measured of a case: a row for each figure under each of its settings."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from studies.error.case import Case
from studies.error.errors import Error, errors
from studies.error.settings import Settings
from studies.error.work import Work, work


@dataclass(frozen=True)
class Row:
    """A figure's error under some settings, and what they cost; no cost along most axes.

    `part` is what is varied, "step", "elements", "order", "interval" or "precision"; or "front", "check".
    """

    case: str
    part: str
    settings: Settings
    error: Error
    work: Work | None = None


def measure(case: Case, repetitions: int) -> Iterator[Row]:
    """Runs a case with all its settings."""
    found = {settings: case.run(settings) for settings in case.all_settings()}

    def rows(part: str, settings: Settings, reference: Settings, costs: bool) -> Iterator[Row]:
        off = errors(found[settings], found[reference], case.exact if part == "front" else {})
        cost = work(case, settings, repetitions) if costs and found[settings].broken is None else None
        return (Row(case.name, part, settings, error, cost) for error in off)

    for axis in case.axes:
        for settings in axis.values:
            yield from rows(axis.name, settings, axis.reference, axis.costs)
    yield from rows("check", case.check, case.reference, costs=False)
    for settings in case.front:
        yield from rows("front", settings, case.reference, costs=True)


def pareto(rows: Sequence[Row]) -> list[Row]:
    """Rows that no other beats in both error and wall time, cheapest first."""
    best: list[Row] = []
    for row in sorted(rows, key=lambda row: (wall_s(row), row.error.size)):
        if not best or row.error.size < best[-1].error.size:
            best.append(row)
    return best


def wall_s(row: Row) -> float:
    """Wall time of a robot-second on one core [s]."""
    return float("inf") if row.work is None else row.work.wall_s


def priced(rows: Sequence[Row], figure: str) -> list[Row]:
    """Rows of a figure whose errors are set against their cost."""
    return [row for row in rows if (row.part, row.error.figure) == ("front", figure) and row.work]
