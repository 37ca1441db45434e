"""What the Rust tests left: one TOML file for each case, see ``rust/magworm/tests/validation/report.rs``."""

import math
from pathlib import Path

import msgspec

HERE = Path(__file__).parent
DATA = HERE / "data"


class Row(msgspec.Struct, frozen=True, kw_only=True):
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
        return not math.isinf(self.high) or (self.error is None and not math.isinf(self.low))

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


class Table(msgspec.Struct, frozen=True):
    """A table of a case, its numbers already written."""

    caption: str
    head: list[str]
    rows: list[list[str]]


class Curve(msgspec.Struct, frozen=True):
    """Points of the simulator, or of what it is compared with."""

    label: str
    exact: bool
    x: list[float]
    y: list[float]


class Figure(msgspec.Struct, frozen=True, kw_only=True):
    """A figure of a case; ``axes`` is ``log-log``, ``equal`` or ``linear``, ``slope`` the expected one."""

    title: str
    x: str
    y: str
    axes: str
    curves: list[Curve]
    slope: float | None = None


class Case(msgspec.Struct, frozen=True):
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
    tables: list[Table]
    figures: list[Figure]

    @property
    def is_rod(self) -> bool:
        """Whether its scene is the rod that the page shows once, not a preset."""
        return "\n" in self.base

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

    def image(self, index: int) -> str:
        """File of one of its figures below ``docs/images/``."""
        return f"validation/{self.name.replace('_', '-')}-{index + 1}.png"


class Section(msgspec.Struct, frozen=True):
    """A section of the page: its cases, and what each is compared with."""

    title: str
    text: str
    cases: dict[str, str]


def read_sections() -> list[Section]:
    """The order of the page."""
    text = (HERE / "contents.toml").read_text(encoding="utf-8")
    return msgspec.toml.decode(text, type=dict[str, list[Section]])["sections"]


def read_cases(folder: Path = DATA) -> dict[str, Case]:
    """All cases of a folder, by name."""
    found = [msgspec.toml.decode(path.read_bytes(), type=Case) for path in sorted(folder.glob("*.toml"))]
    return {case.name: case for case in found}
