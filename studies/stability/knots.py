"""Whether a closed line is knotted: its determinant, the Alexander polynomial at −1 without its sign.

A crossing of a projection of the line relates the three arcs that meet there, 2a = b + c with a above (Fox's
colourings; Livingston, Knot Theory, 1993, chapters 3 and 7). All crossings but one and all arcs but one make
a square matrix of whole numbers, whose determinant is that of the knot: 1 for a line that is not knotted, 3
for the trefoil, 5 for the figure of eight. It is the same for any projection; a few knots have 1 as well.
"""

from collections.abc import Iterator
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FAR = 20.0
"""How far away an open line is closed, in its own size."""
VIEW = np.linalg.qr(np.array([[0.62, -0.31, 0.72], [0.44, 0.87, -0.23], [-0.57, 0.41, 0.71]]))[0]
"""Ours: a projection along no axis, so that edges do not run into each other."""
ROUNDING = 1e-3


def closed(line: Floats) -> Floats:
    """An open line closed far away: its ends go on straight out of its middle (N,3) -> (N + 3, 3)."""
    middle = line.mean(axis=0)
    out = line[[0, -1]] - middle
    out = np.vstack([out, np.cross(*out)])
    far = FAR * np.linalg.norm(line - middle, axis=1).max()
    before, after, around = middle + far * out / np.linalg.norm(out, axis=1, keepdims=True)
    return np.vstack([before, line, after, around])


def determinant(line: Floats) -> int:
    """Determinant of a closed line through the points (N, 3); the last is joined to the first.

    Raises:
        RuntimeError: Rounding leaves it open.
    """
    crossings = sorted(_crossings(line @ VIEW))
    under, count = [low for low, _ in crossings], len(crossings)
    if count < 3:
        return 1
    matrix = np.zeros((count, count))
    for k, (_, high) in enumerate(crossings):
        matrix[k, np.searchsorted(under, high) % count] += 2
        matrix[k, [k, (k + 1) % count]] -= 1
    found = abs(float(np.linalg.det(matrix[:-1, :-1])))
    if abs(found - round(found)) > ROUNDING:
        raise RuntimeError(f"a determinant of whole numbers came out as {found}")
    return round(found)


def _crossings(line: Floats) -> Iterator[tuple[float, float]]:
    """Places along the line, in edges, where it passes below itself seen along the third axis, and above."""
    edge = np.roll(line, -1, axis=0) - line
    for i, j in combinations(range(len(line)), 2):
        across = _cross(edge[i], edge[j])
        if j - i in (1, len(line) - 1) or across == 0.0:
            continue
        between = line[j] - line[i]
        a, b = _cross(between, edge[j]) / across, _cross(between, edge[i]) / across
        if 0.0 <= a < 1.0 and 0.0 <= b < 1.0:
            above = line[i, 2] + a * edge[i, 2] > line[j, 2] + b * edge[j, 2]
            yield (j + b, i + a) if above else (i + a, j + b)


def _cross(a: Floats, b: Floats) -> float:
    return float(a[0] * b[1] - a[1] * b[0])
