"""The paper's four stages of a pass, by the place of the drive among three magnets."""

import itertools

import numpy as np
from numpy.typing import NDArray

from magworm_gym import Recording

NAMES = ("I", "II", "III", "IV")


def stage_of(drive_x: NDArray[np.float64], magnet_x: NDArray[np.float64]) -> NDArray[np.int64]:
    """Stage at each instant.

    I: ahead of the first magnet. II: between the first and the middle one. III: between the middle
    one and the last. IV: behind the last. The magnets move, so a stage, once reached, stays reached.

    Args:
        drive_x: Drive (T,) [m].
        magnet_x: Magnets (T, 3), head first [m].

    Returns:
        0 to 3 (T,).
    """
    passed = (drive_x[:, None] >= magnet_x).sum(axis=1)
    return np.asarray(np.maximum.accumulate(passed), np.int64)


def spans(recording: Recording) -> list[slice]:
    """Samples of each of the four stages of a pass towards the tail.

    Raises:
        ValueError: A stage is never reached.
    """
    stage = stage_of(recording.drive_positions[:, 0, 0], recording.magnet_poses[..., 0])
    edges = np.searchsorted(stage, np.arange(len(NAMES) + 1))
    if (np.diff(edges) == 0).any():
        raise ValueError("the drive does not pass through all four stages")
    return [slice(a, b) for a, b in itertools.pairwise(edges.tolist())]
