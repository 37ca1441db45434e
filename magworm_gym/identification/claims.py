"""Claims about curves: what is said of strides over the speed of the drive, in words or numbers."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Literal

import numpy as np
from msgspec import Meta

from magworm_gym.documents import Number, Table, Text
from magworm_gym.identification.claim_kinds import KINDS, Told
from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.sweep import Sweep
from magworm_gym.identification.targets import Aim, Recordings, Tolerance
from magworm_gym.recording import Floats

MOST_NAMES = 4
"""Most curves that are named one by one."""

NAMES = "sweep.quantity, sweep.quantity.magnet, or a list of them"
RANGE = "[lowest, highest] speed, or at_m_s in its place"
OF_KINDS = {
    "curve": NAMES,
    "curves": NAMES,
    "than": NAMES,
    "value": "a number",
    "by": "a number",
    "within": "a number",
}
"""Entries that some kinds need and others do not have, and what they allow."""

LEAST_BAND = 1e-12

Names = Annotated[str | list[str], Meta(description=NAMES)]


class ClaimTable(Table, frozen=True):
    """A claim, see :class:`Claim`; which of its entries there are hangs on its kind."""

    name: Text
    kind: Literal[
        "value", "longest", "at_least", "at_most", "some_at_least", "rises", "falls", "greater", "differs",
        "nearly_equal", "peaks", "steady",
    ]  # fmt: skip
    scale: Tolerance
    curve: Names | None = None
    curves: Names | None = None
    than: Names | None = None
    at_m_s: Number | None = None
    over_m_s: Annotated[tuple[Number, Number], Meta(description=RANGE)] | None = None
    value: Number | None = None
    by: Number | None = None
    within: Number | None = None
    group: Text | None = None
    fit: bool = True

    def __post_init__(self) -> None:
        """Refuses entries that do not go with its kind, and what is missing of them."""
        kind = KINDS[self.kind]
        curve = "curves" if kind.many and self.curves is not None else "curve"
        needed = {curve, kind.amount, *["within"] * kind.exact, *["than"] * kind.compares}
        for name, allowed in OF_KINDS.items():
            value = getattr(self, name)
            if value in (None, "", []) and name in needed - {"by"}:
                raise ValueError(f"{name} is missing; allowed: {allowed}")
            if value is not None and name not in needed:
                others = ", ".join(sorted(needed))
                raise ValueError(f"{name} is not a setting of kind {self.kind!r}; allowed here: {others}")
        if kind.exact and (self.within or 0.0) < LEAST_BAND:
            raise ValueError(f"within is {self.within}; allowed: a number from {LEAST_BAND:g}")
        if (self.at_m_s is None) == (self.over_m_s is None) or self.range_m_s[0] > self.range_m_s[1]:
            raise ValueError(f"over_m_s is {self.over_m_s}; allowed: {RANGE}")

    @property
    def range_m_s(self) -> tuple[float, float]:
        """Least and greatest speed [m/s]."""
        return self.over_m_s or (self.at_m_s or 0.0, self.at_m_s or 0.0)

    @property
    def amount(self) -> float:
        """The number that goes with the kind."""
        return float(getattr(self, KINDS[self.kind].amount) or 0.0)


@dataclass(frozen=True)
class Curve:
    """A quantity of a sweep over a range of speeds of the drive, both ends included.

    Attributes:
        sweep: The sweep.
        quantity: What is measured. A stride is the way against the motion of the drive, on a belt for each
            pass.
        low_m_s: Least speed of the range [m/s].
        high_m_s: Greatest speed of the range [m/s].
    """

    sweep: Sweep
    quantity: Quantity
    low_m_s: float = 0.0
    high_m_s: float = np.inf

    @cached_property
    def places(self) -> list[int]:
        """Places of its speeds (S) among those of the sweep."""
        speeds_m_s = self.sweep.speeds_m_s
        return [at for at, speed in enumerate(speeds_m_s) if self.low_m_s <= speed <= self.high_m_s]

    @property
    def speeds_m_s(self) -> tuple[float, ...]:
        """Its speeds (S,) [m/s]."""
        return tuple(self.sweep.speeds_m_s[at] for at in self.places)

    def values(self, recordings: Recordings) -> Floats:
        """The quantity at each speed and condition (S, C), in its unit."""
        lanes = [self.sweep.lanes[at] for at in self.places]
        measured = np.array([[self.quantity.measure(recordings[lane.name]) for lane in row] for row in lanes])
        if self.quantity.kind != "stride_m":
            return measured
        passes = 1 if self.sweep.belt is None else self.sweep.belt.count
        return np.asarray((-1.0 if self.sweep.backward else 1.0) / passes * measured)

    def __str__(self) -> str:
        return f"{self.sweep.name}.{self.quantity}"


@dataclass(frozen=True, kw_only=True)
class Claim(Aim):
    """Something that is said of curves.

    Attributes:
        table: What a problem file says.
        curves: What it is about, cut to its speeds: K curves, each the mean of some.
        other: The curve that it is compared with where the kind asks for one, the mean of some.
    """

    table: ClaimTable
    curves: tuple[tuple[Curve, ...], ...]
    other: tuple[Curve, ...]

    def means(self, recordings: Recordings) -> Floats:
        """Its curves, averaged over conditions (K, S), in the unit of the quantity."""
        return np.array([_over_conditions(row, recordings, np.mean, np.mean) for row in self.curves])

    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """The value that decides, and deviations (D,): 0 where a bound is kept."""
        kind, (low_m_s, high_m_s) = KINDS[self.table.kind], self.table.range_m_s
        speeds_m_s = np.array(self.curves[0][0].speeds_m_s)
        spreads = [_over_conditions(row, recordings, np.std, np.max) for row in self.curves if kind.spread]
        told = Told(
            means=np.array(spreads) if kind.spread else self.means(recordings),
            other=_over_conditions(self.other, recordings, np.mean, np.mean) if self.other else np.empty(0),
            speeds_m_s=speeds_m_s,
            inside=(low_m_s <= speeds_m_s) & (speeds_m_s <= high_m_s),
            amount=self.table.amount,
        )
        margins = np.ravel(kind.margins(told))
        deviations = margins if kind.exact else np.minimum(margins, 0.0)
        return float(kind.model(told)), deviations / self.table.scale


def _over_conditions(
    curves: tuple[Curve, ...], recordings: Recordings, over: Callable[..., Floats], of: Callable[..., Floats]
) -> Floats:
    """A statistic over conditions of each curve, and one of those of all curves (S,)."""
    return np.asarray(of([over(curve.values(recordings), axis=1) for curve in curves], axis=0))


def claim(table: ClaimTable, curves: tuple[tuple[Curve, ...], ...], other: tuple[Curve, ...]) -> Claim:
    """The claim of a table about curves; for its arguments see :class:`Claim`."""
    kind, (low_m_s, high_m_s) = KINDS[table.kind], table.range_m_s
    names = [" and ".join(map(str, row)) for row in curves]
    about = ", ".join(names) if len(names) <= MOST_NAMES else f"{names[0]} to {names[-1]}"
    than = " and ".join(map(str, other))
    said = kind.words.format(amount=table.amount, within=table.within, other=than)
    span = f"{low_m_s:g} to {high_m_s:g}" if high_m_s > low_m_s else f"{low_m_s:g}"
    return Claim(
        name=table.name,
        wanted=f"{about} {said} {span} m/s",
        sources=frozenset(curve.sweep.name for row in (*curves, other) for curve in row),
        tolerance=table.scale,
        fitted=table.fit,
        band=(table.within or 0.0) / table.scale if kind.exact else 0.0,
        asked=table.amount if kind.exact else None,
        table=table,
        curves=curves,
        other=other,
    )
