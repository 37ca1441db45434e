"""Ensembles: robots that fit about as well, one from each search, as unlike each other as they can be."""

from collections.abc import Callable, Sequence

import numpy as np

from magworm_gym.recording import Floats


def farthest_first(
    pools: Sequence[Floats], scale: Floats, accept: Callable[[int, int], bool], tries: int
) -> list[int | None]:
    """From each pool the point that is farthest from those chosen of the pools before.

    Args:
        pools: Points (K, P) of each search, best first; each has P numbers of the same meaning.
        scale: Change of each number that counts as one (P,).
        accept: Whether a point will do, by pool and place; asked in order of distance.
        tries: Points of a pool that are asked about at most.

    Returns:
        A place in each pool; None where none of those tried will do.
    """
    chosen: list[Floats] = []
    places: list[int | None] = []
    for number, pool in enumerate(pools):
        order = np.argsort(-distances(pool, chosen, scale), kind="stable")[:tries].tolist()
        place = next((at for at in order if accept(number, at)), None)
        places.append(place)
        if place is not None:
            chosen.append(pool[place])
    return places


def distances(points: Floats, others: Sequence[Floats], scale: Floats) -> Floats:
    """Distance of each point (K, P) from the nearest of others (P,) in units of the scale (P,) (K,) [1].

    Zero for all where there are no others.
    """
    if not others:
        return np.zeros(len(points))
    away = (points[:, None] - np.array(others)) / scale
    return np.asarray(np.linalg.norm(away, axis=2).min(axis=1))


def coverage(chosen: Floats, low: Floats, high: Floats) -> Floats:
    """Part of the intervals from low to high (P,) that chosen points (N, P) reach over (P,) [1]."""
    return np.asarray(np.ptp(chosen, axis=0) / np.maximum(high - low, 1e-300))


def alike(chosen: Floats, scale: Floats, least: int) -> list[tuple[int, int]]:
    """Pairs of points (N, P) that differ by the scale (P,) in fewer than so many numbers."""
    unlike = (np.abs(chosen[:, None] - chosen) >= scale).sum(axis=2)
    return [(i, j) for i in range(len(chosen)) for j in range(i + 1, len(chosen)) if unlike[i, j] < least]
