"""Claims as they stand in a problem file."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal

from msgspec import Meta

from magworm_gym.documents import Number, Table, Text
from magworm_gym.identification.claims import KINDS, Claim, Curve, curve_of
from magworm_gym.identification.experiment_file import Tolerance
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.quantities import MEASURES, named_quantity
from magworm_gym.identification.sweep import Sweep

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


def read_claim(table: ClaimTable, where: str, sweeps: Mapping[str, Sweep]) -> Claim:
    """Makes a claim.

    Args:
        table: Its table.
        where: Its place in the file.
        sweeps: Name of a sweep → sweep.

    Raises:
        ProblemError: A curve that there is not, or a range without the speeds that the claim needs.
    """
    kind, (low_m_s, high_m_s) = KINDS[table.kind], table.range_m_s
    if table.curves is None:
        rows = [_named(table.curve, f"{where}.curve", sweeps)]
    else:
        rows = [[curve] for curve in _named(table.curves, f"{where}.curves", sweeps)]
    other = _named(table.than, f"{where}.than", sweeps) if kind.compares else []
    if table.kind == "peaks":
        _check_peak(rows[0][0], low_m_s, high_m_s, where)
    else:
        *rows, other = ([curve.within(low_m_s, high_m_s) for curve in row] for row in (*rows, other))
    _check_speeds([curve for row in (*rows, other) for curve in row], where)
    return Claim(
        table.name,
        table.kind,
        tuple(map(tuple, rows)),
        tuple(other),
        low_m_s,
        high_m_s,
        table.amount,
        table.within or 0.0 if kind.exact else 0.0,
        table.scale,
        table.group or "",
        table.fit,
    )


def _named(names: str | list[str] | None, where: str, sweeps: Mapping[str, Sweep]) -> list[Curve]:
    """Curves ``sweep.quantity.magnet``; an asterisk at the end of the sweep names all that begin so."""
    curves = []
    for text in [names] if isinstance(names, str) else names or []:
        name, _, rest = text.partition(".")
        chosen = [sweep for sweep in sweeps.values() if _matches(sweep.name, name)]
        quantity = named_quantity(rest, min((sweep.scene.magnets for sweep in chosen), default=0))
        if quantity is None or not chosen:
            raise ProblemError(
                f"{where} is {text!r}; allowed: sweep.quantity or sweep.quantity.magnet, of "
                f"{', '.join(sweeps)} and {', '.join(MEASURES)}"
            )
        curves += [curve_of(sweep, quantity) for sweep in chosen]
    return curves


def _matches(name: str, pattern: str) -> bool:
    return name.startswith(pattern[:-1]) if pattern.endswith("*") else name == pattern


def _check_speeds(curves: Sequence[Curve], where: str) -> None:
    """Refuses a range without speeds, and curves that are compared at different ones."""
    for curve in curves:
        if not curve.speeds_m_s:
            raise ProblemError(f"{where}: {curve} has no speed in the range; allowed: a range with one")
        if curve.speeds_m_s != curves[0].speeds_m_s:
            raise ProblemError(
                f"{where}: {curves[0]} and {curve} have other speeds in the range; allowed: the same ones"
            )


def _check_peak(curve: Curve, low_m_s: float, high_m_s: float, where: str) -> None:
    inside = [low_m_s <= speed <= high_m_s for speed in curve.speeds_m_s]
    if all(inside) or not any(inside):
        raise ProblemError(
            f"{where}: the range of over_m_s holds all or none of the speeds of {curve}; allowed: a range "
            "that some of them lie outside of"
        )
