"""Heel and toe of each foot: where the robot may touch the ground."""

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene
from studies.kit.passes import values_of

Floats = NDArray[np.float64]

OFF_GROUND_M = 5e-5
"""Ours: a point this high counts as off the ground."""


def sole_heights(scene: Scene, recording: Recording) -> Floats:
    """Heights of both ends of each foot, which move rigidly with their magnet.

    Args:
        scene: Scene of the recording, with a worm.
        recording: Its recording.

    Returns:
        Heights (T, M, 2) over the ground [m]: the end towards the head, the end towards the tail.
    """
    body = values_of(scene)["body"]
    along = 0.5 * body["foot_length_m"] * np.array([-1.0, 1.0])
    below = 0.5 * body["foot_thickness_m"]
    y, angle = recording.magnet_poses[..., 1:2], recording.magnet_poses[..., 2:3]
    return np.asarray(y + np.sin(angle) * along - np.cos(angle) * below)
