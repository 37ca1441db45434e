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


@dataclass(frozen=True, kw_only=True)
class Aim(ABC):
    """Something that recordings are compared with.

    Attributes:
        name: What it is called in a report.
        wanted: What it asks for, in words.
        sources: Names of the experiments and sweeps whose recordings it needs.
        tolerance: Deviation that counts as one, in the unit of what is measured.
        fitted: Whether it is part of the loss; else it is only reported.
        band: Deviation up to which it is met, in tolerances [1]; nothing of a bound.
        asked: The value that is asked for, in the unit of what is measured; None where none is.
        weight: Number of independent measurements that it counts for [1].
    """

    name: str
    wanted: str
    sources: frozenset[str]
    tolerance: float
    fitted: bool = True
    band: float = 0.0
    asked: float | None = None
    weight: float = 1.0

    @abstractmethod
    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """What the model gives, in the unit of what is measured, and deviations (D,) in tolerances [1]."""

    @property
    def allowance(self) -> float:
        """Greatest share of the loss with which it can be met [1]."""
        return self.weight * float(np.square(guiding(self.band)))

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

    def refused(self, reason: str) -> Outcome:
        """The outcome where a scene was refused."""
        wanted, nan = "a scene that can be simulated", float("nan")
        return Outcome(self.name, wanted, nan, None, nan, nan, reason, met=False, fitted=self.fitted)


@dataclass(frozen=True, kw_only=True)
class Target(Aim):
    """A quantity of a run: equal to a value, or within bounds; or of one run minus that of another.

    Attributes:
        quantity: Name of the experiment, and what is measured in it.
        minus: The same of what is taken from it, if anything.
        low: Least value allowed, in the unit of the quantity; equal to ``high`` for a value.
        high: Greatest value allowed.
    """

    quantity: tuple[str, Quantity]
    minus: tuple[tuple[str, Quantity], ...]
    low: float
    high: float

    def compared(self, recordings: Recordings) -> tuple[float, Floats]:
        """The quantity, and how far outside of the bounds it is (1,)."""
        measured = [quantity.measure(recordings[name]) for name, quantity in (self.quantity, *self.minus)]
        model = measured[0] - sum(measured[1:])
        return model, np.array([(model - min(max(model, self.low), self.high)) / self.tolerance])


def target(
    quantity: tuple[str, Quantity],
    low: float,
    high: float,
    tolerance: float,
    fitted: bool = True,
    *minus: tuple[str, Quantity],
) -> Target:
    """A target, a value of which is met within one tolerance; see :class:`Target` and :class:`Aim`."""
    all_of_it = (quantity, *minus)
    asked = low if low == high else None
    if asked is not None:
        wanted = f"{low:g} ± {tolerance:g}"
    elif np.isinf(high):
        wanted = f"at least {low:g}"
    else:
        wanted = f"at most {high:g}" if np.isinf(low) else f"{low:g} to {high:g}"
    return Target(
        name=" minus ".join(f"{experiment}: {each}" for experiment, each in all_of_it),
        wanted=wanted,
        sources=frozenset(experiment for experiment, _ in all_of_it),
        tolerance=tolerance,
        fitted=fitted,
        band=0.0 if asked is None else 1.0,
        asked=asked,
        quantity=quantity,
        minus=minus,
        low=low,
        high=high,
    )
