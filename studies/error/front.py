"""Which settings are worth their time: those that no other beats in both error and cost."""

from collections.abc import Sequence

from studies.error.case import Case
from studies.error.measured import Row


def size(row: Row) -> float:
    """Error of a row without its sign, where the scatter of the runs leaves less than that open."""
    return max(abs(row.error), row.uncertainty)


def cost_s(row: Row) -> float:
    """Wall time of a robot-second on one core [s]."""
    return float("inf") if row.work is None else row.work.wall_s


def pareto(rows: Sequence[Row]) -> list[Row]:
    """Rows that no other beats, cheapest first."""
    best: list[Row] = []
    for row in sorted(rows, key=lambda row: (cost_s(row), size(row))):
        if not best or size(row) < size(best[-1]):
            best.append(row)
    return best


def ranked_of(case: Case, rows: Sequence[Row]) -> str:
    """The figure whose error decides on the front of a case."""
    return case.ranked or next(row.figure for row in rows if row.part == "front" and row.work is not None)


def front_of(rows: Sequence[Row], figure: str) -> list[Row]:
    """Rows of a figure on the front by its error."""
    return pareto(
        [row for row in rows if (row.part, row.figure) == ("front", figure) and row.work is not None]
    )
