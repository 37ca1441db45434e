"""Claims as they stand in a problem file."""

from collections.abc import Mapping, Sequence

from magworm_gym.identification.claims import KINDS, Claim, Curve, Kind, curve_of
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.quantities import MEASURES, Quantity
from magworm_gym.identification.sweep import Sweep
from magworm_gym.identification.table import Table


def read_claim(table: Table, sweeps: Mapping[str, Sweep]) -> Claim:
    """Reads ``{ name, kind, curve, over_m_s, … }``.

    Args:
        table: The table.
        sweeps: Name of a sweep → sweep.

    Raises:
        ProblemError: A value that is not allowed.
    """
    name = table.text("name")
    kind_name = table.choice("kind", "", tuple(KINDS))
    kind = KINDS[kind_name]
    low_m_s, high_m_s = _range(table)
    curves = _curves(table, kind, sweeps)
    other = tuple(_averaged(table, "than", sweeps)) if kind.compares else ()
    if kind_name == "peaks":
        _check_peak(table, curves[0], low_m_s, high_m_s)
    else:
        cut = [tuple(curve.within(low_m_s, high_m_s) for curve in row) for row in (*curves, other)]
        *curves, other = cut
    _check_speeds(table, [*curves, *([other] if other else [])])
    claim = Claim(
        name=name,
        kind=kind_name,
        curves=tuple(curves),
        other=other,
        low_m_s=low_m_s,
        high_m_s=high_m_s,
        amount=table.number(kind.amount, 0.0 if kind.amount == "by" else None),
        within=table.number("within", low=1e-12) if kind.exact else 0.0,
        scale=table.number("scale", low=1e-12),
        group=table.text("group") if table.has("group") else "",
        fitted=table.flag("fit", True),
    )
    table.done()
    return claim


def _range(table: Table) -> tuple[float, float]:
    """Takes ``at_m_s`` or ``over_m_s``."""
    if table.has("at_m_s"):
        speed_m_s = table.number("at_m_s")
        return speed_m_s, speed_m_s
    ends = table.take("over_m_s")
    good = isinstance(ends, list) and len(ends) == 2 and all(isinstance(end, int | float) for end in ends)
    if not good or ends[0] > ends[1]:
        raise table.refusal("over_m_s", ends, "[lowest, highest] speed, or at_m_s in its place")
    return float(ends[0]), float(ends[1])


def _curves(table: Table, kind: Kind, sweeps: Mapping[str, Sweep]) -> list[tuple[Curve, ...]]:
    """Takes ``curve``, the mean of some, or ``curves``, each for itself."""
    if kind.many and table.has("curves"):
        return [(curve,) for curve in _averaged(table, "curves", sweeps)]
    return [tuple(_averaged(table, "curve", sweeps))]


def _averaged(table: Table, key: str, sweeps: Mapping[str, Sweep]) -> list[Curve]:
    names = table.take(key)
    names = [names] if isinstance(names, str) else names
    if not isinstance(names, list) or not names:
        raise table.refusal(key, names, "sweep.quantity, sweep.quantity.magnet, or a list of them")
    return [curve for name in names for curve in _named(table, key, name, sweeps)]


def _named(table: Table, key: str, name: object, sweeps: Mapping[str, Sweep]) -> list[Curve]:
    """The curve ``sweep.quantity.magnet``; with an asterisk at the end of the sweep, all that begin so."""
    words = name.split(".") if isinstance(name, str) else []
    chosen = [sweep for sweep in sweeps.values() if words and _matches(sweep.name, words[0])]
    known = len(words) in (2, 3) and bool(chosen) and words[1] in MEASURES
    if known and len(words) == 3:
        known = words[2].isdecimal() and all(int(words[2]) < sweep.scene.magnets for sweep in chosen)
    if not known:
        allowed = f"sweep.quantity or sweep.quantity.magnet, of {', '.join(sweeps)} and {', '.join(MEASURES)}"
        raise table.refusal(key, name, allowed)
    quantity = Quantity(words[1], int(words[2]) if len(words) == 3 else None)
    return [curve_of(sweep, quantity) for sweep in chosen]


def _matches(name: str, pattern: str) -> bool:
    return name.startswith(pattern[:-1]) if pattern.endswith("*") else name == pattern


def _check_speeds(table: Table, rows: Sequence[Sequence[Curve]]) -> None:
    """Refuses a range without speeds, and curves that are compared at different ones."""
    first = rows[0][0]
    for curve in (curve for row in rows for curve in row):
        if not curve.speeds_m_s:
            raise ProblemError(f"{table.where}: {curve} has no speed in the range; allowed: a range with one")
        if curve.speeds_m_s != first.speeds_m_s:
            raise ProblemError(
                f"{table.where}: {first} and {curve} have other speeds in the range; allowed: the same ones"
            )


def _check_peak(table: Table, row: Sequence[Curve], low_m_s: float, high_m_s: float) -> None:
    inside = [low_m_s <= speed <= high_m_s for speed in row[0].speeds_m_s]
    if all(inside) or not any(inside):
        raise ProblemError(
            f"{table.where}: the range of over_m_s holds all or none of the speeds of {row[0]}; "
            "allowed: a range that some of them lie outside of"
        )
