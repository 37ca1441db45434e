"""One recorded robot with its goal, as frames."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene
from magworm_gym.render.space_view import SpaceView
from magworm_gym.tasks import Goal

MM_PER_M = 1000.0


def frames(
    recording: Recording,
    goal: Goal,
    left: NDArray[np.float64],
    scene: Scene,
    width: int = 800,
    height: int = 400,
) -> Iterator[NDArray[np.uint8]]:
    """Draws a recording from above and from the side.

    Args:
        recording: A robot over time.
        goal: Its goal.
        left: What is left at each instant (T,) [°] or [m].
        scene: Its scene.
        width: Width of a frame [pixels].
        height: Height of a frame [pixels].

    Yields:
        Frames (height, width, 3).
    """
    view = SpaceView(scene.geometry, width, height)
    for at, time_s in enumerate(recording.time_s):
        still = f"{MM_PER_M * left[at]:.1f} mm" if goal.heading_rad is None else f"{left[at]:.1f}°"
        yield view.draw(
            recording.nodes[at],
            recording.magnet_poses[at],
            recording.present,
            recording.drive_positions[at],
            recording.centre[: at + 1],
            f"{time_s:.2f} s, {still} left",
            goal,
        )
