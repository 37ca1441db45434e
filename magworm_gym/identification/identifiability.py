"""Which parameters the data pin down, and which combinations they do not."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym.identification.evaluation import Verdict

Floats = NDArray[np.float64]

STEPS = (0.02, 0.005)
"""Steps of the differences, as parts of the bounds [1]."""

RUGGED = 0.5
"""Relative difference of the derivatives at both steps beyond which the model counts as rugged [1]."""

WEAK = 0.3
"""Standard deviation of a combination, as a part of the bounds, beyond which it is not pinned down [1]."""

LEAST_SINGULAR = 1e-6


@dataclass(frozen=True)
class Sensitivity:
    """Derivatives of the residuals at the best candidate.

    Attributes:
        singular_values: Singular values of the Jacobian (P,), greatest first [tolerances per range].
        directions: Combinations (P, P) that belong to them, one a row [1].
        deviations: Standard deviation of each parameter (P,), as a part of its bounds [1]; infinite
            where a combination has no influence.
        alone: The same with all other parameters known (P,) [1].
        disagreement: Relative difference of the derivatives at both steps (P,) [1]; NaN where one of
            them could not be simulated.
    """

    singular_values: Floats
    directions: Floats
    deviations: Floats
    alone: Floats
    disagreement: Floats

    @property
    def weak_directions(self) -> list[int]:
        """Rows of ``directions`` that the data do not pin down."""
        return [at for at, value in enumerate(self.singular_values) if value < 1.0 / WEAK]


def sensitivity(verdicts: Callable[[Floats], list[Verdict]], best: Floats, noise: float) -> Sensitivity:
    """Differentiates the residuals by central differences with two step sizes.

    Args:
        verdicts: Gives what becomes of points of the unit cube (C, P).
        best: The point (P,).
        noise: Standard deviation of a residual: 1 where the misfit is within the tolerances [1].
    """
    jacobian, fine = (_jacobian(verdicts, best, step) for step in STEPS)
    scale = np.maximum(np.linalg.norm(jacobian, axis=0), np.linalg.norm(fine, axis=0))
    disagreement = np.linalg.norm(jacobian - fine, axis=0) / np.maximum(scale, 1e-12)
    jacobian = np.nan_to_num(jacobian) / noise
    _, values, directions = np.linalg.svd(jacobian, full_matrices=True)
    singular = np.zeros(len(best))
    singular[: len(values)] = values
    inverse = np.where(singular > LEAST_SINGULAR, 1.0 / np.maximum(singular, LEAST_SINGULAR), np.inf)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = np.where(np.abs(directions.T) > 1e-9, np.abs(directions.T) * inverse, 0.0)
        alone = 1.0 / np.linalg.norm(jacobian, axis=0)
    return Sensitivity(singular, directions, np.linalg.norm(shares, axis=1), alone, disagreement)


def _jacobian(verdicts: Callable[[Floats], list[Verdict]], best: Floats, step: float) -> Floats:
    """Derivatives of the residuals (R, P); NaN columns where a neighbour cannot be simulated."""
    dimension = len(best)
    above = np.clip(best + step * np.eye(dimension), 0.0, 1.0)
    below = np.clip(best - step * np.eye(dimension), 0.0, 1.0)
    found = [verdict.residuals for verdict in verdicts(np.vstack([above, below, best[None]]))]
    size = len(next(residuals for residuals in found[::-1] if residuals is not None))
    columns = []
    for at in range(dimension):
        high, low = found[at], found[dimension + at]
        if high is None or low is None:
            columns.append(np.full(size, np.nan))
        else:
            columns.append((high - low) / (above[at, at] - below[at, at]))
    return np.stack(columns, axis=1)
