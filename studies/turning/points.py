"""Passes averaged over neighbouring heights of the drive.

Stick and slip make what a single pass does a rugged function of everything.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from studies.kit.words import number
from studies.turning.passes import Drive, Outcome, outcomes

NEIGHBOURS_MM = (-0.2, -0.1, 0.0, 0.1, 0.2)
"""Ours: heights around that of a point."""


class Spread(NamedTuple):
    """A mean over neighbours, and their range; not a number where none of them is kept."""

    mean: float
    low: float
    high: float

    def __str__(self) -> str:
        """The mean and half the range."""
        if math.isnan(self.mean):
            return "–"
        half = number(0.5 * (self.high - self.low))
        return f"{number(self.mean)} ± {half}" if float(half) else number(self.mean)


@dataclass(frozen=True)
class Point:
    """A pass averaged over neighbours. Means are over those that neither tipped nor were carried."""

    sweep: str  # which sweep it belongs to
    drive: Drive  # the pass in the middle
    passes: int  # how many neighbours were run
    tipped: int  # in how many a foot rolled beyond 60°
    overturned: int  # in how many it did not come back
    carried: int  # how many others the drive carried along
    turn_deg: Spread  # turn [°]
    side_mm: Spread  # way along +z, towards the drive [mm]
    stride_mm: Spread  # way along −x [mm]
    roll_deg: tuple[float, ...]  # greatest roll of each foot, mean over all neighbours [°]

    @property
    def kept(self) -> int:
        """How many neighbours the means are over."""
        return self.passes - self.tipped - self.carried

    @property
    def came_back(self) -> bool:
        """Whether a neighbour tipped over and came back by itself."""
        return self.tipped > self.overturned

    @property
    def most_rolled(self) -> float:
        """The greatest roll of any foot [°]."""
        return max(self.roll_deg)


def points(
    sweep: str, drives: Sequence[Drive], neighbours_mm: Sequence[float] = NEIGHBOURS_MM
) -> list[Point]:
    """Runs each pass at neighbouring heights and averages."""
    around = [
        replace(drive, height_mm=drive.height_mm + shift) for drive in drives for shift in neighbours_mm
    ]
    found, count = outcomes(around), len(neighbours_mm)
    return [averaged(sweep, drive, found[i * count : (i + 1) * count]) for i, drive in enumerate(drives)]


def averaged(sweep: str, drive: Drive, found: Sequence[Outcome]) -> Point:
    """Averages the neighbours of a pass."""
    upright = [outcome for outcome in found if not outcome.rolls.tipped]
    kept = [outcome for outcome in upright if not outcome.carried]
    return Point(
        sweep=sweep,
        drive=drive,
        passes=len(found),
        tipped=len(found) - len(upright),
        overturned=sum(outcome.rolls.overturned for outcome in found),
        carried=len(upright) - len(kept),
        turn_deg=spread(outcome.turn_deg for outcome in kept),
        side_mm=spread(outcome.side_mm for outcome in kept),
        stride_mm=spread(outcome.stride_mm for outcome in kept),
        roll_deg=tuple(np.mean([outcome.rolls.roll_deg for outcome in found], axis=0).tolist()),
    )


def spread(values: Iterable[float]) -> Spread:
    """Mean and range of values, of which there may be none."""
    each = list(values)
    return Spread(float(np.mean(each)), min(each), max(each)) if each else Spread(*[math.nan] * 3)
