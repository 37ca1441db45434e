"""What a robot is to do: a number, a number within bounds, or one number greater than another."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from msgspec import Meta

from magworm_gym.identification.quantities import Quantity
from magworm_gym.identification.residual import guiding
from magworm_gym.recording import Floats, Recording

Tolerance = Annotated[float, Meta(ge=1e-12, le=1e300, description="a number from 1e-12")]
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


class Aim(ABC):
    """Something that recordings are compared with.

    Attributes:
        fitted: Whether it is part of the loss; else it is only reported.
        tolerance: Deviation that counts as one, in the unit of what is measured.
    """

    fitted: bool
    tolerance: float

    @property
    def weight(self) -> float:
        """Number of independent measurements that it counts for [1]."""
        return 1.0

    @property
    def asked(self) -> float | None:
        """The value that is asked for, in the unit of what is measured; None where none is."""
        return None

    @property
    def band(self) -> float:
        """Deviation up to which it is met, in tolerances [1]; nothing of a bound."""
        return 0.0

    @property
    @abstractmethod
    def name(self) -> str:
        """What it is called in a report."""

    @property
    @abstractmethod
    def wanted(self) -> str:
        """What it asks for, in words."""

    @property
    @abstractmethod
    def sources(self) -> frozenset[str]:
        """Names of the experiments and sweeps whose recordings it needs."""

    @abstractmethod
    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """What the model gives, in the unit of what is measured, and deviations (D,) in tolerances [1]."""

    @property
    def allowance(self) -> float:
        """Greatest share of the loss with which it can be met [1]."""
        return float(np.square(guiding(self.band)))

    def residuals(self, recordings: Recordings) -> Floats:
        """Residuals (D,) [1]; their squares add up to its share of the loss, one measurement in all."""
        _, deviations = self.compared(recordings)
        return np.asarray(guiding(deviations) / np.sqrt(deviations.size))

    def outcome(self, recordings: Recordings) -> Outcome:
        """How well it is met."""
        model, deviations = self.compared(recordings)
        worst = float(deviations[np.abs(deviations).argmax()])
        return Outcome(
            name=self.name,
            target=self.wanted,
            model=model,
            error_percent=100.0 * worst * self.tolerance / abs(self.asked) if self.asked else None,
            error_tolerances=worst,
            loss=float(np.square(self.residuals(recordings)).sum()),
            met=abs(worst) <= self.band,
            fitted=self.fitted,
        )


@dataclass(frozen=True)
class Target(Aim):
    """A quantity of one experiment: equal to a value, or within bounds.

    Attributes:
        experiment: Name of the experiment.
        quantity: What is measured.
        low: Least value allowed, in the unit of the quantity; equal to ``high`` for a value.
        high: Greatest value allowed.
        tolerance: See :class:`Aim`; a value is met within one.
        fitted: See :class:`Aim`.
    """

    experiment: str
    quantity: Quantity
    low: float
    high: float
    tolerance: float
    fitted: bool = True

    @property
    def sources(self) -> frozenset[str]:
        """Name of its experiment."""
        return frozenset({self.experiment})

    @property
    def name(self) -> str:
        """Its experiment and quantity."""
        return f"{self.experiment}: {self.quantity}"

    @property
    def asked(self) -> float | None:
        """The value, where bounds are equal."""
        return self.low if self.low == self.high else None

    @property
    def band(self) -> float:
        """One tolerance of a value; nothing of a bound."""
        return 0.0 if self.asked is None else 1.0

    @property
    def wanted(self) -> str:
        """The value, or the bounds that there are."""
        if self.asked is not None:
            return f"{self.low:g} ± {self.tolerance:g}"
        if np.isinf(self.high):
            return f"at least {self.low:g}"
        return f"at most {self.high:g}" if np.isinf(self.low) else f"{self.low:g} to {self.high:g}"

    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """The quantity, and how far outside of the bounds it is (1,)."""
        model = self.quantity.measure(recordings[self.experiment])
        return model, np.array([(model - min(max(model, self.low), self.high)) / self.tolerance])


@dataclass(frozen=True)
class Comparison(Aim):
    """One quantity is greater than another, perhaps of another experiment.

    Attributes:
        greater: Experiment and quantity that is to be the greater one.
        less: Experiment and quantity that is to be the smaller one.
        by: By how much at least, in the unit of the quantities.
        tolerance: See :class:`Aim`.
        fitted: See :class:`Aim`.
    """

    greater: tuple[str, Quantity]
    less: tuple[str, Quantity]
    by: float
    tolerance: float
    fitted: bool = True

    @property
    def sources(self) -> frozenset[str]:
        """Names of both experiments."""
        return frozenset({self.greater[0], self.less[0]})

    @property
    def name(self) -> str:
        """Both quantities."""
        return f"{self.greater[0]}: {self.greater[1]} minus {self.less[0]}: {self.less[1]}"

    @property
    def wanted(self) -> str:
        """The least margin."""
        return f"at least {self.by:g}"

    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """Greater minus smaller, and what that lacks (1,)."""
        greater, less = (quantity.measure(recordings[name]) for name, quantity in (self.greater, self.less))
        return greater - less, np.array([min(greater - less - self.by, 0.0) / self.tolerance])
