"""What a robot is to do: a number, a number within bounds, or one number greater than another."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.residual import guiding
from magworm_gym.recording import Recording

Floats = NDArray[np.float64]
Recordings = Mapping[str, Recording]
"""Name of an experiment, or of a robot of a sweep → what it gave."""


@dataclass(frozen=True)
class Outcome:
    """How well a target is met.

    Attributes:
        name: Experiment and quantity.
        target: What was asked for, in words.
        model: What the model gives, in the unit of the quantity.
        error_percent: Deviation from the value asked for [%]; None where none was.
        error_tolerances: Deviation in tolerances [1]; 0 where bounds are kept.
        loss: Its share of the loss [1].
        remark: More, in words; may be empty.
        met: Whether it counts as met.
        fitted: Whether it is part of the loss; else it is only reported.
    """

    name: str
    target: str
    model: float
    error_percent: float | None
    error_tolerances: float
    loss: float
    remark: str = ""
    met: bool = True
    fitted: bool = True


class Aim(Protocol):
    """Something that recordings are compared with."""

    @property
    def name(self) -> str:
        """What it is called in a report."""

    @property
    def weight(self) -> float:
        """Number of independent measurements that it counts for [1]."""

    @property
    def fitted(self) -> bool:
        """Whether it is part of the loss; else it is only reported."""

    @property
    def sources(self) -> frozenset[str]:
        """Names of the experiments and sweeps whose recordings it needs."""

    @property
    def allowance(self) -> float:
        """Greatest share of the loss with which it can be met [1]."""

    def residuals(self, recordings: Recordings) -> Floats:
        """Residuals (R,) [1]; their squares add up to the loss."""

    def outcome(self, recordings: Recordings) -> Outcome:
        """How well it is met."""


@dataclass(frozen=True)
class Target:
    """A quantity of one experiment: equal to a value, or within bounds.

    Attributes:
        experiment: Name of the experiment.
        quantity: What is measured.
        low: Least value allowed, in the unit of the quantity; equal to ``high`` for a value.
        high: Greatest value allowed.
        tolerance: Deviation that counts as one, in the unit of the quantity.
        fitted: Whether it is part of the loss.
    """

    experiment: str
    quantity: Quantity
    low: float
    high: float
    tolerance: float
    fitted: bool = True
    weight: float = 1.0

    @property
    def sources(self) -> frozenset[str]:
        """Name of its experiment."""
        return frozenset({self.experiment})

    @property
    def name(self) -> str:
        """Its experiment and quantity."""
        return f"{self.experiment}: {self.quantity}"

    @property
    def allowance(self) -> float:
        """One tolerance of a value; nothing of a bound."""
        return 1.0 if self.low == self.high else 0.0

    def deviation(self, recordings: Recordings) -> float:
        """How far outside of the bounds the model is, in tolerances [1]."""
        model = self.quantity.measure(recordings[self.experiment])
        return (model - min(max(model, self.low), self.high)) / self.tolerance

    def residuals(self, recordings: Recordings) -> Floats:
        """Residual (1,) [1]."""
        return guiding([self.deviation(recordings)])

    def outcome(self, recordings: Recordings) -> Outcome:
        """How well it is met."""
        model, deviation = self.quantity.measure(recordings[self.experiment]), self.deviation(recordings)
        percent = None
        if self.low == self.high and self.low != 0.0:
            percent = 100.0 * (model - self.low) / abs(self.low)
        loss = float(np.square(self.residuals(recordings)).sum())
        return Outcome(
            name=self.name,
            target=self._words(),
            model=model,
            error_percent=percent,
            error_tolerances=deviation,
            loss=loss,
            met=abs(deviation) <= self.allowance,
            fitted=self.fitted,
        )

    def _words(self) -> str:
        if self.low == self.high:
            return f"{self.low:g} ± {self.tolerance:g}"
        if np.isinf(self.high):
            return f"at least {self.low:g}"
        if np.isinf(self.low):
            return f"at most {self.high:g}"
        return f"{self.low:g} to {self.high:g}"


@dataclass(frozen=True)
class Comparison:
    """One quantity is greater than another, perhaps of another experiment.

    Attributes:
        greater: Experiment and quantity that is to be the greater one.
        less: Experiment and quantity that is to be the smaller one.
        by: By how much at least, in the unit of the quantities.
        tolerance: Deviation that counts as one, in the unit of the quantities.
        fitted: Whether it is part of the loss.
    """

    greater: tuple[str, Quantity]
    less: tuple[str, Quantity]
    by: float
    tolerance: float
    fitted: bool = True
    weight: float = 1.0
    allowance: float = 0.0

    @property
    def sources(self) -> frozenset[str]:
        """Names of both experiments."""
        return frozenset({self.greater[0], self.less[0]})

    @property
    def name(self) -> str:
        """Both quantities."""
        return f"{self.greater[0]}: {self.greater[1]} minus {self.less[0]}: {self.less[1]}"

    def margin(self, recordings: Recordings) -> float:
        """Greater minus smaller, in the unit of the quantities."""
        (first, great), (second, small) = self.greater, self.less
        return great.measure(recordings[first]) - small.measure(recordings[second])

    def deviation(self, recordings: Recordings) -> float:
        """What the margin lacks, in tolerances; not positive [1]."""
        return min(self.margin(recordings) - self.by, 0.0) / self.tolerance

    def residuals(self, recordings: Recordings) -> Floats:
        """Residual (1,) [1]."""
        return guiding([self.deviation(recordings)])

    def outcome(self, recordings: Recordings) -> Outcome:
        """How well it is met; the model's value is the margin."""
        loss = float(np.square(self.residuals(recordings)).sum())
        deviation = self.deviation(recordings)
        return Outcome(
            name=self.name,
            target=f"at least {self.by:g}",
            model=self.margin(recordings),
            error_percent=None,
            error_tolerances=deviation,
            loss=loss,
            met=deviation == 0.0,
            fitted=self.fitted,
        )
