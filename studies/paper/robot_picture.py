"""The robot's outline on axes in millimetres."""

from typing import Any

import numpy as np
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from magworm_gym import Recording, Scene
from magworm_gym.render import palette
from magworm_gym.render.outline import band, rectangle
from studies.paper.figures import colour

Floats = NDArray[np.float64]
MM = 1e3


def draw_robot(axes: Any, scene: Scene, recording: Recording, sample: int, share: float = 1.0) -> None:
    """Draws rubber and magnets at one instant.

    Args:
        axes: Axes in millimetres, with equal scales.
        scene: The robot.
        recording: Its recording, with nodes.
        sample: Index of the instant.
        share: Opacity.
    """
    geometry = scene.geometry
    outline = MM * band(recording.nodes[sample], np.asarray(geometry["element_thickness_m"]))
    rubber, edge = colour(palette.RUBBER), colour(palette.RUBBER_EDGE)
    axes.add_patch(Polygon(outline, facecolor=rubber, edgecolor=edge, lw=0.8, alpha=share, zorder=3))
    poses = recording.magnet_poses[sample].tolist()
    magnets = zip(poses, geometry["magnet_size_m"], recording.present, geometry["polarity"], strict=True)
    for pose, size, there, polarity in magnets:
        draw_magnet(axes, pose, size[:2], polarity if there else 0.0, share)


def draw_drive(axes: Any, scene: Scene, recording: Recording, sample: int) -> None:
    """Draws the drive magnets at one instant on axes in millimetres."""
    for x, y in recording.drive_positions[sample].tolist():
        draw_magnet(axes, (x, y, 0.0), scene.geometry["drive_size_m"], 1.0, 1.0)


def draw_ground(axes: Any) -> None:
    """Draws the surface that the robot stands on."""
    axes.axhline(0.0, color=colour(palette.GROUND_LINE), lw=1.0, zorder=2)


def draw_magnet(axes: Any, pose: Any, size_m: tuple[float, float], polarity: float, share: float) -> None:
    """Draws a magnet: north red, south blue; polarity 0 for one that was taken out.

    Args:
        axes: Axes in millimetres.
        pose: x [m], y [m], angle [rad].
        size_m: Length and height [m].
        polarity: Positive for north up at rest.
        share: Opacity.
    """
    (x, y, angle), (length, height) = pose, size_m
    upper, lower = (palette.NORTH, palette.SOUTH) if polarity > 0.0 else (palette.SOUTH, palette.NORTH)
    for bottom, top, pole in ((0.0, 0.5 * height, upper), (-0.5 * height, 0.0, lower)):
        half = MM * rectangle(x, y, angle, length, bottom, top)
        if polarity != 0.0:
            axes.add_patch(Polygon(half, facecolor=colour(pole), edgecolor="none", alpha=share, zorder=4))
    whole = MM * rectangle(x, y, angle, length, -0.5 * height, 0.5 * height)
    edge = colour(palette.MAGNET_EDGE if polarity else palette.REMOVED_EDGE)
    axes.add_patch(Polygon(whole, facecolor="none", edgecolor=edge, lw=0.6, alpha=share, zorder=5))
