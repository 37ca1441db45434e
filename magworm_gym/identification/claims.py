"""Claims about curves: what is said of strides over the speed of the drive, in words or numbers."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.residual import guiding
from magworm_gym.identification.sweep import Sweep
from magworm_gym.identification.targets import Outcome, Recordings

Floats = NDArray[np.float64]

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
class Claim:
    """Something that is said of curves.

    Attributes:
        name: What it is called.
        kind: A key of :data:`KINDS`.
        curves: What it is about, cut to its speeds: K curves, each the mean of some.
        other: The curve that it is compared with where the kind asks for one, the mean of some.
        low_m_s: Least speed of its range [m/s].
        high_m_s: Greatest speed of its range [m/s].
        amount: The number that goes with the kind, in the unit of the quantity, or as a ratio [1].
        within: Deviation up to which a value counts as met; 0 for kinds with a bound.
        scale: Deviation that counts as one in the loss, in the unit of the quantity.
        group: Name of the group that it can be left out with.
        fitted: Whether it is part of the loss.
    """

    name: str
    kind: str
    curves: tuple[tuple[Curve, ...], ...]
    other: tuple[Curve, ...]
    low_m_s: float
    high_m_s: float
    amount: float
    within: float
    scale: float
    group: str = ""
    fitted: bool = True
    weight: float = 1.0

    @property
    def sources(self) -> frozenset[str]:
        """Names of the sweeps that it needs."""
        return frozenset(curve.sweep for row in (*self.curves, self.other) for curve in row)

    @property
    def allowance(self) -> float:
        """Greatest share of the loss with which it can be met [1]: nothing of a bound."""
        return float(np.square(guiding(self.within / self.scale)))

    def means(self, recordings: Recordings) -> Floats:
        """Its curves, averaged over conditions (K, S), in the unit of the quantity."""
        return np.array([_mean(row, recordings) for row in self.curves])

    def compared(self, recordings: Recordings) -> Floats:
        """The other curve (S,), in the unit of the quantity."""
        return _mean(self.other, recordings)

    def spreads(self, recordings: Recordings) -> Floats:
        """Standard deviations over conditions (K, S), the greatest of the curves that a mean is of."""
        return np.array(
            [np.max([curve.values(recordings).std(axis=1) for curve in row], axis=0) for row in self.curves]
        )

    def residuals(self, recordings: Recordings) -> Floats:
        """Residuals (R,) [1]: together they count once, however many speeds a claim is about."""
        _, deviations = KINDS[self.kind].judge(self, recordings)
        return np.asarray(guiding(deviations / self.scale) / np.sqrt(deviations.size))

    def outcome(self, recordings: Recordings) -> Outcome:
        """How well it is met; the model's value is the one that decides."""
        model, deviations = KINDS[self.kind].judge(self, recordings)
        worst = float(deviations[np.abs(deviations).argmax()])
        value = self.within > 0.0
        return Outcome(
            name=self.name,
            target=self._words(),
            model=model,
            error_percent=100.0 * worst / abs(self.amount) if value and self.amount else None,
            error_tolerances=worst / self.scale,
            loss=float(np.square(self.residuals(recordings)).sum()),
            met=abs(worst) <= self.within,
            fitted=self.fitted,
        )

    def _words(self) -> str:
        span = f"{self.low_m_s:g}"
        if self.high_m_s > self.low_m_s:
            span += f" to {self.high_m_s:g}"
        names = [" and ".join(map(str, row)) for row in self.curves]
        curves = ", ".join(names) if len(names) <= MOST_NAMES else f"{names[0]} to {names[-1]}"
        other = " and ".join(map(str, self.other))
        said = KINDS[self.kind].words.format(amount=self.amount, within=self.within, other=other)
        return f"{curves} {said} {span} m/s"


def _mean(curves: tuple[Curve, ...], recordings: Recordings) -> Floats:
    """Mean of curves over conditions (S,)."""
    return np.asarray(np.mean([curve.values(recordings).mean(axis=1) for curve in curves], axis=0))


Judge = Callable[[Claim, Recordings], tuple[float, Floats]]
"""Gives the model's value that decides, and deviations (D,) from the claim: 0 where a bound is kept."""


@dataclass(frozen=True)
class Kind:
    """A kind of claim.

    Attributes:
        judge: What judges it.
        amount: Key of the number that goes with it; empty where there is none.
        words: What it says, as a format of ``amount``, ``within`` and ``other``.
        many: Whether it can be about several curves.
        compares: Whether it is about another curve as well.
        exact: Whether it asks for a value.
    """

    judge: Judge
    amount: str
    words: str
    many: bool = False
    compares: bool = False
    exact: bool = False


def _lacking(margins: Floats) -> Floats:
    """Deviations from margins that must not be negative (D,)."""
    return np.minimum(margins, 0.0).ravel()


def _value(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    means = claim.means(recordings)[0]
    return float(means.mean()), means - claim.amount


def _longest(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    longest = float(claim.means(recordings).max())
    return longest, np.array([longest - claim.amount])


def _at_least(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    means = claim.means(recordings)
    return float(means.min()), _lacking(means - claim.amount)


def _at_most(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    means = claim.means(recordings)
    return float(means.max()), _lacking(claim.amount - means)


def _some_at_least(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    longest = float(claim.means(recordings).max())
    return longest, _lacking(np.array([longest - claim.amount]))


def _rises(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    means = claim.means(recordings)
    change = means[:, -1] - means[:, 0]
    return float(change.min()), _lacking(change - claim.amount)


def _falls(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    means = claim.means(recordings)
    change = means[:, -1] - means[:, 0]
    return float(change.max()), _lacking(-change - claim.amount)


def _greater(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    lead = claim.means(recordings) - claim.compared(recordings)
    return float(lead.min()), _lacking(lead - claim.amount)


def _differs(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    apart = float(np.abs(claim.means(recordings)[0] - claim.compared(recordings)).mean())
    return apart, _lacking(np.array([apart - claim.amount]))


def _nearly_equal(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    means = claim.means(recordings)
    longest, shortest = means.max(axis=0), means.min(axis=0)
    apart = float((longest / np.maximum(shortest, LEAST_M)).max() - 1.0)
    return apart, _lacking((1.0 + claim.amount) * shortest - longest)


def _peaks(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    speeds = np.array(claim.curves[0][0].speeds_m_s)
    means = claim.means(recordings)[0]
    inside = (claim.low_m_s <= speeds) & (speeds <= claim.high_m_s)
    lead = means[inside].max() - means[~inside].max()
    return float(speeds[means.argmax()]), _lacking(np.array([lead - claim.amount]))


def _steady(claim: Claim, recordings: Recordings) -> tuple[float, Floats]:
    spreads = claim.spreads(recordings)
    return float(spreads.max()), _lacking(claim.amount - spreads)


KINDS = {
    "value": Kind(_value, "value", "is {amount:g} ± {within:g} at each speed of", exact=True),
    "longest": Kind(_longest, "value", "has its greatest value at {amount:g} ± {within:g} over", exact=True),
    "at_least": Kind(_at_least, "value", "is at least {amount:g} at each speed of", many=True),
    "at_most": Kind(_at_most, "value", "is at most {amount:g} at each speed of", many=True),
    "some_at_least": Kind(_some_at_least, "value", "is at least {amount:g} at some speed of", many=True),
    "rises": Kind(_rises, "by", "rises by at least {amount:g} over", many=True),
    "falls": Kind(_falls, "by", "falls by at least {amount:g} over", many=True),
    "greater": Kind(_greater, "by", "exceeds {other} by at least {amount:g} at each speed of", compares=True),
    "differs": Kind(
        _differs, "by", "differs from {other} by at least {amount:g} in the mean over", compares=True
    ),
    "nearly_equal": Kind(
        _nearly_equal, "within", "differ by at most {amount:g} of the least over", many=True
    ),
    "peaks": Kind(_peaks, "by", "is greatest, by at least {amount:g}, within"),
    "steady": Kind(_steady, "value", "has a spread over conditions of at most {amount:g} over", many=True),
}
"""Name in a problem file → kind."""
