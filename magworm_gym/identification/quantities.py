"""Numbers that sum up a recording, as a ruler beside the robot would measure them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from magworm_gym.recording import Floats, Recording

Measure = Literal["lift_m", "peak_m", "stride_m", "displacement_m", "end_angle_deg", "angle_range_deg"]

MEASURES: dict[Measure, tuple[Callable[[Floats], Any], str]] = {
    "lift_m": (lambda path: path[-1, 1] - path[0, 1], "height at the end minus height at the start"),
    "peak_m": (lambda path: (path[:, 1] - path[0, 1]).max(), "greatest rise above the height at the start"),
    "stride_m": (lambda path: path[0, 0] - path[-1, 0], "way towards the head (−x) from start to end"),
    "displacement_m": (
        lambda path: np.hypot(*(path[-1, :2] - path[0, :2])),
        "distance between start and end",
    ),
    "end_angle_deg": (lambda path: np.degrees(path[-1, 2]), "angle at the end, anticlockwise"),
    "angle_range_deg": (lambda path: np.degrees(np.ptp(path[:, 2])), "greatest angle minus least angle"),
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

    kind: Measure
    magnet: int | None = None

    def measure(self, recording: Recording) -> float:
        """Its value in a recording, in the unit of its name."""
        poses = recording.magnet_poses
        path = poses.mean(axis=1) if self.magnet is None else poses[:, self.magnet]
        return float(MEASURES[self.kind][0](path))

    def __str__(self) -> str:
        return self.kind if self.magnet is None else f"{self.kind} of magnet {self.magnet}"


def named_quantity(text: str, magnets: int) -> Quantity | None:
    """The quantity that is called ``stride_m`` or ``stride_m.1``; None where a text names none of a robot.

    Args:
        text: The text.
        magnets: Number of body magnets.
    """
    kind, dot, magnet = text.partition(".")
    if kind not in MEASURES or (dot and not (magnet.isdecimal() and int(magnet) < magnets)):
        return None
    return Quantity(kind, int(magnet) if dot else None)
