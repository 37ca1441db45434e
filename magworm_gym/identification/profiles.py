"""Profiles: how well a parameter fits at each value, the others free."""

import numpy as np

from magworm_gym.recording import Floats

SLICES = 10
"""Slices of a parameter's bounds."""


def profiles(units: Floats, losses: Floats) -> Floats:
    """Least loss of all candidates in each slice of each parameter (P, SLICES); infinite where there is none.

    It is what a search of its own in each slice would find at best, so an upper bound of the profile
    likelihood. Losses beyond what fits as well may be lower bounds themselves.

    Args:
        units: Points of the cube (C, P).
        losses: Their losses (C,).
    """
    least = np.full((units.shape[1], SLICES), np.inf)
    places = np.minimum((units * SLICES).astype(np.int64), SLICES - 1)
    for parameter in range(units.shape[1]):
        np.minimum.at(least[parameter], places[:, parameter], losses)
    return least
