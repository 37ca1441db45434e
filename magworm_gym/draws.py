"""Random numbers that depend on (seed, episode, place in the sequence) alone, as the simulator's do."""

import json
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from magworm_gym.arguments import SEED_LIMIT

# For the same seed and episode a task, a robot and the simulator draw numbers of their own.
TASK = np.uint64(0x7A5B_1C3D_9E8F_2041)
ROBOT = np.uint64(0x3F84_D5B5_B547_0917)
PER_EPISODE = np.uint64(0xD134_2543_DE82_EF95)
PER_DRAW = np.uint64(0x9E37_79B9_7F4A_7C15)


def uniform(
    seeds: NDArray[np.int64], episodes: NDArray[np.int64], count: int, purpose: np.uint64
) -> NDArray[np.float64]:
    """Numbers uniform in [0, 1): a row of `count` for each seed and episode (N,).

    SplitMix64 (Steele, Lea & Flood 2014) as a counter-based generator: a row is the same for any N,
    place in a batch and order of resets.
    """
    keys = _mix(_mix(seeds.astype(np.uint64) ^ purpose) ^ episodes.astype(np.uint64) * PER_EPISODE)
    places = np.arange(1, count + 1, dtype=np.uint64) * PER_DRAW
    bits = _mix(keys[:, None] + places) >> np.uint64(11)
    return bits.astype(np.float64) / 2.0**53


def next_episodes(
    seeds: NDArray[np.int64],
    episodes: NDArray[np.int64],
    given: Sequence[int | None],
    mask: NDArray[np.bool_],
    generator: np.random.Generator,
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Seeds and numbers of the episodes that environments start next (N,).

    A given seed starts at episode 0; without one an environment goes on with its own, or draws its first.

    Args:
        seeds: Seed of each environment (N,).
        episodes: Number of each one's last episode (N,), -1 before the first.
        given: Seed or None for each.
        mask: The environments that are reset (N,): the others keep their seeds.
        generator: Draws first seeds.
    """
    seeds, following = seeds.copy(), episodes + 1
    for i in np.flatnonzero(mask).tolist():
        seed = given[i]
        if seed is not None:
            seeds[i], following[i] = seed, 0
        elif following[i] == 0:
            seeds[i] = generator.integers(SEED_LIMIT)
    return seeds, following


def generator_of(text: bytes) -> np.random.Generator:
    """The generator whose state stands in JSON, as Gymnasium's are: PCG64.

    Raises:
        ValueError: The text holds something else.
    """
    generator = np.random.PCG64()
    try:
        generator.state = json.loads(text)
    except (ValueError, TypeError, KeyError, OverflowError, RecursionError) as error:
        raise ValueError("random in the state is no state of NumPy's PCG64") from error
    return np.random.Generator(generator)


def _mix(z: NDArray[np.uint64]) -> NDArray[np.uint64]:
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58_476D_1CE4_E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D0_49BB_1331_11EB)
    return z ^ (z >> np.uint64(31))
