"""Numbers that sum up a recording, as a ruler beside the robot would measure them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym.recording import Recording

Floats = NDArray[np.float64]


def _lift(path: Floats) -> float:
    return float(path[-1, 1] - path[0, 1])


def _peak(path: Floats) -> float:
    return float((path[:, 1] - path[0, 1]).max())


def _stride(path: Floats) -> float:
    return float(path[0, 0] - path[-1, 0])


def _displacement(path: Floats) -> float:
    return float(np.hypot(*(path[-1, :2] - path[0, :2])))


def _end_angle(path: Floats) -> float:
    return float(np.degrees(path[-1, 2]))


def _angle_range(path: Floats) -> float:
    return float(np.degrees(np.ptp(path[:, 2])))


MEASURES: dict[str, tuple[Callable[[Floats], float], str]] = {
    "lift_m": (_lift, "height at the end minus height at the start"),
    "peak_m": (_peak, "greatest rise above the height at the start"),
    "stride_m": (_stride, "way towards the head (−x) from start to end"),
    "displacement_m": (_displacement, "distance between start and end"),
    "end_angle_deg": (_end_angle, "angle at the end, anticlockwise"),
    "angle_range_deg": (_angle_range, "greatest angle minus least angle"),
}
"""Name with its unit → what measures a path (T, 3) [m, m, rad], and the meaning."""


@dataclass(frozen=True)
class Quantity:
    """A number taken from a recording.

    Attributes:
        kind: A key of :data:`MEASURES`.
        magnet: Which body magnet, counted from the head; None for the robot's centre, the mean of
            its magnets.
    """

    kind: str
    magnet: int | None = None

    def measure(self, recording: Recording) -> float:
        """Its value in a recording, in the unit of its name."""
        poses = recording.magnet_poses
        path = poses.mean(axis=1) if self.magnet is None else poses[:, self.magnet]
        return MEASURES[self.kind][0](path)

    def __str__(self) -> str:
        return self.kind if self.magnet is None else f"{self.kind} of magnet {self.magnet}"
