"""Error of the wrench by quadrature order and by distance, against order 10 with panels."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from magworm_gym import magnet
from studies.needs.reach import MU_0, Magnets

ORDERS = (1, 2, 3, 4)
HEIGHTS_M = (0.012, 0.017, 0.022, 0.032, 0.047, 0.062)
"""Heights of the body's centre over the drive's; 22 mm is the presets' nearest, 62 mm their farthest."""
NEAREST_M = 0.022
ANGLES_RAD = (-0.7, 0.0, 0.3, 0.7)
EXACT_ACROSS = 10
"""Points across the width, which the planar kernel integrates in closed form."""


@dataclass(frozen=True)
class OrderError:
    """Largest error of the force by order of the quadrature, relative to the weight.

    At a height of the body's centre over the drive's, the drive up to 60 mm to either side.
    """

    dimensions: int
    height_m: float
    order_1: float
    order_2: float
    order_3: float
    order_4: float


def order_errors(pair: Magnets, dimensions: int) -> list[OrderError]:
    """Errors at all heights."""
    return [
        OrderError(dimensions, height, *(force_error(pair, dimensions, order, height) for order in ORDERS))
        for height in HEIGHTS_M
    ]


def distance_of_order_1_m(errors: list[OrderError]) -> float:
    """Where order 1 has the error that order 2 has at the nearest height [m].

    On the straight line through the logarithms of heights and errors from there on.
    """
    far = [error for error in errors if error.height_m >= NEAREST_M]
    slope, level = np.polyfit(
        np.log([error.height_m for error in far]), np.log([error.order_1 for error in far]), 1
    )
    return float(np.exp((np.log(far[0].order_2) - level) / slope))


def force_error(pair: Magnets, dimensions: int, order: int, height_m: float) -> float:
    """Largest error of one order at one height, relative to the weight."""
    along = np.linspace(-0.06, 0.06, 49)
    offsets, angles = (grid.ravel() for grid in np.meshgrid(along, ANGLES_RAD))
    positions = np.stack([offsets, np.zeros_like(offsets), np.full_like(offsets, height_m)], axis=-1)
    # Turned about y, the magnets' width, which stays parallel.
    turns = np.stack([np.cos(angles / 2), 0 * angles, np.sin(angles / 2), 0 * angles], axis=-1)
    up = [(0.0, 0.0, remanence) for remanence in pair.remanence_t]
    wrench = partial(magnet.wrench, pair.drive_m, pair.body_m, positions, turns)
    exact, _ = wrench(drive_magnetisation_t=up[1], body_magnetisation_t=up[0], order=10)
    across = order if dimensions == 3 else EXACT_ACROSS
    found = force_by_faces(pair, positions, angles, (order, across))
    return float(np.linalg.norm(found - exact, axis=-1).max() / pair.weight_n)


def force_by_faces(
    pair: Magnets, positions: NDArray[np.float64], angles: NDArray[np.float64], orders: tuple[int, int]
) -> NDArray[np.float64]:
    """F = ∬ σ B dS over both charged faces with so many points along and across each [N]."""
    (along, weights), (across, others) = (np.polynomial.legendre.leggauss(order) for order in orders)
    length, width, height = pair.body_m
    charge = pair.remanence_t[0] / MU_0 * length * width / 4.0
    cos, sin = np.cos(angles)[:, None, None], np.sin(angles)[:, None, None]
    x, y = 0.5 * length * along[:, None], 0.5 * width * across[None, :]
    force = np.zeros_like(positions)
    for side in (1.0, -1.0):
        z = 0.5 * side * height
        at = np.stack(np.broadcast_arrays(cos * x + sin * z, y[None], cos * z - sin * x), axis=-1)
        points = at + positions[:, None, None]
        field = magnet.field(pair.drive_m, points, (0.0, 0.0, pair.remanence_t[1]))
        force += side * charge * np.einsum("i,j,pijk->pk", weights, others, field)
    return force
