"""Which parameters the data pin down, and which combinations they do not."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from magworm_gym.identification.evaluation import Evaluation
from magworm_gym.recording import Floats

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
            where a combination has no influence, NaN where no neighbour can be simulated.
        alone: The same with all other parameters known (P,) [1].
        disagreement: Relative difference of the derivatives at both steps (P,) [1]; NaN where
            no neighbour can be simulated.
    """

    singular_values: Floats
    directions: Floats
    deviations: Floats
    alone: Floats
    disagreement: Floats

    @property
    def axes(self) -> Floats:
        """Steps (P, P), one a row, of one standard deviation of the residuals, at most 1 long [1]."""
        lengths = np.minimum(1.0, 1.0 / np.maximum(self.singular_values, LEAST_SINGULAR))
        return np.asarray(lengths[:, None] * self.directions)

    @property
    def weak_directions(self) -> list[int]:
        """Rows of ``directions`` that the data do not pin down."""
        return [at for at, value in enumerate(self.singular_values) if value < 1.0 / WEAK]


def sensitivity(evaluations: Callable[[Floats], list[Evaluation]], best: Floats, noise: float) -> Sensitivity:
    """Differentiates the residuals by central differences with two step sizes.

    Args:
        evaluations: Gives what becomes of points of the unit cube (C, P).
        best: The point (P,).
        noise: Standard deviation of a residual: 1 where the misfit is within the tolerances [1].
    """
    jacobian, fine = (_jacobian(evaluations, best, step) for step in STEPS)
    scale = np.maximum(np.linalg.norm(jacobian, axis=0), np.linalg.norm(fine, axis=0))
    disagreement = np.linalg.norm(jacobian - fine, axis=0) / np.maximum(scale, 1e-12)
    unknown = np.isnan(jacobian).any(axis=0)
    jacobian = np.nan_to_num(jacobian) / noise
    _, values, directions = np.linalg.svd(jacobian, full_matrices=True)
    singular = np.zeros(len(best))
    singular[: len(values)] = values
    inverse = np.where(singular > LEAST_SINGULAR, 1.0 / np.maximum(singular, LEAST_SINGULAR), np.inf)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = np.where(np.abs(directions.T) > 1e-9, np.abs(directions.T) * inverse, 0.0)
        alone = 1.0 / np.linalg.norm(jacobian, axis=0)
    deviations = np.where(unknown, np.nan, np.linalg.norm(shares, axis=1))
    return Sensitivity(singular, directions, deviations, np.where(unknown, np.nan, alone), disagreement)


def _jacobian(evaluations: Callable[[Floats], list[Evaluation]], best: Floats, step: float) -> Floats:
    """Derivatives of the residuals (R, P), to one side where the other cannot be simulated, else NaN."""
    dimension = len(best)
    above = np.clip(best + step * np.eye(dimension), 0.0, 1.0)
    below = np.clip(best - step * np.eye(dimension), 0.0, 1.0)
    *found, centre = (each.residuals for each in evaluations(np.vstack([above, below, best[None]])))
    assert centre is not None, "the best candidate can be simulated"
    columns = []
    for at in range(dimension):
        high, low = found[at], found[dimension + at]
        top = best[at] if high is None else above[at, at]
        bottom = best[at] if low is None else below[at, at]
        rise = (centre if high is None else high) - (centre if low is None else low)
        columns.append(rise / (top - bottom) if top > bottom else np.full(len(centre), np.nan))
    return np.stack(columns, axis=1)
