"""Claims about curves: what is said of strides over the speed of the drive, in words or numbers."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.sweep import Sweep
from magworm_gym.identification.targets import Aim, Recordings
from magworm_gym.recording import Floats

MOST_NAMES = 4
"""Most curves that are named one by one."""

LEAST_M = 1e-6
"""Strides shorter than this are no ground for a ratio [m]."""


@dataclass(frozen=True)
class Curve:
    """A quantity of a sweep over the speed of the drive.

    Attributes:
        sweep: Name of the sweep.
        quantity: What is measured. A stride is the way against the motion of the drive, on a belt for each
            pass.
        speeds_m_s: Speeds (S,) [m/s].
        lanes: Names of the recordings at each speed, one for each condition (S, C).
        sign: −1 for strides where the drive moves from tail to head, else 1.
        passes: Passes that a stride is divided by.
    """

    sweep: str
    quantity: Quantity
    speeds_m_s: tuple[float, ...]
    lanes: tuple[tuple[str, ...], ...]
    sign: float = 1.0
    passes: int = 1

    def values(self, recordings: Recordings) -> Floats:
        """The quantity at each speed and condition (S, C), in its unit."""
        measured = [[self.quantity.measure(recordings[name]) for name in names] for names in self.lanes]
        return self.sign / self.passes * np.array(measured)

    def within(self, low_m_s: float, high_m_s: float) -> "Curve":
        """The part of it in a range of speeds, both ends included."""
        kept = [at for at, speed in enumerate(self.speeds_m_s) if low_m_s <= speed <= high_m_s]
        return replace(
            self,
            speeds_m_s=tuple(self.speeds_m_s[at] for at in kept),
            lanes=tuple(self.lanes[at] for at in kept),
        )

    def __str__(self) -> str:
        return f"{self.sweep}.{self.quantity}"


def curve_of(sweep: Sweep, quantity: Quantity) -> Curve:
    """The curve of a quantity over the speeds of a sweep."""
    stride = quantity.kind == "stride_m"
    return Curve(
        sweep.name,
        quantity,
        sweep.speeds_m_s,
        tuple(tuple(lane.name for lane in lanes) for lanes in sweep.lanes),
        -1.0 if stride and sweep.backward else 1.0,
        sweep.belt.count if stride and sweep.belt is not None else 1,
    )


@dataclass(frozen=True)
class Claim(Aim):
    """Something that is said of curves.

    Attributes:
        title: What it is called.
        kind: A key of :data:`KINDS`.
        curves: What it is about, cut to its speeds: K curves, each the mean of some.
        other: The curve that it is compared with where the kind asks for one, the mean of some.
        low_m_s: Least speed of its range [m/s].
        high_m_s: Greatest speed of its range [m/s].
        amount: The number that goes with the kind, in the unit of the quantity, or as a ratio [1].
        within: Deviation up to which a value counts as met; 0 for kinds with a bound.
        tolerance: See :class:`Aim`; ``scale`` in a problem file.
        group: Name of the group that it can be left out with.
        fitted: See :class:`Aim`.
    """

    title: str
    kind: str
    curves: tuple[tuple[Curve, ...], ...]
    other: tuple[Curve, ...]
    low_m_s: float
    high_m_s: float
    amount: float
    within: float
    tolerance: float
    group: str = ""
    fitted: bool = True

    @property
    def name(self) -> str:
        """Its title."""
        return self.title

    @property
    def sources(self) -> frozenset[str]:
        """Names of the sweeps that it needs."""
        return frozenset(curve.sweep for row in (*self.curves, self.other) for curve in row)

    @property
    def asked(self) -> float | None:
        """The value, where the kind asks for one."""
        return self.amount if self.within > 0.0 else None

    @property
    def band(self) -> float:
        """How far a value may be off; nothing of a bound."""
        return self.within / self.tolerance

    def means(self, recordings: Recordings) -> Floats:
        """Its curves, averaged over conditions (K, S), in the unit of the quantity."""
        return np.array([_over_conditions(row, recordings, np.mean, np.mean) for row in self.curves])

    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """The value that decides, and deviations (D,): 0 where a bound is kept."""
        kind = KINDS[self.kind]
        speeds_m_s = np.array(self.curves[0][0].speeds_m_s)
        told = Told(
            means=self.means(recordings),
            other=_over_conditions(self.other, recordings, np.mean, np.mean) if self.other else np.empty(0),
            speeds_m_s=speeds_m_s,
            inside=(self.low_m_s <= speeds_m_s) & (speeds_m_s <= self.high_m_s),
            amount=self.amount,
        )
        if kind.spread:
            spreads = [_over_conditions(row, recordings, np.std, np.max) for row in self.curves]
            told = replace(told, means=np.array(spreads))
        margins = np.ravel(kind.margins(told))
        deviations = margins if kind.exact else np.minimum(margins, 0.0)
        return float(kind.model(told)), deviations / self.tolerance

    @property
    def wanted(self) -> str:
        """Its curves and what is said of them."""
        span = f"{self.low_m_s:g}"
        if self.high_m_s > self.low_m_s:
            span += f" to {self.high_m_s:g}"
        names = [" and ".join(map(str, row)) for row in self.curves]
        curves = ", ".join(names) if len(names) <= MOST_NAMES else f"{names[0]} to {names[-1]}"
        other = " and ".join(map(str, self.other))
        said = KINDS[self.kind].words.format(amount=self.amount, within=self.within, other=other)
        return f"{curves} {said} {span} m/s"


def _over_conditions(
    curves: tuple[Curve, ...], recordings: Recordings, over: Callable[..., Floats], of: Callable[..., Floats]
) -> Floats:
    """A statistic over conditions of each curve, and one of those of all curves (S,)."""
    return np.asarray(of([over(curve.values(recordings), axis=1) for curve in curves], axis=0))


@dataclass(frozen=True)
class Told:
    """What a claim is judged by.

    Attributes:
        means: Curves, averaged over conditions (K, S), or their spreads, in the unit of the quantity.
        other: The curve that they are compared with (S,).
        speeds_m_s: Speeds (S,) [m/s].
        inside: Which of them lie in the range (S,).
        amount: The number that goes with the kind.
    """

    means: Floats
    other: Floats
    speeds_m_s: Floats
    inside: NDArray[np.bool_]
    amount: float

    @property
    def change(self) -> Floats:
        """Last minus first value of each curve (K,)."""
        return np.asarray(self.means[:, -1] - self.means[:, 0])

    @property
    def apart(self) -> float:
        """Mean distance of the first curve from the other."""
        return float(np.abs(self.means[0] - self.other).mean())


@dataclass(frozen=True)
class Kind:
    """A kind of claim.

    Attributes:
        amount: Key of the number that goes with it.
        words: What it says, as a format of ``amount``, ``within`` and ``other``.
        model: The model's value that decides.
        margins: Margins that must not be negative, of any shape; deviations where a value is asked for.
        many: Whether it can be about several curves.
        compares: Whether it is about another curve as well.
        exact: Whether it asks for a value.
        spread: Whether it is about the spread over conditions, in place of the mean.
    """

    amount: str
    words: str
    model: Callable[[Told], Any]
    margins: Callable[[Told], Any]
    many: bool = False
    compares: bool = False
    exact: bool = False
    spread: bool = False


KINDS = {
    "value": Kind(
        "value",
        "is {amount:g} ± {within:g} at each speed of",
        lambda t: t.means[0].mean(),
        lambda t: t.means[0] - t.amount,
        exact=True,
    ),
    "longest": Kind(
        "value",
        "has its greatest value at {amount:g} ± {within:g} over",
        lambda t: t.means.max(),
        lambda t: t.means.max() - t.amount,
        exact=True,
    ),
    "at_least": Kind(
        "value",
        "is at least {amount:g} at each speed of",
        lambda t: t.means.min(),
        lambda t: t.means - t.amount,
        many=True,
    ),
    "at_most": Kind(
        "value",
        "is at most {amount:g} at each speed of",
        lambda t: t.means.max(),
        lambda t: t.amount - t.means,
        many=True,
    ),
    "some_at_least": Kind(
        "value",
        "is at least {amount:g} at some speed of",
        lambda t: t.means.max(),
        lambda t: t.means.max() - t.amount,
        many=True,
    ),
    "rises": Kind(
        "by",
        "rises by at least {amount:g} over",
        lambda t: t.change.min(),
        lambda t: t.change - t.amount,
        many=True,
    ),
    "falls": Kind(
        "by",
        "falls by at least {amount:g} over",
        lambda t: t.change.max(),
        lambda t: -t.change - t.amount,
        many=True,
    ),
    "greater": Kind(
        "by",
        "exceeds {other} by at least {amount:g} at each speed of",
        lambda t: (t.means - t.other).min(),
        lambda t: t.means - t.other - t.amount,
        compares=True,
    ),
    "differs": Kind(
        "by",
        "differs from {other} by at least {amount:g} in the mean over",
        lambda t: t.apart,
        lambda t: t.apart - t.amount,
        compares=True,
    ),
    "nearly_equal": Kind(
        "within",
        "differ by at most {amount:g} of the least over",
        lambda t: (t.means.max(axis=0) / np.maximum(t.means.min(axis=0), LEAST_M)).max() - 1.0,
        lambda t: (1.0 + t.amount) * t.means.min(axis=0) - t.means.max(axis=0),
        many=True,
    ),
    "peaks": Kind(
        "by",
        "is greatest, by at least {amount:g}, within",
        lambda t: t.speeds_m_s[t.means[0].argmax()],
        lambda t: t.means[0][t.inside].max() - t.means[0][~t.inside].max() - t.amount,
    ),
    "steady": Kind(
        "value",
        "has a spread over conditions of at most {amount:g} over",
        lambda t: t.means.max(),
        lambda t: t.amount - t.means,
        many=True,
        spread=True,
    ),
}
"""Name in a problem file → kind."""
