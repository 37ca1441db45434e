"""Whether a closed line is knotted: its determinant, the Alexander polynomial at −1 without its sign.

A crossing of a projection of the line relates the three arcs that meet there, 2a = b + c with a above (Fox's
colourings; Livingston, Knot Theory, 1993, chapters 3 and 7). All crossings but one and all arcs but one make
a square matrix of whole numbers, whose determinant is that of the knot: 1 for a line that is not knotted, 3
for the trefoil, 5 for the figure of eight. It is the same for any projection; a few knots have 1 as well.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FAR = 20.0
"""How far away an open line is closed, in its own size."""
VIEW = np.linalg.qr(np.array([[0.62, -0.31, 0.72], [0.44, 0.87, -0.23], [-0.57, 0.41, 0.71]]))[0]
"""Ours: a projection along no axis, so that edges do not run into each other."""


def closed(line: Floats) -> Floats:
    """An open line closed far away: its ends go on straight out of its middle (N,3) -> (N + 3, 3)."""
    middle = line.mean(axis=0)
    far = FAR * np.linalg.norm(line - middle, axis=1).max()
    ends = [middle + far * _unit(end - middle) for end in (line[0], line[-1])]
    around = middle + far * _unit(np.cross(line[0] - middle, line[-1] - middle))
    return np.vstack([ends[0], line, ends[1], around])


def determinant(line: Floats) -> int:
    """Determinant of a closed line through the points (N, 3); the last is joined to the first."""
    crossings = _crossings(line @ VIEW)
    under = np.array([low for low, _ in crossings])
    count = len(crossings)
    matrix = [[0] * count for _ in range(count)]
    for k, (_, high) in enumerate(crossings):
        matrix[k][int(np.searchsorted(under, high)) % count] += 2
        matrix[k][k] -= 1
        matrix[k][(k + 1) % count] -= 1
    return abs(_exact_determinant([row[:-1] for row in matrix[:-1]]))


def _crossings(line: Floats) -> list[tuple[float, float]]:
    """Places along the line, in edges, where it passes below itself seen along the third axis, and above."""
    head, edge = line, np.roll(line, -1, axis=0) - line
    found = []
    for i in range(len(line)):
        for j in range(i + 2, len(line) - (i == 0)):
            between = head[j] - head[i]
            across = _cross(edge[i], edge[j])
            if across == 0.0:
                continue
            a, b = _cross(between, edge[j]) / across, _cross(between, edge[i]) / across
            if 0.0 <= a < 1.0 and 0.0 <= b < 1.0:
                above = head[i][2] + a * edge[i][2] > head[j][2] + b * edge[j][2]
                found.append((j + b, i + a) if above else (i + a, j + b))
    return sorted(found)


def _exact_determinant(matrix: list[list[int]]) -> int:
    """Of whole numbers, without fractions (Bareiss 1968)."""
    sign, before = 1, 1
    for k in range(len(matrix) - 1):
        pivot = next((row for row in range(k, len(matrix)) if matrix[row][k]), None)
        if pivot is None:
            return 0
        if pivot != k:
            matrix[k], matrix[pivot], sign = matrix[pivot], matrix[k], -sign
        for row in matrix[k + 1 :]:
            factor = row[k]
            row[k + 1 :] = [
                (value * matrix[k][k] - factor * above) // before
                for value, above in zip(row[k + 1 :], matrix[k][k + 1 :], strict=True)
            ]
        before = matrix[k][k]
    return sign * matrix[-1][-1] if matrix else 1


def _cross(a: Floats, b: Floats) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def _unit(a: Floats) -> Floats:
    return np.asarray(a / np.linalg.norm(a))
