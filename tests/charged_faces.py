"""Wrench on a cuboid magnet in magpylib's field of another: the reference of the simulator's own."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MU_0 = 1.25663706127e-6
"""Vacuum permeability [N/A²] (CODATA 2022)."""
POINTS = 20
"""Along each edge of a panel of a charged face."""


def face_wrench(
    source: Any, size_m: Floats, remanence_t: Floats, centre_m: Floats, axes: Floats, panels: int = 1
) -> Floats:
    """Force [N] and torque about the centre [N·m] (6,) on a cuboid whose edges are the columns of ``axes``.

    Its faces carry the charge σ = J·n/μ0 and feel F = ∬ σ B dS, T = ∬ σ r × B dS; each edge of a face is cut
    into panels.
    """
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    middles = (2.0 * np.arange(panels) + 1.0) / panels - 1.0
    nodes, weights = (middles[:, None] + nodes / panels).ravel(), np.tile(weights / panels, panels)
    force, torque = np.zeros(3), np.zeros(3)
    for n in range(3):
        s, t = (n + 1) % 3, (n + 2) % 3
        for side in (-1.0, 1.0):
            local = np.zeros((nodes.size, nodes.size, 3))
            local[..., n], local[..., s], local[..., t] = side, nodes[:, None], nodes
            arms = (0.5 * local * size_m @ axes.T).reshape(-1, 3)
            area = 0.25 * size_m[s] * size_m[t] * np.outer(weights, weights).ravel()
            push = (side * remanence_t[n] / MU_0 * area)[:, None] * source.getB(centre_m + arms)
            force += push.sum(axis=0)
            torque += np.cross(arms, push).sum(axis=0)
    return np.concatenate([force, torque])
