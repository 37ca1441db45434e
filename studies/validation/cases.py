"""What the Rust tests left: one TOML file for each case, see ``rust/magworm/tests/validation/report.rs``."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


@dataclass(frozen=True)
class Row:
    """A measured value, or quantiles of many errors, and the band of it."""

    quantity: str
    unit: str
    measured: list[float]
    expected: list[float]
    quantiles: list[float]
    error_unit: str
    low: float
    high: float
    within: bool
    error: float | None = None

    @property
    def bounded(self) -> bool:
        """Whether it has a band."""
        has_error = self.error is not None
        return not math.isinf(self.high) or (not has_error and not math.isinf(self.low))

    @property
    def is_order(self) -> bool:
        """Whether it is an observed order of convergence."""
        return self.quantity.startswith("order")

    @property
    def share(self) -> float:
        """How much of the band is used up: 1 at its edge; of a band of one value, nothing or too much."""
        if self.error is not None:
            off, half = abs(self.error), self.high
        elif math.isinf(self.low):
            off, half = self.measured[0], self.high
        else:
            off, half = abs(self.measured[0] - (self.low + self.high) / 2), (self.high - self.low) / 2
        return off / half if half else 0.0 if off == 0.0 else math.inf


@dataclass(frozen=True)
class Case:
    """One case of validation."""

    name: str
    test: str
    title: str
    equation: str
    source: str
    base: str
    edits: list[str]
    note: str
    rows: list[Row]
    tables: list[dict[str, Any]]
    figures: list[dict[str, Any]]

    @property
    def failures(self) -> list[str]:
        """Quantities outside of their bands."""
        return [row.quantity for row in self.rows if not row.within]

    @property
    def tightest(self) -> Row | None:
        """The row that uses up most of its band; an order only where there is nothing else."""
        bounded = [row for row in self.rows if row.bounded]
        rows = [row for row in bounded if not row.is_order] or bounded
        return max(rows, key=lambda row: row.share, default=None)

    @property
    def orders(self) -> list[float]:
        """Observed orders of convergence."""
        return [row.measured[0] for row in self.rows if row.is_order]


def read_case(path: Path) -> Case:
    """Reads the file of a case."""
    values = tomllib.loads(path.read_text(encoding="utf-8"))
    rows = [Row(**row) for row in values.pop("rows")]
    return Case(rows=rows, **values)


def read_cases(folder: Path) -> dict[str, Case]:
    """Reads all cases of a folder, by name."""
    cases = [read_case(path) for path in sorted(folder.glob("*.toml"))]
    return {case.name: case for case in cases}
