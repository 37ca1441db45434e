"""How often wrenches could be left out or taken at a lower order, in scenes as they are used."""

import sys
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Scene
from studies.needs.orders import HEIGHTS_M, force_errors
from studies.needs.reach import TOLERANCES, Magnets, distances_m, magnets, shares_beyond

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

NEAREST_M = 0.022
"""The presets' nearest height."""
PRESETS = ("paper-3", "turn-3", "belt-125")


@dataclass(frozen=True)
class Reach:
    """Distances of a scene.

    Attributes:
        wrenches: Distances seen.
        nearest_m, farthest_m: The least and the greatest.
        limits_m: Distance out of reach by tolerance.
        shares: By tolerance the share of wrenches beyond it, and of blocks of eight lanes.
        order_1_m: Where order 1 has the error that order 2 has at the nearest height.
        order_1_blocks: Share of blocks beyond.
    """

    wrenches: int
    nearest_m: float
    farthest_m: float
    limits_m: dict[float, float]
    shares: dict[float, tuple[float, float]]
    order_1_m: float
    order_1_blocks: float


def pair_of(scene: Scene) -> Magnets:
    """The magnets of a scene."""
    return magnets(scene, tomllib.loads(scene.to_toml()))


def scenes() -> dict[str, Scene]:
    """Presets, and a belt with more drive magnets than its robot meets."""
    found = {name: Scene.preset(name) for name in PRESETS}
    belt = found["belt-125"].with_values({"drive.arrangement.count": 16})
    return {**found, "belt-125 with 16": belt}


def reach_of(scene: Scene) -> Reach:
    """Distances of a scene in use."""
    pair, distance_m = pair_of(scene), distances_m(scene)
    limits = {tolerance: pair.out_of_reach_m(tolerance) for tolerance in TOLERANCES}
    order_1_m = _distance_of_order_1_m(pair, scene.dimensions)
    return Reach(
        wrenches=distance_m.size,
        nearest_m=float(distance_m.min()),
        farthest_m=float(distance_m.max()),
        limits_m=limits,
        shares={tolerance: shares_beyond(distance_m, limit) for tolerance, limit in limits.items()},
        order_1_m=order_1_m,
        order_1_blocks=shares_beyond(distance_m, order_1_m)[1],
    )


def _distance_of_order_1_m(pair: Magnets, dimensions: int) -> float:
    """On the straight line through the logarithms of errors and heights that lie around it."""
    errors = force_errors(pair, dimensions)
    allowed = errors[2][HEIGHTS_M.index(NEAREST_M)]
    heights: NDArray[np.float64] = np.log(HEIGHTS_M)
    slope, level = np.polyfit(heights[2:], np.log(errors[1][2:]), 1)
    return float(np.exp((np.log(allowed) - level) / slope))
