"""What a robot is drawn with, from any side: its rubber, its eyes and its trail."""

import itertools
from collections.abc import Sequence

import numpy as np

from magworm_gym.recording import Floats
from magworm_gym.render.canvas import Region
from magworm_gym.render.outline import band
from magworm_gym.render.palette import EYE, RUBBER, RUBBER_EDGE, RUBBER_LIGHT, TRAIL_NEW, TRAIL_OLD, mix

MAGNET_GEOMETRY = ("magnet_size_m", "magnet_direction", "magnet_offset_m")
"""Of each body magnet (M, 3), in ``Scene.geometry``."""
TRAIL_POINTS = 480
"""The last places of a trail that are drawn."""
TRAIL_PIECES = 12
SMALLEST_EYE_PX = 1.2


def body_length(line: Floats) -> float:
    """Length of a centre line (K, 2) or (K, 3), in its unit."""
    return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())


def draw_rubber(region: Region, line: Floats, thickness: Floats, light: float) -> None:
    """Draws the body around its centre line (K, 2) [pixels].

    Args:
        region: Where to draw.
        line: Centre line, head first.
        thickness: As of :func:`~magworm_gym.render.outline.band` [pixels].
        light: Share of the thickness that is lit.
    """
    body = band(line, thickness)
    region.polygon(body, RUBBER)
    region.polygon(band(line, thickness, share=light), RUBBER_LIGHT)
    region.polygon(body, None, RUBBER_EDGE, edge_px=1.3)


def draw_eyes(
    region: Region, line: Floats, size: float, places: Sequence[tuple[float, float]], radius: float
) -> None:
    """Marks the head, so that a picture alone tells which way the robot crawls.

    Args:
        region: Where to draw.
        line: Centre line (K, 2) [pixels], head first.
        size: Extent of the head across the line [pixels].
        places: Of each eye, from the head's end inward and aside, as shares of the size.
        radius: Of an eye, as a share of the size.
    """
    edge = line[1] - line[0]
    inward = edge / max(float(np.linalg.norm(edge)), 1e-9)
    aside = np.array([inward[1], -inward[0]])
    for along, across in places:
        eye = line[0] + size * (along * inward + across * aside)
        region.disc(eye, max(SMALLEST_EYE_PX, radius * size), EYE)


def draw_trail(region: Region, line: Floats) -> None:
    """Draws the trail (T, 2) [pixels] in pieces that fade towards the past."""
    if len(line) < 2:
        return
    cuts = np.unique(np.linspace(0, len(line) - 1, TRAIL_PIECES + 1).astype(int))
    for start, stop in itertools.pairwise(cuts.tolist()):
        share = stop / (len(line) - 1)
        region.line(line[start : stop + 1], mix(TRAIL_OLD, TRAIL_NEW, share), 1.0 + share)
