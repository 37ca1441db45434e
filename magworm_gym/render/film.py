"""One recorded robot, as frames for the writers of animations."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from magworm_gym._magworm import Scene
from magworm_gym.recording import Recording
from magworm_gym.render import view_of


def film_frames(
    recording: Recording, scene: Scene, width: int = 640, height: int = 360, every: int = 1
) -> Iterator[NDArray[np.uint8]]:
    """Draws a recording, in the plane or in space.

    Args:
        recording: A robot over time, with its centre line.
        scene: Its scene.
        width: Width of a frame [pixels].
        height: Height of a frame [pixels].
        every: Draws every n-th instant only.

    Yields:
        Frames (height, width, 3), as ``animation.write_mp4`` and ``animation.write_gif`` take them.
    """
    view = view_of(scene, width, height)
    for instant in range(0, len(recording.time_s), every):
        yield view.draw(recording.at(instant), f"{recording.time_s[instant]:.2f} s")
