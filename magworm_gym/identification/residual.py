"""Residuals whose growth is bounded, so that one wild value does not blind the others."""

from typing import Any

import numpy as np

from magworm_gym.recording import Floats

SCALAR_KNEE = 20.0
"""Tolerances beyond which the loss of a scalar target grows with the logarithm only [1]."""

TRACK_KNEE = 2.0
"""Tolerances beyond which a tracked point counts as an outlier of the tracking [1]."""


def guiding(deviation: Any) -> Floats:
    """Residuals of scalar targets: their squares are k² ln(1 + (d/k)²) with k = 20 [1].

    Near the target that is the square of the deviation. Far off it still falls towards the target, but
    one percent of a deviation counts the same however great that is.

    Args:
        deviation: Deviations in tolerances, of any shape [1].

    Returns:
        Residuals with the sign of the deviation.
    """
    deviation = np.asarray(deviation, np.float64)
    loss = SCALAR_KNEE**2 * np.log1p((deviation / SCALAR_KNEE) ** 2)
    return np.asarray(np.sign(deviation) * np.sqrt(loss))


def robust(deviation: Any) -> Floats:
    """Residuals of tracked points: their squares are the pseudo-Huber loss with k = 2 [1].

    That is 2 k² (√(1 + (d/k)²) − 1): an outlier counts in proportion to its deviation.

    Args:
        deviation: Deviations in tolerances, of any shape [1].

    Returns:
        Residuals with the sign of the deviation: the deviation itself where it is small.
    """
    deviation = np.asarray(deviation, np.float64)
    loss = 2.0 * TRACK_KNEE**2 * (np.sqrt(1.0 + (deviation / TRACK_KNEE) ** 2) - 1.0)
    return np.asarray(np.sign(deviation) * np.sqrt(loss))
