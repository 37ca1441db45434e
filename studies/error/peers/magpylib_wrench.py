"""Force and torque of the drive magnet on the body magnets by magpylib's `getFT`, and how often it is asked.

It cuts a body magnet into cells that feel field and gradient as dipoles do. 4 × 1 × 4 cells are off by a few
parts in ten thousand at a distance of 22 mm, and take little more time than one.
"""

from collections.abc import Callable
from typing import Any

import magpylib
import numpy as np
from scipy.spatial.transform import Rotation

from studies.error.magnets import POLARITIES, ROBOT
from studies.kit.passes import Floats

CELLS = (4, 1, 4)
"""Along a body magnet's length, height and width."""
IN_PLANE = [0, 1]
"""Of a force; what stands out of the plane is rounding."""


class DriveMagnet:
    """The drive magnet and the body magnets."""

    def __init__(self) -> None:
        self.drive = cuboid(ROBOT["drive"])
        # Equal magnets are one magnet at the places of a path: half the time of several.
        self.body = cuboid(ROBOT["magnet"])
        self.polarities = np.array(POLARITIES, np.float64)

    def wrenches(self, drive_m: Floats, places_m: Floats, angles: Floats) -> Floats:
        """Forces along x and y [N] and torques about z [N·m] on the body magnets (M, 3).

        Args:
            drive_m: Place of the drive (3,) [m].
            places_m: Of the body magnets (M, 3) [m].
            angles: Theirs about z (M,) [rad].
        """
        self.drive.position = drive_m
        self.body.position = places_m
        self.body.orientation = Rotation.from_rotvec(angles[:, None] * np.array([0.0, 0.0, 1.0]))
        force_n, torque_n_m = magpylib.getFT(self.drive, self.body, meshing=CELLS)
        wrenches = np.column_stack([force_n[:, IN_PLANE], torque_n_m[:, 2]])
        return np.asarray(self.polarities[:, None] * wrenches)


def cuboid(magnet: dict[str, float]) -> Any:
    """A magnet of a scene, magnetised along its height, which is y."""
    return magpylib.magnet.Cuboid(
        dimension=(magnet["length_m"], magnet["height_m"], magnet["width_m"]),
        polarization=(0.0, magnet["remanence_t"], 0.0),
    )


class Extrapolated:
    """Values computed anew at every n-th call, between them taken from the line through the last two."""

    def __init__(self, every: int, compute: Callable[..., Floats]) -> None:
        """Args: how many calls from one computation to the next, and what computes."""
        self.every = every
        self.compute = compute
        self.calls = 0
        self.last: Floats = np.zeros(0)
        self.slope: Floats = np.zeros(0)

    def __call__(self, *arguments: object) -> Floats:
        """Values of this call, whose arguments matter only where they are computed."""
        since = self.calls % self.every
        self.calls += 1
        if since == 0:
            found = self.compute(*arguments)
            before = self.last if self.last.size else found
            self.last, self.slope = found, (found - before) / self.every
        return np.asarray(self.last + since * self.slope)
