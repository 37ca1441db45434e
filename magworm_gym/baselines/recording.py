"""One robot over time, for pictures and for phase portraits."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Recording:
    """One robot over time.

    Attributes:
        time_s: Instants (T,) [s], evenly spaced.
        nodes: Centre line (T, K, 2) [m].
        magnet_poses: Body magnets (T, M, 3): [m], [m], [rad].
        present: Which body magnets are in place (M,).
        drive_positions: Drive magnets (T, D, 2) [m].
    """

    time_s: Floats
    nodes: Floats
    magnet_poses: Floats
    present: NDArray[np.bool_]
    drive_positions: Floats

    @property
    def centre(self) -> Floats:
        """Places of the body centre (T, 2) [m]."""
        return np.asarray(self.nodes.mean(axis=1))

    @property
    def progress_m(self) -> Floats:
        """Way towards the head since the first instant (T,) [m]."""
        centre_x = self.centre[:, 0]
        return np.asarray(centre_x[0] - centre_x)
