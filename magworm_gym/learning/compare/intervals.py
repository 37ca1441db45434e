"""Interquartile means and their bootstrap intervals."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

CONFIDENCE = 0.95
RESAMPLES = 4000
QUARTER = 0.25


@dataclass(frozen=True)
class Interval:
    """A value and its 95 % confidence interval.

    Attributes:
        value: Interquartile mean.
        low: Lower end.
        high: Upper end.
        count: Number of samples.
    """

    value: float
    low: float
    high: float
    count: int

    def scaled(self, factor: float) -> "Interval":
        """The interval in another unit."""
        return Interval(self.value * factor, self.low * factor, self.high * factor, self.count)


def interquartile_mean(samples: NDArray[np.float64], axis: int = -1) -> Any:
    """Mean without the lowest and the highest quarter; the plain mean of fewer than four samples."""
    return stats.trim_mean(samples, QUARTER, axis=axis)


def interval(samples: Sequence[float]) -> Interval:
    """Interquartile mean with a percentile bootstrap interval, always with the same draws.

    Args:
        samples: Independent samples, at least one. A single one has an interval of no width.

    Returns:
        The interval, in the unit of the samples.
    """
    values = np.asarray(samples, dtype=np.float64)
    centre = float(interquartile_mean(values))
    if len(values) < 2 or np.ptp(values) == 0.0:
        return Interval(centre, centre, centre, len(values))
    found = stats.bootstrap(
        (values,),
        interquartile_mean,
        n_resamples=RESAMPLES,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(0),
    ).confidence_interval
    return Interval(centre, float(found.low), float(found.high), len(values))
