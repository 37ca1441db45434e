"""How a crawling speed is measured: the same for every controller and every belt."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from magworm_gym._magworm import Batch
from magworm_gym.baselines.runner import Controller, Runner

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Trial:
    """Measures speed over a window after the robot has settled into its gait.

    Attributes:
        settle_s: Time before the window [s].
        measure_s: Length of the window [s].
    """

    settle_s: float = 1.0
    measure_s: float = 8.0

    @property
    def duration_s(self) -> float:
        """Simulated time of one trial [s]."""
        return self.settle_s + self.measure_s

    def speed_m_s(
        self,
        worms: Runner,
        seeds: ArrayLike,
        controller: Controller | None = None,
        start: Floats | None = None,
    ) -> Floats:
        """Speeds towards the head (N,) [m/s]; a robot that broke numerically counts as 0.

        Arguments as those of :meth:`Runner.begin`; times are rounded to whole control steps.
        """
        worms.begin(seeds, controller, start)
        worms.forward(worms.steps(self.settle_s))
        before = centre_x_m(worms.batch)
        worms.forward(worms.steps(self.measure_s))
        speed = (before - centre_x_m(worms.batch)) / self.measure_s
        return np.where((worms.batch.status() == 0) & np.isfinite(speed), speed, 0.0)


def centre_x_m(batch: Batch) -> Floats:
    """Mean x of the centre line of each robot (N,) [m]."""
    return np.asarray(batch.node_positions()[:, :, 0].mean(axis=1))
