"""The robot's outline on axes in millimetres."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.patches import Polygon

from magworm_gym import Recording, Scene
from magworm_gym.render import palette
from magworm_gym.render.outline import band, half, rectangle, turned
from studies.kit.figures import colour
from studies.kit.passes import MM, Floats

UPWARD = np.array([0.0, 1.0])


def moments(recording: Recording, samples: Sequence[int]) -> Recording:
    """A recording of some instants alone."""
    names = ("time_s", "nodes", "magnet_poses", "drive_positions")
    return replace(recording, **{name: getattr(recording, name)[list(samples)] for name in names})


def draw_scene(axes: Any, scene: Scene, recording: Recording, sample: int) -> None:
    """Draws ground, drive and robot at one instant.

    Args:
        axes: Axes in millimetres, which get equal scales.
        scene: The robot.
        recording: Its recording, with nodes.
        sample: Index of the instant.
    """
    geometry = scene.geometry
    axes.axhline(0.0, color=colour(palette.GROUND_LINE), lw=1.0, zorder=2)
    for x, y in recording.drive_positions[sample].tolist():
        _draw_magnet(axes, (x, y, 0.0), geometry["drive_size_m"], UPWARD)
    outline = MM * band(recording.nodes[sample], np.asarray(geometry["element_thickness_m"]))
    rubber, edge = colour(palette.RUBBER), colour(palette.RUBBER_EDGE)
    axes.add_patch(Polygon(outline, facecolor=rubber, edgecolor=edge, lw=0.8, zorder=3))
    sizes, offsets, directions = (
        np.asarray(geometry[name])[:, :2] for name in ("magnet_size_m", "magnet_offset_m", "magnet_direction")
    )
    magnets = zip(recording.magnet_poses[sample], sizes, offsets, directions, recording.present, strict=True)
    for (x, y, angle), size, offset, direction, there in magnets:
        across, up = offset @ turned(angle)
        _draw_magnet(axes, (x + across, y + up, angle), size, direction if there else None)
    axes.set_aspect("equal")


def _draw_magnet(axes: Any, pose: Any, size_m: Any, direction: Floats | None) -> None:
    """Draws a magnet, cut across its direction into its two poles: north red, south blue.

    Args:
        axes: Axes in millimetres.
        pose: x [m], y [m], angle [rad].
        size_m: Length and height [m].
        direction: From south to north, along the magnet and up from it; None for one that was taken out,
            which is an empty outline.
    """
    x, y, angle = pose
    whole = MM * rectangle((x, y), turned(angle), size_m)
    if direction is not None:
        for pole, north in ((palette.NORTH, direction), (palette.SOUTH, -direction)):
            part = half(whole, north @ turned(angle))
            axes.add_patch(Polygon(part, facecolor=colour(pole), edgecolor="none", zorder=4))
    edge = colour(palette.REMOVED_EDGE if direction is None else palette.MAGNET_EDGE)
    axes.add_patch(Polygon(whole, facecolor="none", edgecolor=edge, lw=0.6, zorder=5))
