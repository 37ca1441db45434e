"""Differences of outcomes, with what their scatter leaves open."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from studies.error.case import Outcome

Floats = NDArray[np.float64]
MM = 1e3


@dataclass(frozen=True)
class Figure:
    """The error of a figure, relative to its size.

    Attributes:
        mean: Of the mean over all runs.
        uncertainty: Standard error of that; 0 where there is one run.
        median: Median of the absolute errors of single runs.
    """

    mean: float
    uncertainty: float
    median: float


@dataclass(frozen=True)
class Errors:
    """Errors of an outcome.

    Attributes:
        figures: Of each figure.
        pose_mm: Root mean square of the distance of all followed points from where they should be, over
            points, time and runs [mm]; None where nothing is followed.
    """

    figures: Mapping[str, Figure]
    pose_mm: float | None


def errors(found: Outcome, reference: Outcome, exact: Mapping[str, float]) -> Errors | None:
    """Errors against a reference, or against figures known exactly; None for what broke down."""
    if found.broken is not None:
        return None
    figures = {}
    for name, values in found.figures.items():
        true = np.full_like(values, exact[name]) if name in exact else reference.figures[name]
        figures[name] = figure_error(values, true)
    return Errors(figures, pose_error_mm(found.tracks, reference.tracks))


def figure_error(values: Floats, true: Floats) -> Figure:
    """Error of one figure over runs (R,)."""
    off = (values - true) / np.mean(true)
    scatter = float(off.std(ddof=1) / np.sqrt(len(off))) if len(off) > 1 else 0.0
    return Figure(float(off.mean()), scatter, float(np.median(np.abs(off))))


def pose_error_mm(tracks: Floats | None, reference: Floats | None) -> float | None:
    """Root mean square distance of tracks (R, T, P, axes) [mm]."""
    if tracks is None or reference is None:
        return None
    squared = np.sum((tracks - reference) ** 2, axis=-1)
    return float(MM * np.sqrt(squared.mean()))
