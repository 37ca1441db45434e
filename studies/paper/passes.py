"""Stride: the way a robot makes against the motion of the drive when one drive magnet passes.

The paper averages over a number of separated drive magnets. Here magnets 300 mm apart pass one after the
other; the average goes over them, over places where the first starts and over small changes of friction,
because stick and slip make a single stride a rugged function of everything.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.passes import AHEAD_M, CARRIED_M, MM, SEPARATION_M, Floats, on_belt, unbroken

PASSES = 3
AHEADS_M = (AHEAD_M, AHEAD_M + 0.0007)
"""Ours: where the first magnet starts, within a few solver steps of each other."""
FRICTIONS = (0.98, 1.0, 1.02)
"""Ours: factors of the static coefficient of friction."""
SAMPLE_S = 0.01
CRAWLS_MM = 0.5
"""Ours: a robot crawls if it makes more than this in a pass and more than the spread of its passes."""


@dataclass(frozen=True)
class Walk:
    """A robot over separated drive magnets.

    Attributes:
        scene: The robot.
        speed_mm_s: Speed of the drive, positive [mm/s].
        backward: Whether the drive moves from tail to head.
    """

    scene: Scene
    speed_mm_s: float
    backward: bool = False


@dataclass(frozen=True)
class Strides:
    """Passes of robots under all conditions, in arrays of any shape.

    Attributes:
        mean_mm: Mean of the passes before it was carried along [mm]; of all, where there are none.
        spread_mm: Their standard deviation [mm].
        carried: Share of the conditions in which the drive carried it along.
    """

    mean_mm: Floats
    spread_mm: Floats
    carried: Floats

    @property
    def crawls(self) -> NDArray[np.bool_]:
        """Which count as crawling: against the drive, clear of their spread, never carried along."""
        clear = self.mean_mm > np.maximum(CRAWLS_MM, self.spread_mm)
        return np.asarray(clear & (self.carried == 0.0))

    def __getitem__(self, key: Any) -> "Strides":
        """Some of them, as an array is indexed."""
        return Strides(self.mean_mm[key], self.spread_mm[key], self.carried[key])

    def reshaped(self, *shape: int) -> "Strides":
        """The same in another shape."""
        return Strides(*(each.reshape(shape) for each in (self.mean_mm, self.spread_mm, self.carried)))


def measured_strides(walks: Sequence[Walk], aheads_m: Sequence[float] = AHEADS_M) -> Strides:
    """Strides of robots (walks,), all simulated side by side.

    Args:
        walks: The robots.
        aheads_m: Places where the first magnet starts, ahead of the robot [m].

    Raises:
        RuntimeError: A simulation broke down; the sentence says why.
    """
    conditions = [(ahead, friction) for ahead in aheads_m for friction in FRICTIONS]
    runs = [(walk, ahead, friction) for walk in walks for ahead, friction in conditions]
    ends = [pass_ends_s(walk, ahead) for walk, ahead, _ in runs]
    scenes = [
        on_belt(walk.scene, 1e-3 * walk.speed_mm_s, backward=walk.backward, ahead_m=ahead, friction=friction)
        for walk, ahead, friction in runs
    ]
    durations = [SAMPLE_S * math.ceil(end[-1] / SAMPLE_S) for end in ends]
    records = record_scenes(scenes, durations, SAMPLE_S, nodes=False)
    ways = [
        strides_of(record, end, walk.backward)
        for record, end, (walk, _, _) in zip(records, ends, runs, strict=True)
    ]
    groups = np.array(ways).reshape(len(walks), len(conditions), PASSES)
    return Strides(*np.array([averaged(group) for group in groups]).T)


def averaged(ways_m: Floats) -> tuple[float, float, float]:
    """Mean [mm], spread [mm] and share carried along of the passes of one robot.

    A robot that was carried along no longer meets the magnets when the others do: what it does from
    then on is left out of mean and spread.

    Args:
        ways_m: Way against the motion of the drive (conditions, passes) [m].
    """
    gone = np.logical_or.accumulate(ways_m < -CARRIED_M, axis=1)
    kept = MM * (ways_m if gone.all() else ways_m[~gone])
    return float(kept.mean()), float(kept.std()), float(gone[:, -1].mean())


def pass_ends_s(walk: Walk, ahead_m: float) -> Floats:
    """When each pass is over: the drive magnet and the next are equally far from the robot (PASSES,) [s]."""
    first_m = ahead_m + 0.5 * walk.scene.body_length_m + 0.5 * SEPARATION_M
    return np.asarray((first_m + SEPARATION_M * np.arange(PASSES)) / (1e-3 * walk.speed_mm_s))


def strides_of(record: Recording, ends_s: Floats, backward: bool) -> Floats:
    """Way of the robot against the motion of the drive in each pass.

    Args:
        record: Recording from before the first pass on.
        ends_s: When each pass is over (P,) [s].
        backward: Whether the drive moves from tail to head.

    Returns:
        Ways (P,) [m].

    Raises:
        RuntimeError: The simulation broke down; the sentence says why.
    """
    step_s = unbroken(record).time_s[1] - record.time_s[0]
    samples = np.minimum(np.round(ends_s / step_s).astype(int), len(record.time_s) - 1)
    way = record.progress_m[np.concatenate([[0], samples])]
    return np.asarray(np.diff(-way if backward else way))
