"""Claims as they stand in a problem file, and the curves that they name."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from magworm_gym.identification.claims import Claim, ClaimTable, Curve, claim
from magworm_gym.identification.mistake import ProblemError
from magworm_gym.identification.quantities import MEASURES, named_quantity
from magworm_gym.identification.sweep import Sweep


def read_claim(table: ClaimTable, where: str, sweeps: Mapping[str, Sweep]) -> Claim:
    """The claim of a table that stands at a place of the file, about curves of sweeps by name.

    Raises:
        ProblemError: A curve that there is not, or a range without the speeds that the claim needs.
    """
    low_m_s, high_m_s = table.range_m_s
    if table.curves is None:
        rows = [_named(table.curve, f"{where}.curve", sweeps)]
    else:
        rows = [[curve] for curve in _named(table.curves, f"{where}.curves", sweeps)]
    other = _named(table.than, f"{where}.than", sweeps)
    if table.kind == "peaks":
        _check_peak(rows[0][0], low_m_s, high_m_s, where)
    else:
        *rows, other = (
            [replace(curve, low_m_s=low_m_s, high_m_s=high_m_s) for curve in row] for row in (*rows, other)
        )
    _check_speeds([curve for row in (*rows, other) for curve in row], where)
    return claim(table, tuple(map(tuple, rows)), tuple(other))


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
        curves += [Curve(sweep, quantity) for sweep in chosen]
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
