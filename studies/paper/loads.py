"""Magnetic force and torque on each body magnet along a recording."""

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording, Scene, magnet
from studies.kit.passes import values_of

Floats = NDArray[np.float64]
EDGES = ("length_m", "width_m", "height_m")


def magnetic_loads(scene: Scene, recording: Recording) -> tuple[Floats, Floats]:
    """Force and torque of a single drive magnet, from the recorded poses.

    The wrench speaks of (length, width, height); in the scene's plane these are (x, −z, y).

    Args:
        scene: Scene of the recording, with one drive magnet.
        recording: Its recording.

    Returns:
        Force (T, M, 2) along x and y [N], and torque about z (T, M), anticlockwise [N·m].
    """
    values = values_of(scene)
    drive, body = values["drive"], values["magnet"]
    x, y, angle = np.moveaxis(recording.magnet_poses, -1, 0)
    away = recording.drive_positions[:, :1]
    position = np.stack([x - away[..., 0], np.zeros_like(x), y - away[..., 1]], axis=-1)
    still = np.zeros_like(angle)
    quaternion = np.stack([np.cos(0.5 * angle), still, -np.sin(0.5 * angle), still], axis=-1)
    remanence = np.zeros((len(scene.geometry["polarity"]), 3))
    remanence[:, 2] = body["remanence_t"] * np.asarray(scene.geometry["polarity"]) * recording.present
    force, torque = magnet.wrench(
        [drive[edge] for edge in EDGES],
        [body[edge] for edge in EDGES],
        position,
        quaternion,
        drive_magnetisation_t=(0.0, 0.0, drive["remanence_t"]),
        body_magnetisation_t=remanence,
    )
    return force[..., ::2], -torque[..., 1]
