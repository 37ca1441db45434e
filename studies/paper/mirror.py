"""Mirror symmetry: a pass from the other side is the mirrored pass of a symmetric robot."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from magworm_gym import Recording, record_scenes
from studies.kit.passes import AHEAD_M, MM, Floats, one_pass, robot
from studies.kit.words import COUNTS
from studies.paper.experiment import Experiment, Numbers

SPEEDS_MM_S = (50.0, 100.0, 210.0)
REQUIRED_MM_S = 100.0
SAMPLE_S = 0.002
TOLERABLE_UM = 10.0
PARTED_M = 1e-7


@dataclass(frozen=True)
class Both:
    """A pass and its mirror image.

    Attributes:
        magnets: Number of magnets of the robot.
        speed_mm_s: Speed of the drive [mm/s].
        stride_mm: Stride of the pass from the head [mm].
        apart_um: Greatest distance of its centre line from the other's mirror image [µm].
        parting_s: The last instant before they are further apart than 0.1 µm [s].
        before_um: How far apart they are then [µm],
        after_um: and one solver step later [µm].
    """

    magnets: int
    speed_mm_s: float
    stride_mm: float
    apart_um: float
    parting_s: float
    before_um: float
    after_um: float


@dataclass(frozen=True)
class Mirror(Experiment):
    """Both passes for both symmetric robots."""

    name: ClassVar[str] = "mirror"
    passes: list[Both]

    @classmethod
    def measured(cls) -> "Mirror":
        """Runs all pairs."""
        return cls([_both_ways(count, speed) for count in (3, 5) for speed in SPEEDS_MM_S])

    @property
    def worst(self) -> Both:
        """The pair that is furthest apart."""
        return max(self.passes, key=lambda both: both.apart_um)

    @property
    def parts(self) -> bool:
        """Whether a pass and its mirror image differ by more than the tolerance of the contact solve."""
        return self.worst.apart_um > TOLERABLE_UM

    def numbers(self) -> Numbers:
        """Distances at the paper's speed, and the greatest."""
        required = [both for both in self.passes if both.speed_mm_s == REQUIRED_MM_S]
        found = {f"mirror.{COUNTS[both.magnets]}": both.apart_um for both in required}
        return {**found, "mirror.worst": self.worst.apart_um}


def apart_m(there: Recording, mirrored: Recording, length_m: float) -> Floats:
    """Greatest distance of a node of the centre line from the other's mirror image (T,) [m].

    Args:
        there: Pass from the head.
        mirrored: Pass from the tail.
        length_m: Length of the robot, which starts with its head end at 0.
    """
    image = mirrored.nodes[:, ::-1] * (-1.0, 1.0) + (length_m, 0.0)
    return np.asarray(np.linalg.norm(image - there.nodes, axis=-1).max(axis=1))


def _both_ways(magnets: int, speed_mm_s: float) -> Both:
    scene, speed_m_s = robot(magnets), 1e-3 * speed_mm_s
    time_s = (scene.body_length_m + 2.0 * AHEAD_M) / speed_m_s
    pair = [one_pass(scene, speed_m_s), one_pass(scene, speed_m_s, backward=True)]
    there, mirrored = record_scenes(pair, round(time_s / SAMPLE_S) * SAMPLE_S, SAMPLE_S)
    apart = apart_m(there, mirrored, scene.body_length_m)
    after = max(1, int((apart > PARTED_M).argmax()))
    parting = (SAMPLE_S * (after - 1), 1e6 * apart[after - 1], 1e6 * apart[after])
    return Both(magnets, speed_mm_s, MM * float(there.progress_m[-1]), 1e6 * float(apart.max()), *parting)
