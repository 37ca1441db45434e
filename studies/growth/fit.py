"""Exponents of growth."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

FEWEST_POINTS = 4
"""Of a fit; with two unknowns two are left to judge it by."""


@dataclass(frozen=True)
class Exponent:
    """Cost ∝ size to this power, over the upper part of a sweep.

    Attributes:
        value: The power.
        error: Its standard error.
        least: Smallest size in the fit.
    """

    value: float
    error: float
    least: int


def exponent(sizes: Sequence[int], costs: Sequence[float]) -> Exponent | None:
    """Least squares on logarithms over the upper half of the sizes; None where there are too few.

    Args:
        sizes: Rising.
        costs: Above zero.
    """
    points = max(FEWEST_POINTS, (len(sizes) + 1) // 2)
    if len(sizes) < points:
        return None
    x, y = np.log(sizes[-points:]), np.log(costs[-points:])
    away = x - x.mean()
    slope = float(away @ y / (away @ away))
    residual = y - y.mean() - slope * away
    error = float(np.sqrt(residual @ residual / (points - 2) / (away @ away)))
    return Exponent(slope, error, sizes[-points])
