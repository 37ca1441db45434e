"""Robots that lack magnets: which there are, and what they are called."""

import itertools

import numpy as np
from numpy.typing import NDArray

from magworm_gym.randomise import FEWEST_MAGNETS


def removable_sets(magnets: int, lacking: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    """Every set of body magnets that can be taken out with three left, the smallest first.

    Args:
        magnets: Number of body magnets M, those that the scene lacks included.
        lacking: Magnets that the scene itself lacks; they are part of every set.

    Returns:
        Sets of indices counted from 0 at the head; the first one is ``lacking``.
    """
    left = [magnet for magnet in range(magnets) if magnet not in lacking]
    sizes = range(max(0, len(left) - FEWEST_MAGNETS) + 1)
    chosen = [taken for size in sizes for taken in itertools.combinations(left, size)]
    return [tuple(sorted((*lacking, *taken))) for taken in chosen]


def present_after(magnets: int, removed: tuple[int, ...]) -> NDArray[np.bool_]:
    """Which magnets (M,) are left in place."""
    return ~np.isin(np.arange(magnets), removed)


def robot_name(removed: tuple[int, ...], lacking: tuple[int, ...] = ()) -> str:
    """Name of a robot by the magnets it lacks beside those of the scene, counted from 0 at the head."""
    taken = [str(magnet) for magnet in removed if magnet not in lacking]
    return "without " + " and ".join(taken) if taken else "intact"
