"""Combinations of parameters that the data leave free."""

from dataclasses import dataclass

import numpy as np

from magworm_gym.identification.parameters import ParameterSpace
from magworm_gym.recording import Floats

FREE = 0.5
"""Length in the unit cube from which on a combination counts as free [1]."""

LEAST_SHARE = 0.3
"""Shares below are left out of words [1]."""


@dataclass(frozen=True)
class FreeCombination:
    """A direction along which candidates fit about as well as the best.

    Attributes:
        direction: Unit vector (P,) [1].
        length: How far they reach along it, in the unit cube [1].
    """

    direction: Floats
    length: float


def free_combinations(best: Floats, fitting: Floats) -> list[FreeCombination]:
    """Main axes of the set of candidates that fit about as well, where it is long.

    Unlike derivatives they are blind to ruggedness and follow a curved valley as a whole.

    Args:
        best: The best point of the cube (P,).
        fitting: Points that fit about as well (K, P), the best among them.
    """
    away = fitting - best
    _, _, directions = np.linalg.svd(away, full_matrices=False)
    lengths = np.ptp(away @ directions.T, axis=0)
    return [
        FreeCombination(direction * np.sign(direction[np.abs(direction).argmax()]), float(length))
        for direction, length in zip(directions, lengths, strict=True)
        if length >= FREE
    ]


def in_words(space: ParameterSpace, direction: Floats) -> str:
    """A direction (P,) as changes of parameters, in parts of their bounds."""
    order = [at for at in np.argsort(-np.abs(direction)) if abs(direction[at]) > LEAST_SHARE]
    shares = [f"{space.parameters[at].label} by {direction[at]:+.2f}" for at in order]
    return " and ".join(shares) if len(shares) < 3 else f"{', '.join(shares[:-1])} and {shares[-1]}"
