"""Kinds of claims: what is compared with what is said of a curve."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym.recording import Floats

LEAST_M = 1e-6
"""Strides shorter than this are no ground for a ratio [m]."""


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
    def longest(self) -> Floats:
        """Greatest of the curves at each speed (S,)."""
        return np.asarray(self.means.max(axis=0))

    @property
    def shortest(self) -> Floats:
        """Least of the curves at each speed (S,)."""
        return np.asarray(self.means.min(axis=0))

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
    "value": Kind("value", "is {amount:g} ± {within:g} at each speed of", exact=True,
        model=lambda t: t.means[0].mean(), margins=lambda t: t.means[0] - t.amount),
    "longest": Kind("value", "has its greatest value at {amount:g} ± {within:g} over", exact=True,
        model=lambda t: t.means.max(), margins=lambda t: t.means.max() - t.amount),
    "at_least": Kind("value", "is at least {amount:g} at each speed of", many=True,
        model=lambda t: t.means.min(), margins=lambda t: t.means - t.amount),
    "at_most": Kind("value", "is at most {amount:g} at each speed of", many=True,
        model=lambda t: t.means.max(), margins=lambda t: t.amount - t.means),
    "some_at_least": Kind("value", "is at least {amount:g} at some speed of", many=True,
        model=lambda t: t.means.max(), margins=lambda t: t.means.max() - t.amount),
    "rises": Kind("by", "rises by at least {amount:g} over", many=True,
        model=lambda t: t.change.min(), margins=lambda t: t.change - t.amount),
    "falls": Kind("by", "falls by at least {amount:g} over", many=True,
        model=lambda t: t.change.max(), margins=lambda t: -t.change - t.amount),
    "greater": Kind("by", "exceeds {other} by at least {amount:g} at each speed of", compares=True,
        model=lambda t: (t.means - t.other).min(), margins=lambda t: t.means - t.other - t.amount),
    "differs": Kind("by", "differs from {other} by at least {amount:g} in the mean over", compares=True,
        model=lambda t: t.apart, margins=lambda t: t.apart - t.amount),
    "nearly_equal": Kind("within", "differ by at most {amount:g} of the least over", many=True,
        model=lambda t: (t.longest / np.maximum(t.shortest, LEAST_M)).max() - 1.0,
        margins=lambda t: (1.0 + t.amount) * t.shortest - t.longest),
    "peaks": Kind("by", "is greatest, by at least {amount:g}, within",
        model=lambda t: t.speeds_m_s[t.means[0].argmax()],
        margins=lambda t: t.means[0][t.inside].max() - t.means[0][~t.inside].max() - t.amount),
    "steady": Kind("value", "has a spread over conditions of at most {amount:g} over", many=True, spread=True,
        model=lambda t: t.means.max(), margins=lambda t: t.amount - t.means),
}  # fmt: skip
"""Name in a problem file → kind."""
