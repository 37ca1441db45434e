"""Robots that differ: magnets taken out, parameters off their values."""

import itertools

import numpy as np
from numpy.typing import NDArray

FEWEST_MAGNETS = 3


def removable_sets(magnets: int) -> list[tuple[int, ...]]:
    """Every set of body magnets that can be taken out with three left, the empty one first.

    Args:
        magnets: Number of body magnets M.

    Returns:
        Sets of indices counted from 0 at the head, smaller ones first.
    """
    sizes = range(max(0, magnets - FEWEST_MAGNETS) + 1)
    return [chosen for size in sizes for chosen in itertools.combinations(range(magnets), size)]


def present_after(magnets: int, removed: tuple[int, ...]) -> NDArray[np.bool_]:
    """Which magnets (M,) are left in place."""
    return ~np.isin(np.arange(magnets), removed)


def robot_name(removed: tuple[int, ...]) -> str:
    """Name of a robot by the magnets it lacks, counted from 0 at the head."""
    if not removed:
        return "intact"
    return "without " + " and ".join(str(magnet) for magnet in removed)


def removed_for_each(magnets: int, num_envs: int, share: float) -> list[tuple[int, ...]]:
    """Gives a share of the environments a robot with magnets taken out.

    All sets come equally often. A robot of three magnets stays whole.

    Args:
        magnets: Number of body magnets M.
        num_envs: Number of environments N.
        share: Share of environments with damage, 0 to 1.

    Returns:
        For each environment the magnets that are taken out.
    """
    damaged = removable_sets(magnets)[1:]
    count = round(share * num_envs) if damaged else 0
    # Spread over the batch, so that damaged robots do not share their blocks of lanes alone.
    order = (np.arange(num_envs) * count) // num_envs
    turn = np.diff(order, append=count) > 0
    number = itertools.count()
    return [damaged[next(number) % len(damaged)] if hit else () for hit in turn]


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
