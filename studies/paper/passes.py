"""Stride: the way a robot makes against the motion of the drive when one drive magnet passes.

The paper averages over a number of separated drive magnets. Here magnets 300 mm apart pass one after the
other; the average goes over them, over places where the first starts and over small changes of friction,
because stick and slip make a single stride a rugged function of everything.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from magworm_gym import Recording, Scene, record_scenes
from studies.kit.passes import AHEAD_M, CARRIED_M, SEPARATION_M, Floats, on_belt, unbroken

PASSES = 3
AHEADS_M = (AHEAD_M, AHEAD_M + 0.0007)
"""Ours: where the first magnet starts, within a few solver steps of each other."""
FRICTIONS = (0.98, 1.0, 1.02)
"""Ours: factors of the static coefficient of friction."""
SAMPLE_S = 0.01


@dataclass(frozen=True)
class Walk:
    """A robot over separated drive magnets.

    Attributes:
        scene: The robot.
        speed_m_s: Speed of the drive, positive [m/s].
        backward: Whether the drive moves from tail to head.
    """

    scene: Scene
    speed_m_s: float
    backward: bool = False


@dataclass(frozen=True)
class Stride:
    """Passes of one robot under all conditions.

    Attributes:
        mean_m: Mean of the passes before it was carried along [m]; of all, where there are none.
        spread_m: Their standard deviation [m].
        carried: Share of the conditions in which the drive carried it along.
    """

    mean_m: float
    spread_m: float
    carried: float


def measured_strides(walks: Sequence[Walk], aheads_m: Sequence[float] = AHEADS_M) -> list[Stride]:
    """Strides of robots, all simulated side by side.

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
        on_belt(walk.scene, walk.speed_m_s, backward=walk.backward, ahead_m=ahead, friction=friction)
        for walk, ahead, friction in runs
    ]
    durations = [SAMPLE_S * math.ceil(end[-1] / SAMPLE_S) for end in ends]
    records = record_scenes(scenes, durations, SAMPLE_S, nodes=False)
    ways = [
        strides_of(record, end, walk.backward)
        for record, end, (walk, _, _) in zip(records, ends, runs, strict=True)
    ]
    return [averaged(group) for group in np.array(ways).reshape(len(walks), len(conditions), PASSES)]


def averaged(ways_m: Floats) -> Stride:
    """Averages the passes of one robot.

    A robot that was carried along no longer meets the magnets when the others do: what it does from
    then on is left out of mean and spread.

    Args:
        ways_m: Way against the motion of the drive (conditions, passes) [m].
    """
    gone = np.logical_or.accumulate(ways_m < -CARRIED_M, axis=1)
    kept = ways_m if gone.all() else ways_m[~gone]
    return Stride(float(kept.mean()), float(kept.std()), float(gone[:, -1].mean()))


def pass_ends_s(walk: Walk, ahead_m: float) -> Floats:
    """When each pass is over: the drive magnet and the next are equally far from the robot (PASSES,) [s]."""
    first_m = ahead_m + 0.5 * walk.scene.body_length_m + 0.5 * SEPARATION_M
    return np.asarray((first_m + SEPARATION_M * np.arange(PASSES)) / walk.speed_m_s)


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
