"""Means of samples and their bootstrap intervals."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from magworm_gym.learning.results import Interval

CONFIDENCE = 0.95
RESAMPLES = 4000
QUARTER = 0.25
STATISTIC = (
    "Means of fewer than four samples, interquartile means (without the lowest and the highest quarter) of "
    "more, with 95 % percentile bootstrap intervals"
)
"""What an interval is, in words."""


def central_mean(samples: NDArray[np.float64], axis: int = -1) -> Any:
    """Mean without the lowest and the highest quarter; fewer than four samples have none."""
    return stats.trim_mean(samples, QUARTER, axis=axis)


def interval(samples: Sequence[float]) -> Interval:
    """Central mean with a percentile bootstrap interval, always with the same draws.

    Args:
        samples: Independent samples, at least one. A single one has an interval of no width.

    Returns:
        The interval, in the unit of the samples.
    """
    values = np.asarray(samples, dtype=np.float64)
    centre = float(central_mean(values))
    if len(values) < 2 or np.ptp(values) == 0.0:
        return Interval(centre, centre, centre, len(values))
    found = stats.bootstrap(
        (values,),
        central_mean,
        n_resamples=RESAMPLES,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(0),
    ).confidence_interval
    return Interval(centre, float(found.low), float(found.high), len(values))
