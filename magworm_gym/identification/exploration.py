"""What fits about as well as the best: the set of candidates below a threshold of the loss."""

import numpy as np

from magworm_gym.identification.search import Limit, Losses, Progress
from magworm_gym.identification.settings import SearchSettings
from magworm_gym.recording import Floats

ROUND = 64

FIRST_SPREAD = 0.02
"""Least standard deviation of steps along the axes, as a part of the bounds [1]."""


def explore(
    losses: Losses,
    limit: Limit,
    axes: Floats,
    units: Floats,
    known: Floats,
    settings: SearchSettings,
    progress: Progress | None = None,
) -> None:
    """Wanders through the set of candidates that fit about as well as the best, to find its ends.

    Some of the steps go along the difference of two members, which follows narrow valleys, some along what
    the derivatives call free, some along one parameter, some along one parameter to anywhere.

    Args:
        losses: Gives the losses.
        limit: Gives the loss up to which a candidate fits about as well as the best.
        axes: Steps (P, P) at the best point, one a row, that should fit about as well.
        units: Candidates of the search (C, P).
        known: Their losses (C,).
        settings: Settings.
        progress: Told after each round.
    """
    generator = np.random.default_rng([settings.seed, 2])
    for done in range(settings.rounds):
        bound = limit(float(known.min()))
        proposed = _proposals(units[known <= bound], axes, generator)
        found = losses(proposed, np.full(ROUND, bound))
        units, known = np.vstack([units, proposed]), np.append(known, found)
        if progress is not None:
            progress("explore", done + 1, settings.rounds, float(known.min()))


def _proposals(members: Floats, axes: Floats, generator: np.random.Generator) -> Floats:
    """New points of the cube (ROUND, P) around members of the set (K, P)."""
    count, dimension = members.shape
    rows = np.arange(ROUND)
    start = _outer_members(members, generator)
    valley, free, axis, anywhere = (rows // 2 % 4 == kind for kind in range(4))
    pairs = generator.integers(count, size=(2, ROUND))
    stretch = generator.uniform(0.3, 2.0, (ROUND, 1)) * generator.choice([-1.0, 1.0], (ROUND, 1))
    along = start + stretch * (members[pairs[0]] - members[pairs[1]])
    along += generator.normal(0.0, 1e-3, (ROUND, dimension))
    lengths = generator.normal(0.0, 1.0, (ROUND, 1)) * 10.0 ** generator.uniform(-1.5, 0.5, (ROUND, 1))
    freely = start + lengths * axes[generator.integers(dimension, size=ROUND)]
    chosen = generator.integers(dimension, size=ROUND)
    spread = np.maximum(np.ptp(members, axis=0), FIRST_SPREAD)
    moved, thrown = start.copy(), start.copy()
    moved[rows, chosen] += generator.normal(0.0, 1.0, ROUND) * spread[chosen]
    thrown[rows, chosen] = generator.random(ROUND)
    proposed = np.select(
        [valley[:, None], free[:, None], axis[:, None], anywhere[:, None]], [along, freely, moved, thrown]
    )
    return np.asarray(np.clip(proposed, 0.0, 1.0))


def _outer_members(members: Floats, generator: np.random.Generator) -> Floats:
    """Members to start from (ROUND, P): every other one lies at an end of the set along an axis."""
    start = members[generator.integers(len(members), size=ROUND)]
    ends = np.concatenate([members.argmin(axis=0), members.argmax(axis=0)])
    start[::2] = members[generator.choice(ends, size=len(start[::2]))]
    return start
