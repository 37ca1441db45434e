"""The robot's outline on axes in millimetres."""

from typing import Any

import numpy as np
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from magworm_gym import Recording, Scene
from magworm_gym.render import palette
from magworm_gym.render.outline import band, half, rectangle, turned
from studies.paper.figures import colour

Floats = NDArray[np.float64]
MM = 1e3
UPWARD = np.array([0.0, 1.0])


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
    sizes, offsets, directions = (
        np.asarray(geometry[name])[:, :2] for name in ("magnet_size_m", "magnet_offset_m", "magnet_direction")
    )
    magnets = zip(recording.magnet_poses[sample], sizes, offsets, directions, recording.present, strict=True)
    for (x, y, angle), size, offset, direction, there in magnets:
        across, up = offset @ turned(angle)
        draw_magnet(axes, (x + across, y + up, angle), size, direction if there else None, share)


def draw_drive(axes: Any, scene: Scene, recording: Recording, sample: int) -> None:
    """Draws the drive magnets at one instant on axes in millimetres."""
    for x, y in recording.drive_positions[sample].tolist():
        draw_magnet(axes, (x, y, 0.0), scene.geometry["drive_size_m"], UPWARD, 1.0)


def draw_ground(axes: Any) -> None:
    """Draws the surface that the robot stands on."""
    axes.axhline(0.0, color=colour(palette.GROUND_LINE), lw=1.0, zorder=2)


def draw_magnet(axes: Any, pose: Any, size_m: Any, direction: Floats | None, share: float) -> None:
    """Draws a magnet, cut across its direction into its two poles: north red, south blue.

    Args:
        axes: Axes in millimetres.
        pose: x [m], y [m], angle [rad].
        size_m: Length and height [m].
        direction: From south to north, along the magnet and up from it; None for one that was taken out,
            which is an empty outline.
        share: Opacity.
    """
    (x, y, angle), (length, height) = pose, size_m
    whole = MM * rectangle(x, y, angle, length, -0.5 * height, 0.5 * height)
    if direction is not None:
        for pole, north in ((palette.NORTH, direction), (palette.SOUTH, -direction)):
            part = half(whole, north @ turned(angle))
            axes.add_patch(Polygon(part, facecolor=colour(pole), edgecolor="none", alpha=share, zorder=4))
    edge = colour(palette.REMOVED_EDGE if direction is None else palette.MAGNET_EDGE)
    axes.add_patch(Polygon(whole, facecolor="none", edgecolor=edge, lw=0.6, alpha=share, zorder=5))
