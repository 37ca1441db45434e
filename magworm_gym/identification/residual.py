"""Residuals whose growth is bounded, so that one wild value does not blind the others."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SCALAR_KNEE = 20.0
"""Tolerances beyond which the loss of a scalar target grows linearly: a far-off guide, no outlier."""

TRACK_KNEE = 2.0
"""Tolerances beyond which a tracked point counts as an outlier of the tracking."""


def bounded(deviation: Any, knee: float) -> Floats:
    """Residuals whose squares are the pseudo-Huber loss 2 k² (√(1 + (d/k)²) − 1) [1].

    Args:
        deviation: Deviations in tolerances, of any shape [1].
        knee: Where the square turns into a straight line [1].

    Returns:
        Residuals with the sign of the deviation: the deviation itself where it is small.
    """
    deviation = np.asarray(deviation, np.float64)
    loss = 2.0 * knee**2 * (np.sqrt(1.0 + (deviation / knee) ** 2) - 1.0)
    return np.asarray(np.sign(deviation) * np.sqrt(loss))
