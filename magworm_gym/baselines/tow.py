"""A magnet held at a fixed place relative to the robot: does it tow the robot along?

A magnet strong enough to drag the robot over the ground makes crawling pointless: it outruns every
gait. Whether a robot can be towed is a property of its magnets, its friction and the height of the
stage, so a comparison has to show it.
"""

import numpy as np
from numpy.typing import NDArray

from magworm_gym.baselines.runner import Runner

Floats = NDArray[np.float64]

TOW_AXES = {"offset": np.linspace(-1.0, 1.0, 33), "height": np.array([0.0, 0.5, 0.75, 1.0])}
"""What of a tow is worth sweeping."""


class Tow:
    """Holds the magnet at an offset from the robot centre, following at full speed.

    Every argument may be an array (N,), so that one batch can compare many.

    Args:
        offset: Place along the robot, as a share of the stage's reach, -1 (ahead) to 1.
        height: Height between the lowest (-1) and the highest (1).
    """

    def __init__(self, offset: Floats | float, height: Floats | float = 1.0) -> None:
        self._offset = offset
        self._height = height

    def start(self, worms: Runner) -> None:
        """Nothing to prepare."""

    def act(self, worms: Runner) -> Floats:
        """Actions (N, 3), always the same."""
        everyone = np.zeros(worms.num_envs)
        return np.stack([everyone + self._offset, everyone + self._height, everyone + 1.0], axis=1)
