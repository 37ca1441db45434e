"""A magnet held at a fixed place relative to the robot: does it tow the robot along?

A magnet strong enough to drag the robot over the ground makes crawling pointless: it outruns every
gait. Whether a robot can be towed is a property of its magnets, its friction and the height of the
stage, so a comparison has to show it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Batch, Scene
from magworm_gym.baselines.trial import Trial, crawl_speed_m_s

Floats = NDArray[np.float64]

OFFSETS = tuple(np.linspace(-1.0, 1.0, 33).tolist())
HEIGHTS = (0.0, 0.5, 0.75, 1.0)


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

    def start(self, batch: Batch) -> None:
        """Nothing to prepare."""

    def act(self, batch: Batch) -> Floats:
        """Actions (N, 3), always the same."""
        everyone = np.zeros(batch.num_envs)
        return np.stack([everyone + self._offset, everyone + self._height, everyone + 1.0], axis=1)


@dataclass(frozen=True)
class TowCurve:
    """Speed of a towed robot.

    Attributes:
        offsets: Places of the magnet, as shares of the reach (P,).
        heights: Heights from -1 (lowest) to 1 (highest) (H,).
        speed_m_s: Speed towards the head (P, H, starts) [m/s].
    """

    offsets: Floats
    heights: Floats
    speed_m_s: Floats

    @property
    def best(self) -> tuple[int, int]:
        """Indices (place, height) of the greatest mean speed."""
        mean = self.speed_m_s.mean(axis=-1)
        place, height = np.unravel_index(mean.argmax(), mean.shape)
        return int(place), int(height)


def sweep_tow(
    scene: Scene,
    trial: Trial,
    *,
    starts: int = 2,
    seed: int = 0,
    present: NDArray[np.bool_] | None = None,
) -> TowCurve:
    """Measures the speed at every place and height of the magnet, in one batch.

    Args:
        scene: Scene with a controlled drive.
        trial: How a speed is measured.
        starts: Seeds for each place and height.
        seed: First seed.
        present: Which body magnets are in place (M,); None for all.

    Returns:
        The curve.

    Raises:
        ValueError: The scene has no controlled drive.
    """
    shape = (len(OFFSETS), len(HEIGHTS), starts)
    place, height, number = (axis.ravel() for axis in np.indices(shape))
    batch = Batch(scene, place.size)
    if present is not None:
        batch.set_magnets_present(np.tile(present, (batch.num_envs, 1)))
    offsets, heights = np.array(OFFSETS), np.array(HEIGHTS)
    seeds = number.astype(np.uint64) + np.uint64(seed)
    measured = crawl_speed_m_s(batch, trial, seeds, Tow(offsets[place], heights[height]))
    return TowCurve(offsets, heights, measured.reshape(shape))
