"""Differences of outcomes, with what their scatter leaves open."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from studies.error.case import Outcome
from studies.kit.passes import MM, Floats
from studies.kit.words import number, signed

PERCENT = 100.0


@dataclass(frozen=True)
class Error:
    """The error of a figure, relative to its size; that of the pose in millimetres.

    Attributes:
        figure: Which; "pose" is the root mean square of the distance of all followed points from where they
            should be, over points, time and runs; "broken" has no numbers.
        mean: Of the mean over all runs.
        uncertainty: Standard error of that; 0 where there is one run.
        median: Median of the absolute errors of single runs.
    """

    figure: str
    mean: float
    uncertainty: float
    median: float

    @property
    def size(self) -> float:
        """Without its sign, where the scatter of the runs leaves less than that open."""
        return max(abs(self.mean), self.uncertainty)

    @property
    def unit(self) -> str:
        """What it is shown in."""
        return "mm" if self.figure == "pose" else "%"

    @property
    def shown(self) -> float:
        """Its size in that unit."""
        return self.size if self.figure == "pose" else PERCENT * self.size

    def text(self) -> str:
        """With what it leaves open."""
        if self.figure == "pose":
            return f"{number(self.mean, 3)} mm"
        open_ = f" ± {number(PERCENT * self.uncertainty)}" if self.uncertainty else ""
        return f"{signed(PERCENT * self.mean)}{open_} %"


BROKEN = Error("broken", math.nan, math.nan, math.nan)


def errors(found: Outcome, reference: Outcome, exact: Mapping[str, float]) -> list[Error]:
    """Errors of all figures, against a reference or against figures known exactly."""
    if found.broken is not None:
        return [BROKEN]
    off = []
    for name, values in found.figures.items():
        true = np.full_like(values, exact[name]) if name in exact else reference.figures[name]
        off.append(figure_error(name, values, true))
    if found.tracks is not None and reference.tracks is not None:
        off.append(pose_error(found.tracks, reference.tracks))
    return off


def figure_error(name: str, values: Floats, true: Floats) -> Error:
    """Error of one figure over runs (R,)."""
    off = (values - true) / np.mean(true)
    scatter = float(off.std(ddof=1) / np.sqrt(len(off))) if len(off) > 1 else 0.0
    return Error(name, float(off.mean()), scatter, float(np.median(np.abs(off))))


def pose_error(tracks: Floats, reference: Floats) -> Error:
    """Root mean square distance of tracks (R, T, P, axes) [m]."""
    distance_mm = MM * float(np.sqrt(np.sum((tracks - reference) ** 2, axis=-1).mean()))
    return Error("pose", distance_mm, 0.0, distance_mm)
