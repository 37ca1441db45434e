"""Outlines in the plane: the rubber band around a centre line, and magnets, with how they are turned."""

import functools
import math

import numpy as np
from numpy.typing import ArrayLike

from magworm_gym.recording import Floats

REFINEMENT = 4


@functools.lru_cache(maxsize=16)
def refinement_matrix(nodes: int, factor: int = REFINEMENT) -> Floats:
    """Weights that refine a polyline by a Catmull-Rom spline through its points.

    Args:
        nodes: Number of points K of the polyline, at least 2.
        factor: Number of pieces for each of the K - 1 edges.

    Returns:
        ((K - 1) factor + 1, K): multiply from the left.
    """
    padded = np.zeros((nodes + 2, nodes))
    padded[1:-1] = np.eye(nodes)
    padded[0, :2] = 2.0, -1.0
    padded[-1, -2:] = -1.0, 2.0
    s = np.arange(factor)[:, None, None] / factor
    edges = [padded[i : i + nodes - 1] for i in range(4)]
    weights = (
        0.5 * (-s + 2.0 * s**2 - s**3),
        0.5 * (2.0 - 5.0 * s**2 + 3.0 * s**3),
        0.5 * (s + 4.0 * s**2 - 3.0 * s**3),
        0.5 * (-(s**2) + s**3),
    )
    pieces = sum(weight * edge for weight, edge in zip(weights, edges, strict=True))
    matrix = np.concatenate([np.swapaxes(pieces, 0, 1).reshape(-1, nodes), np.eye(nodes)[-1:]])
    matrix.setflags(write=False)
    return np.asarray(matrix)


def band(nodes: Floats, thickness: Floats, share: float = 1.0) -> Floats:
    """Closed outline of a band of varying thickness along a centre line.

    Args:
        nodes: Centre line (K, 2).
        thickness: Full thickness at each node (K,), or along each of the edges (K - 1,), in the unit
            of ``nodes``.
        share: Draws a band of this share of the thickness inside the full one.

    Returns:
        Outline (P, 2) in the unit of ``nodes``.
    """
    line = refinement_matrix(len(nodes)) @ nodes
    if len(thickness) == len(nodes):
        places = np.linspace(0.0, len(nodes) - 1.0, len(line))
        half = 0.5 * share * np.interp(places, np.arange(len(nodes)), thickness)
    else:
        half = 0.5 * share * np.append(np.repeat(thickness, REFINEMENT), thickness[-1])
    tangents = np.gradient(line, axis=0)
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1, keepdims=True), 1e-12)
    normals = np.stack([-tangents[:, 1], tangents[:, 0]], axis=1)
    return np.concatenate([line + half[:, None] * normals, (line - half[:, None] * normals)[::-1]])


def half(outline: Floats, direction: Floats) -> Floats:
    """The part of a convex outline (P, 2) from the mean of its corners towards ``direction`` (2,)."""
    heights = (outline - outline.mean(axis=0)) @ direction
    corners = []
    for k in range(len(outline)):
        here, there = heights[k - 1], heights[k]
        if (here < 0.0) != (there < 0.0):
            corners.append(outline[k - 1] + (outline[k] - outline[k - 1]) * (here / (here - there)))
        if there >= 0.0:
            corners.append(outline[k])
    return np.array(corners).reshape(-1, 2)


def rectangle(centre: ArrayLike, axes: Floats, size: ArrayLike) -> Floats:
    """Corners of a rectangle, or of the shadow of one in space.

    Args:
        centre: Its middle (2,).
        axes: Directions of its length and its height (2, 2), a row each; shorter than 1 in a shadow.
        size: Length and height (2,).

    Returns:
        Corners (4, 2), in the unit of the lengths.
    """
    corners = 0.5 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.asarray(size)
    return np.asarray(centre + corners @ axes)


def turned(angle: float) -> Floats:
    """Along a body that is turned by an angle [rad], and up from it: rows x, y."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, sine], [-sine, cosine]])


def rotations(quaternions: Floats) -> Floats:
    """Axes of bodies in space (M, 3, 3) from w, x, y, z (M, 4): in columns along each, up and to its side."""
    w, x, y, z = quaternions.T
    matrices = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(matrices), -1, 0)
