"""Robots that differ: magnets taken out, parameters off their values."""

import itertools

import numpy as np
from numpy.typing import NDArray

FEWEST_MAGNETS = 3


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


def removed_for_each(
    magnets: int, lacking: tuple[int, ...], num_envs: int, share: float
) -> list[tuple[int, ...]]:
    """Gives a share of the environments a robot with magnets taken out.

    All sets come equally often. A robot of three magnets stays whole.

    Args:
        magnets: Number of body magnets M.
        lacking: Magnets that the scene itself lacks.
        num_envs: Number of environments N.
        share: Share of environments with damage, 0 to 1.

    Returns:
        For each environment all the magnets that it lacks.
    """
    whole, *damaged = removable_sets(magnets, lacking)
    count = round(share * num_envs) if damaged else 0
    removed = [whole] * num_envs
    # Spread over the batch: environments next to each other share a block of lanes.
    for number, place in enumerate(np.linspace(0, num_envs, count, endpoint=False).astype(int)):
        removed[place] = damaged[number % len(damaged)]
    return removed


def factors_for_each(
    names: tuple[str, ...], num_envs: int, spread: float, seed: int
) -> dict[str, NDArray[np.float64]]:
    """Draws factors on parameters, log-uniform and independent.

    Args:
        names: Names of the parameters.
        num_envs: Number of environments N.
        spread: Factors lie between 1 - spread and 1 / (1 - spread).
        seed: Seed of the draws.

    Returns:
        Factors (N,) by name.
    """
    generator = np.random.default_rng(seed)
    widest = -np.log1p(-spread)
    return {name: np.exp(generator.uniform(-widest, widest, num_envs)) for name in names}
